"""The numbers of a judge's record: written and read from Python, kept by compiled code."""

from __future__ import annotations

import math
from struct import Struct
from typing import Any, NamedTuple

import numpy as np

from semnav_env.judge.astray import missed_beyond
from semnav_env.judge.mission import Mission
from semnav_env.mind.grounding.goal import Goal, wait_of
from semnav_env.rules import SuccessRules
from semnav_env.world.simulator.sensed import Motion


class Period(NamedTuple):
    """What became of a robot in one control period; of many robots, an array for each entry.

    Attributes:
        steps: control periods since the reset.
        pose: true pose of the robot's centre, world frame; of many, shape (n, 3).
        collisions: contacts begun since the reset.
        path_length: driven since the reset, metres.
        progress: by how much the shortest way to the goal under way got shorter, metres.
        in_contact: whether the body touches anything.
        clause: whether a clause was completed.
        success: whether the whole command was completed.
        failure: whether the episode failed, but for running out of time.
        over: whether nothing more is to come: success or failure, now or before.
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
        """What a reward may depend on first, see `Tick`: progress, clause, success, failure."""
        return self.progress, self.clause, self.success, self.failure


_COUNTS = [("steps", "i8"), ("pose", "f8", 3), ("collisions", "i8")]
_LENGTHS = [("path_length", "f8"), ("progress", "f8")]
PERIOD = np.dtype([*_COUNTS, *_LENGTHS, *((name, "?") for name in Period._fields[5:])])
"""A `Period` as compiled code writes it."""

_INTEGERS = ("in_contact", "was_in_contact", "crossed_door")
_NAMES = (
    *("x", "y", "heading", "speed", "yaw_rate", "in_contact", "seconds"),
    *("last_x", "last_y", "was_in_contact", "still_seconds"),
    *("crossed_door", "remaining", "remaining_before", "west", "south", "spacing"),
    *("still_speed", "still_yaw_rate", "longest_still", "missed_beyond"),
    *("corridor_x", "corridor_y", "corridor_cos", "corridor_sin"),
)

JUDGE_STATE = np.dtype(
    [(name, "i8" if name in _INTEGERS else "f8") for name in _NAMES] + [("period", PERIOD)]
)
"""The numbers of a record, shape (1,); SI units, world frame.

First the `Motion` of the period, written before each call. Then: last_x, last_y, was_in_contact,
still_seconds: of the period before, the latter how long the robot has stood still. crossed_door:
index of the door of the plan that was crossed, or -1. remaining, remaining_before: length of the
way to the goal, now and one period ago. west, south, spacing: of the field of distances.
still_speed, still_yaw_rate: below both the robot stands still; longest_still: for how long it may.
missed_beyond: see `missed_beyond`. corridor_x to corridor_sin: frame of the corridor of the goal.
period: what is said of the control period; the judge writes it, and completes it when it thinks.
"""

_MOTION_FORMAT, _PERIOD_FORMAT = Struct("=5dqd"), Struct("=q3dqdd5?")
"""Faster than NumPy by far for a few numbers of one row."""

_PERIOD_PLACE = JUDGE_STATE.itemsize - PERIOD.itemsize


def first_state(mission: Mission) -> np.ndarray:
    """The numbers of a record at the start of an episode."""
    rules, state = mission.rules.success, np.zeros(1, JUDGE_STATE)
    state["x"], state["y"], state["heading"] = mission.start
    state["last_x"], state["last_y"] = mission.start[:2]
    state["period"]["pose"] = mission.start
    state["west"], state["south"], state["spacing"] = mission.geodesic.grid.frame
    state["still_speed"], state["still_yaw_rate"] = rules.still_speed, rules.still_yaw_rate
    return state


def limit_goal(state: np.ndarray, goal: Goal, rules: SuccessRules) -> None:
    """Write what a goal limits: where its junction is missed, and for how long to stand still."""
    state["longest_still"] = rules.still_seconds + wait_of(goal)
    state["missed_beyond"] = missed_beyond(goal, rules)
    if goal.corridor is not None:
        x, y, heading = goal.corridor.frame
        state["corridor_x"], state["corridor_y"] = x, y
        state["corridor_cos"], state["corridor_sin"] = math.cos(heading), math.sin(heading)


def put_motion(numbers: memoryview, motion: Motion) -> None:
    """Write the motion of a control period into the bytes of a state."""
    pose, speed, yaw_rate, in_contact, seconds = motion
    _MOTION_FORMAT.pack_into(numbers, 0, *pose, speed, yaw_rate, in_contact, seconds)


def read_period(numbers: memoryview) -> Period:
    """Read from the bytes of a state what it says of the control period."""
    steps, x, y, heading, *others = _PERIOD_FORMAT.unpack_from(numbers, _PERIOD_PLACE)
    return Period(steps, (x, y, heading), *others)
