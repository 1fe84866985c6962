"""The robot's progress in the active clause: a record, and the kernel that updates it.

A kernel does the work of every control period and returns events. A `Follower` handles the events,
for example by grounding the next clause.
"""

from __future__ import annotations

import math
from struct import Struct
from typing import Any

import numpy as np

from semnav_env.mind.grounding.goal import Goal, GoalKind, PassGoal, ReachGoal, door_of, wait_of
from semnav_env.mind.grounding.goal_check import is_crossed, is_reached, looks_along
from semnav_env.mind.grounding.ways import WAY_SPACING
from semnav_features.frames import Pose, to_local
from semnav_features.kernels.compiling import kernel

CLAUSE_DONE, TRAIL_DUE, ON_WAY, NO_NEARER = 1, 2, 4, 32
"""Events, as bits: the current clause is completed; the robot is `WAY_SPACING` from the last
place of its trail; the goal lies on a known way, so that what to head for changes as one drives;
the robot stands still beside a lookout point, to which it can come no nearer. The bits 8 and 16 are
those of `mind.belief.understand`, which adds its events to these."""

STANDS_BESIDE, STANDS_FOR = 1.0, 3.0
"""Largest distance from a lookout point, metres, at which a robot that stands still for so many
seconds can come no nearer: a wall, or furniture, leaves its body no room there."""

NO_TRAIL = math.nan, math.nan
"""Last place of a trail that is not kept: no distance from it is ever large enough to note."""

GOAL_RECORD = np.dtype(
    [(name, "f8", size) for name, size in (("pose", 3), ("door", 4), ("tolerances", 3))]
    + [(name, "f8") for name in ("width", "wait")]
    + [("kind", "i8"), ("has_door", "?"), ("has_places", "?")]
)
"""A goal as kernels take it, in the frame of the follower's scene.

pose: of the goal, metres and radians.
door: x and y of the jambs of its door, metres; zeros without one.
tolerances: of a `ReachGoal`: distance (metres), heading (radians), offset (metres; NaN for none).
width: of the door of a `PassGoal`, metres.
wait: how long to stand still, seconds.
kind: a `GoalKind`.
has_door: whether it has a door.
has_places: whether its way is known.
"""

CLAUSE_PROGRESS = np.dtype(
    [(name, "f8") for name in ("care", "jamb_margin", "standstill_speed", "inspection_angle")]
    + [(name, "f8") for name in ("still", "farthest_along")]
    + [(name, "f8", 2) for name in ("last", "trail", "farthest")]
    + [("ahead", "f8", 3), ("goal", GOAL_RECORD)]
    + [(name, "?") for name in ("is_open", "is_behind", "looked_back")]
)
"""How far a robot is in the current clause; shape (1,). Places are (x, y) in metres, in the frame
of the follower's scene.

Set when a command is begun:
    care, jamb_margin: of the `Follower`; the margin in metres.
    standstill_speed, inspection_angle: of the rules, m/s and radians.

Set when a clause is begun or grounded:
    goal: where it leads.
    is_open: whether reaching the goal completes the clause: it is under way and possible.
    ahead: pose at which the clause began, turned around if it speaks of what is behind.
    is_behind: whether it does.

Written by `note_pose`:
    still: for how long the robot has stopped, seconds.
    last: where it was last.
    farthest, farthest_along: the place at which it was farthest along the heading of `ahead`, and
        how far that is, metres; a lookout point to which it could come no nearer counts.
    looked_back: whether it has looked along `ahead` since the clause began.

Written where an event calls for it:
    trail: last place of the robot's trail; `NO_TRAIL` if the command never goes back.
"""

_GOAL_FORMAT = Struct("=12dq2?")
"""A `GOAL_RECORD`; NumPy takes twelve times as long to write a nested entry."""

_FARTHEST_FORMAT = Struct("=5d")
"""The fields `farthest` and `ahead` of a `CLAUSE_PROGRESS`, which lie side by side."""

_PASS, _REACH, _STOP = int(GoalKind.PASS), int(GoalKind.REACH), int(GoalKind.STOP)
_SEEK = int(GoalKind.SEEK)


def put_goal(record: np.ndarray, field: str, goal: Goal) -> None:
    """Write a goal into a record.

    Args:
        record: shape (1,).
        field: of dtype `GOAL_RECORD`.
        goal: to write.
    """
    door, tolerances = door_of(goal), (0.0, 0.0, 0.0)
    ends, width = (0.0, 0.0, 0.0, 0.0), 0.0
    if door is not None:
        ends = (*door.start, *door.end)
    if isinstance(goal, PassGoal):
        width = goal.door.width
    if isinstance(goal, ReachGoal):
        tolerances = goal.tolerances
    flags = int(goal.kind), door is not None, bool(goal.places)
    numbers = (*goal.pose, *ends, *tolerances, width, wait_of(goal), *flags)
    buffer: Any = record
    _GOAL_FORMAT.pack_into(buffer, buffer.dtype.fields[field][1], *numbers)


def goal_bytes(record: np.ndarray, field: str) -> memoryview:
    """The bytes of a goal in a record; copying them takes a tenth of the time of `put_goal`."""
    fields: Any = record.dtype.fields
    offset = fields[field][1]
    return record.view(np.uint8).data[offset : offset + GOAL_RECORD.itemsize]


def farthest_view(progress: np.ndarray, heading: float) -> Pose:
    """The farthest place that a robot has reached in the active clause, and the heading there.

    An inspected direction stays inspected when the robot comes back.

    Args:
        progress: dtype `CLAUSE_PROGRESS`, shape (1,).
        heading: of the robot now, radians; the one of `ahead` counts if it has looked there.
    """
    buffer: Any = progress
    offset = buffer.dtype.fields["farthest"][1]
    x, y, _, _, ahead = _FARTHEST_FORMAT.unpack_from(buffer, offset)
    return x, y, ahead if progress["looked_back"][0] else heading


@kernel
def note_pose(progress: np.ndarray, pose: Pose, speed: float, seconds: float) -> int:
    """Note the robot's pose; returns events.

    Args:
        progress: dtype `CLAUSE_PROGRESS`, shape (1,); changed in place.
        pose: of the robot's centre, in the frame of the goal.
        speed: m/s.
        seconds: since the last call.
    """
    entry = progress[0]
    x, y = pose[0], pose[1]
    entry.still = entry.still + seconds if speed < entry.standstill_speed else 0.0
    events = ON_WAY if entry.goal.has_places else 0
    if entry.is_open and _is_completed(entry, pose):
        events |= CLAUSE_DONE
    if math.hypot(x - entry.trail[0], y - entry.trail[1]) >= WAY_SPACING:
        events |= TRAIL_DUE
    if entry.goal.kind == _SEEK and _comes_no_nearer(entry, x, y, seconds):
        events |= NO_NEARER
    entry.last[0], entry.last[1] = x, y
    ahead = (entry.ahead[0], entry.ahead[1], entry.ahead[2])
    along = to_local(ahead, (x, y))[0]
    if along > entry.farthest_along:
        entry.farthest[0], entry.farthest[1], entry.farthest_along = x, y, along
    if entry.is_behind and looks_along(pose, ahead[2], entry.inspection_angle):
        entry.looked_back = True
    return events


@kernel
def _comes_no_nearer(entry: Any, x: float, y: float, seconds: float) -> bool:
    """Whether the robot has now stood beside its goal for `STANDS_FOR`, or a multiple of it."""
    periods = math.floor(entry.still / STANDS_FOR)
    if periods == 0.0 or math.floor((entry.still - seconds) / STANDS_FOR) == periods:
        return False
    return math.hypot(entry.goal.pose[0] - x, entry.goal.pose[1] - y) < STANDS_BESIDE


@kernel
def _is_completed(entry: Any, pose: Pose) -> bool:
    """Whether reaching a pose completes the clause."""
    goal = entry.goal
    there = (goal.pose[0], goal.pose[1], goal.pose[2])
    if goal.kind == _PASS:
        before, door = (entry.last[0], entry.last[1]), goal.door
        ends = (door[0], door[1], door[2], door[3])
        after = (pose[0], pose[1])
        return is_crossed(before, after, ends, goal.width, there[2], entry.jamb_margin)
    if goal.kind == _REACH:
        tolerances = (goal.tolerances[0], goal.tolerances[1], goal.tolerances[2])
        return is_reached(there, tolerances, pose, entry.care)
    return bool(goal.kind == _STOP and entry.still > goal.wait)
