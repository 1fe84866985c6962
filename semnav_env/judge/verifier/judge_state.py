"""The numbers of a judge's record: written and read from Python, kept by compiled code."""

from __future__ import annotations

import math
from struct import Struct
from typing import NamedTuple

import numpy as np

from semnav_env.judge.verifier.astray import missed_beyond
from semnav_env.judge.verifier.mission import Mission
from semnav_env.mind.grounding.goal import Goal, wait_of
from semnav_env.rules import SuccessRules
from semnav_env.world.simulator.sensed import Motion


class Outcome(NamedTuple):
    """What a record says after a control period.

    Attributes:
        x: of the robot's centre, world frame, metres.
        y: likewise.
        heading: of the robot, radians.
        speed: m/s.
        yaw_rate: rad/s.
        in_contact: 1 if the body touches anything, else 0.
        seconds: duration of the period.
        progress: by how much the shortest way to the goal got shorter, metres.
        path_length: driven in the episode, metres.
        collisions: contacts begun in the episode.
        crossed_door: index of the door of the plan that was crossed, or -1.
        remaining: length of the way to the goal, metres.
        remaining_before: the same one period ago.
    """

    x: float
    y: float
    heading: float
    speed: float
    yaw_rate: float
    in_contact: int
    seconds: float
    progress: float
    path_length: float
    collisions: int
    crossed_door: int
    remaining: float
    remaining_before: float


_INTEGERS = ("in_contact", "was_in_contact", "collisions", "crossed_door")
_FLOATS = (
    *("last_x", "last_y", "still_seconds", "west", "south", "spacing"),
    *("still_speed", "still_yaw_rate", "longest_still", "missed_beyond"),
    *("corridor_x", "corridor_y", "corridor_cos", "corridor_sin"),
)
_NAMES = (*Outcome._fields, "was_in_contact", *_FLOATS)

JUDGE_STATE = np.dtype([(name, "i8" if name in _INTEGERS else "f8") for name in _NAMES])
"""The numbers of a record, shape (1,); SI units, world frame.

First the `Outcome`, which begins with the `Motion` of the period, written before each call. Then:
last_x, last_y, was_in_contact, still_seconds: of the period before, the latter how long the robot
has stood still. west, south, spacing: of the field of distances. still_speed, still_yaw_rate: below
both the robot stands still; longest_still: for how long it may. missed_beyond: see `missed_beyond`.
corridor_x to corridor_sin: frame of the corridor of the goal.
"""

_MOTION_FORMAT, _OUTCOME_FORMAT = Struct("5dqd"), Struct("5dqd2d2q2d")
"""Faster than NumPy by far for a few numbers of one row."""


def first_state(mission: Mission) -> np.ndarray:
    """The numbers of a record at the start of an episode."""
    rules, state = mission.rules.success, np.zeros(1, JUDGE_STATE)
    state["x"], state["y"], state["heading"] = mission.start
    state["last_x"], state["last_y"] = mission.start[:2]
    state["west"], state["south"] = mission.geodesic.origin
    state["spacing"] = mission.geodesic.spacing
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


def outcome(numbers: memoryview) -> Outcome:
    """Read from the bytes of a state what it says."""
    return Outcome._make(_OUTCOME_FORMAT.unpack_from(numbers))
