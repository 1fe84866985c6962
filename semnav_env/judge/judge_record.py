"""One compiled call per control period: what a judge keeps count of, and when it must think.

Everything stands in one structure, so that a call hands over one thing, and many robots' records
can be kept by one loop.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_env.mind.grounding.clause_progress import CLAUSE_DONE, TRAIL_DUE, note_pose
from semnav_env.mind.grounding.crossing import first_crossed
from semnav_env.world.grid.costs import cost_at
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.exact_hypot import exact_hypot
from semnav_features.kernels.structures import Structure, numba_type

DOOR_CROSSED, ASTRAY, TOO_STILL, SEVERAL_ANSWERS = 8, 16, 32, 64
"""Events beside those of `clause_progress`, as bits: a door was crossed; the robot is inside an arm
that the clause does not name, or far behind its junction; it has stood still for longer than is
allowed; the command has other right answers, so their judges have this control period to judge."""

NO_ARMS, NO_DISTANCES = np.empty((0, 5)), np.empty((0, 0))
"""Of a record without a goal."""


class JudgeRecord(Structure):
    """What a judge keeps count of in an episode.

    Attributes:
        state: numbers, dtype `JUDGE_STATE`, shape (1,).
        doors: `FloorPlan.door_ends`.
        arms: of the corridor that lead astray, see `wrong_arms`; set with each goal.
        distances: `WaysTo.distances` of the goal, shape (0, 0) where no way is left to go.
        progress: `Follower.progress` of the judge's follower.
    """

    state: np.ndarray
    doors: FloatArray
    arms: FloatArray
    distances: FloatArray
    progress: np.ndarray


JudgeRecordType = numba_type(JudgeRecord)


@kernel
def set_arms(record: JudgeRecord, arms: FloatArray) -> None:
    """Put other arms into a record, for another goal."""
    record.arms = arms


@kernel
def set_distances(record: JudgeRecord, distances: FloatArray) -> None:
    """Put another field of distances into a record, and read it where the robot is."""
    record.distances = distances
    record.state[0].remaining = _remaining(record, record.state[0])


@kernel
def judge_motion(record: JudgeRecord) -> int:
    """Take the motion of one control period into account; returns the events as bits."""
    state = record.state[0]
    pose = (state.x, state.y, state.heading)
    events = note_pose(record.progress, pose, state.speed, state.seconds)
    events &= CLAUSE_DONE | TRAIL_DUE
    still = state.speed < state.still_speed and abs(state.yaw_rate) < state.still_yaw_rate
    state.still_seconds = state.still_seconds + state.seconds if still else 0.0
    if state.still_seconds > state.longest_still:
        events |= TOO_STILL
    crossed = first_crossed(record.doors, state.last_x, state.last_y, state.x, state.y)
    if crossed >= 0:
        events |= DOOR_CROSSED
    if _is_astray(record.arms, state):
        events |= ASTRAY
    if state.several_answers:
        events |= SEVERAL_ANSWERS
    if state.wall_side != 0.0:
        _measure_wall(state)
    state.remaining_before, state.remaining = state.remaining, _remaining(record, state)
    state.crossed_door = crossed
    _write_period(state)
    return events


@kernel
def _measure_wall(state: Any) -> None:
    """Add what was driven in the hallway, and on the side of the wall along which to keep."""
    dx, dy = state.x - state.corridor_x, state.y - state.corridor_y
    offset = state.corridor_cos * dy - state.corridor_sin * dx
    driven = exact_hypot(state.x - state.last_x, state.y - state.last_y)
    along = state.corridor_cos * dx + state.corridor_sin * dy
    if abs(offset) < state.wall_offset and along < state.wall_end:
        state.hallway_way += driven
        if state.hallway_way > 0.0 and state.wall_side * offset > 0.0:
            state.wall_way += driven


@kernel
def _write_period(state: Any) -> None:
    """Write what became of the robot in this control period, unless a judge who thinks adds to it.

    Args:
        state: of the record, with the motion and the remaining way of this control period.
    """
    period = state.period
    period.steps += 1
    period.pose[0], period.pose[1], period.pose[2] = state.x, state.y, state.heading
    period.path_length += exact_hypot(state.x - state.last_x, state.y - state.last_y)
    if state.in_contact > state.was_in_contact:
        period.collisions += 1
    nearer = state.remaining_before - state.remaining
    period.progress = nearer if math.isfinite(nearer) else 0.0
    period.in_contact = state.in_contact != 0
    period.clause = period.success = period.failure = False
    state.was_in_contact = state.in_contact
    state.last_x, state.last_y = state.x, state.y


@kernel
def _remaining(record: JudgeRecord, state: Any) -> float:
    """Length of the way to the goal, metres."""
    if record.distances.size == 0:
        return 0.0
    return cost_at(record.distances, state.west, state.south, state.spacing, state.x, state.y)


@kernel
def _is_astray(arms: FloatArray, state: Any) -> bool:
    """Whether the robot is inside an arm that leads astray, or has missed its junction."""
    c, s = state.corridor_cos, state.corridor_sin
    dx, dy = state.x - state.corridor_x, state.y - state.corridor_y
    along, offset = c * dx + s * dy, c * dy - s * dx
    for k in range(len(arms)):
        sign, near, far, begin, depth = arms[k]
        if near < along < far and sign * offset - begin > depth:
            return True
    return bool(along > state.missed_beyond)
