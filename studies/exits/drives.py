"""Drives a case by a rule, and judges the drive on the plan."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from shapely import LineString, Point

from semnav_agents.planning.obstacles import points_of_segments
from semnav_env.approach import DoorSide
from semnav_env.approach.poses import is_behind
from semnav_env.robots import RobotSpec
from semnav_env.world.maps import FloorPlan
from semnav_env.world.simulator import RobotSetup, Simulator
from semnav_features.frames import FloatArray, Pose, Twist, to_local
from studies.exits.cases import ExitCase

MAX_SECONDS = 90.0
"""Longest drive, seconds."""

VIEW = 12.0
"""Distance from the door within which the plan is known to the driver, metres."""

Steer: TypeAlias = Callable[[Pose, Twist], Twist]
"""A rule at work: the velocity that is wanted, from the pose and the velocity of the centre."""

Rule: TypeAlias = Callable[["ExitTask"], Steer]
"""Makes the `Steer` for a case."""


@dataclass(frozen=True, eq=False)
class ExitTask:
    """What a rule is told: the body, the door, and everything solid.

    Attributes:
        robot: the body.
        side: the door from the side of the room.
        plan: the part of the plan around the door, with the clutter.
        points: points on everything solid in it, metres, shape (n, 2).
    """

    robot: RobotSpec
    side: DoorSide
    plan: FloorPlan
    points: FloatArray


@dataclass(frozen=True)
class ExitResult:
    """How a drive ended.

    Attributes:
        passed: whether the whole body came to lie behind the door, through it.
        contact: whether the body touched anything on the way.
        seconds: how long it took.
    """

    passed: bool
    contact: bool
    seconds: float


def driven(case: ExitCase, robot: RobotSpec, rule: Rule) -> ExitResult:
    """Drive a case by a rule; the driver knows its pose and what is solid exactly."""
    plan, side = _local(case), case.side
    simulator = Simulator(plan, RobotSetup(robot, exact=True))
    sensed = simulator.reset(case.start, np.random.default_rng(case.number))
    steer = rule(ExitTask(robot, side, plan, points_of_segments(plan.segments)))
    period, contact, through = 1.0 / simulator.setup.control_hz, False, False
    for step in range(round(MAX_SECONDS / period)):
        before = sensed.motion.pose
        sensed = simulator.step(steer(before, sensed.velocity))
        after, contact = sensed.motion.pose, contact or sensed.motion.in_contact
        through = _crossed(side, before, after, through)
        if through and is_behind(side, after, robot):
            return ExitResult(True, contact, (step + 1) * period)
    return ExitResult(False, contact, MAX_SECONDS)


def _local(case: ExitCase) -> FloorPlan:
    around = Point(case.door.midpoint).union(Point(case.start[:2])).buffer(VIEW)
    near = tuple(s for s in case.plan.surfaces if LineString(s.points).intersects(around))
    return replace(case.plan, surfaces=near)


def _crossed(side: DoorSide, before: Pose, after: Pose, through: bool) -> bool:
    """Whether the centre is behind the door by way of the opening."""
    (x1, y1), (x2, y2) = to_local(side.frame, before[:2]), to_local(side.frame, after[:2])
    if (x1 < 0.0) == (x2 < 0.0):
        return through
    return x2 >= 0.0 and abs(y1 + y2) / 2 < side.width / 2
