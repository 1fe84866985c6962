"""The numbers of a judge's record: written and read from Python, kept by compiled code."""

from __future__ import annotations

import math
from struct import Struct
from typing import Any, NamedTuple

import numpy as np

from semnav_env.judge.astray import missed_beyond
from semnav_env.judge.mission import Mission
from semnav_env.language.references import Side
from semnav_env.mind.grounding.goal import Goal, wait_of
from semnav_env.rules import Rules, SuccessRules
from semnav_env.world.simulator.sensed import Motion


class Period(NamedTuple):
    """The judge's result of one control period; for many robots, an array for each entry.

    Attributes:
        steps: control periods since the reset.
        pose: true pose of the robot's centre, world frame; of many, shape (n, 3).
        collisions: contacts begun since the reset.
        path_length: length of the path since the reset, metres.
        progress: decrease of the shortest way to the current goal in this period, metres.
        in_contact: whether the body touches anything.
        clause: whether a clause was completed.
        success: whether the whole command was completed.
        failure: whether the episode failed for another reason than its time limit.
        over: whether the episode is decided: success or failure, now or before.
    """

    steps: Any
    pose: Any
    collisions: Any
    path_length: Any
    progress: Any
    in_contact: Any
    clause: Any
    success: Any
    failure: Any
    over: Any

    @property
    def judged(self) -> tuple[Any, Any, Any, Any]:
        """The first inputs of a reward, see `Tick`: progress, clause, success, failure."""
        return self.progress, self.clause, self.success, self.failure


_COUNTS = [("steps", "i8"), ("pose", "f8", 3), ("collisions", "i8")]
_LENGTHS = [("path_length", "f8"), ("progress", "f8")]
PERIOD = np.dtype([*_COUNTS, *_LENGTHS, *((name, "?") for name in Period._fields[5:])])
"""A `Period` as compiled code writes it."""

_INTEGERS = ("in_contact", "was_in_contact", "crossed_door", "several_answers")
_NAMES = (
    *("x", "y", "heading", "speed", "yaw_rate", "in_contact", "seconds"),
    *("last_x", "last_y", "was_in_contact", "still_seconds"),
    *("crossed_door", "remaining", "remaining_before", "west", "south", "spacing"),
    *("still_speed", "still_yaw_rate", "longest_still", "missed_beyond", "several_answers"),
    *("corridor_x", "corridor_y", "corridor_cos", "corridor_sin"),
    *("wall_side", "wall_offset", "wall_end", "hallway_way", "wall_way"),
)

JUDGE_STATE = np.dtype(
    [(name, "i8" if name in _INTEGERS else "f8") for name in _NAMES] + [("period", PERIOD)]
)
"""The numbers of a record, shape (1,); SI units, world frame.

First the `Motion` of the period, written before each call. Then: last_x, last_y, was_in_contact,
still_seconds: of the period before, the latter how long the robot has stood still. crossed_door:
index of the door of the plan that was crossed, or -1. remaining, remaining_before: length of the
way to the goal, now and one period ago. west, south, spacing: of the field of distances.
still_speed, still_yaw_rate: below both the robot stands still; longest_still: the longest time that
it may stand still. missed_beyond: see `missed_beyond`. several_answers: 1 if other judges judge
each control period, too, for other right answers, else 0. corridor_x to corridor_sin: frame of
the corridor of the goal. wall_side: 1 or -1 while the robot is to keep along the wall on its left
or right, else 0; wall_offset, wall_end: half the width of the hallway that counts for that, and
how far along it that lane leads; hallway_way, wall_way: what it has driven there since it had its
way to the wall, in all (negative before) and on that side of the middle.
period: the result of the control period; the kernel writes it, and the judge
completes it after an event.
"""

_MOTION_FORMAT, _PERIOD_FORMAT = Struct("=5dqd"), Struct("=q3dqdd5?")
"""Formats of `struct`, which is much faster than NumPy for a few numbers of one row."""

_PERIOD_PLACE = JUDGE_STATE.itemsize - PERIOD.itemsize


def first_state(mission: Mission) -> np.ndarray:
    """The numbers of a record at the start of an episode."""
    rules, state = mission.rules.success, np.zeros(1, JUDGE_STATE)
    state["x"], state["y"], state["heading"] = mission.start
    state["last_x"], state["last_y"] = mission.start[:2]
    state["period"]["pose"] = mission.start
    state["west"], state["south"], state["spacing"] = mission.geodesic.grid.frame
    state["still_speed"], state["still_yaw_rate"] = rules.still_speed, rules.still_yaw_rate
    state["several_answers"] = bool(mission.others)
    return state


def limit_goal(state: np.ndarray, goal: Goal, rules: Rules) -> None:
    """Write the limits of a goal: of its junction, of the time at rest, and along a wall."""
    state["longest_still"] = rules.success.still_seconds + wait_of(goal)
    state["missed_beyond"] = missed_beyond(goal, rules.success)
    _watch_wall(state, goal, rules)
    if goal.corridor is not None:
        x, y, heading = goal.corridor.frame
        state["corridor_x"], state["corridor_y"] = x, y
        state["corridor_cos"], state["corridor_sin"] = math.cos(heading), math.sin(heading)


def _watch_wall(state: np.ndarray, goal: Goal, rules: Rules) -> None:
    """Write along which wall the robot is to keep on the way to a goal, and begin to measure."""
    wall, corridor = goal.wall, goal.corridor
    state["hallway_way"], state["wall_way"] = -rules.success.wall_entry, 0.0
    state["wall_side"] = 0.0
    if wall is None or corridor is None:
        return
    from semnav_env.mind.grounding.along_wall import lane_end  # few commands need it

    if corridor.half_width >= rules.grounding.wall_distance + rules.success.wall_room:
        state["wall_side"] = 1.0 if wall is Side.LEFT else -1.0
        state["wall_offset"] = corridor.half_width
        state["wall_end"] = lane_end(corridor, goal.places)


def left_the_wall(state: np.ndarray, rules: SuccessRules) -> bool:
    """Whether the robot has driven too little of its way along the wall that it was told."""
    way = float(state["hallway_way"][0])
    return way >= rules.wall_least and float(state["wall_way"][0]) < rules.wall_share * way


def put_motion(numbers: memoryview, motion: Motion) -> None:
    """Write the motion of a control period into the bytes of a state."""
    pose, speed, yaw_rate, in_contact, seconds = motion
    _MOTION_FORMAT.pack_into(numbers, 0, *pose, speed, yaw_rate, in_contact, seconds)


def copy_motion(source: memoryview, target: memoryview) -> None:
    """Write the motion of a control period from the bytes of a state into those of another."""
    target[: _MOTION_FORMAT.size] = source[: _MOTION_FORMAT.size]


def read_period(numbers: memoryview) -> Period:
    """Read the result of the control period from the bytes of a state."""
    steps, x, y, heading, *others = _PERIOD_FORMAT.unpack_from(numbers, _PERIOD_PLACE)
    return Period(steps, (x, y, heading), *others)
