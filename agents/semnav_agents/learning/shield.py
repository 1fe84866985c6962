"""A last check of a learned action: where would it lead before the robot could stop?

A policy is trained to drive well on average; the check looks at the centimetres. It is a dynamic
window approach (Fox, Burgard and Thrun 1997) that keeps the policy's twist wherever it may.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from semnav_agents.learning.room_memory import BodyShape, body_shape
from semnav_agents.planning.free import points_around
from semnav_agents.planning.motion import Move, moved
from semnav_env.robots import RobotSpec
from semnav_features.checked_fields import Bounds, Count, Length, Share, check_fields
from semnav_features.frames import FloatArray, Pose, Twist
from semnav_features.kernels.compiling import kernel

REACH = 2.4
"""Obstacles farther away than this are not reached before the robot stands, metres."""

MAX_PERIODS = 600
"""A robot that does not stand after so many periods counts as one that cannot stop."""

_SHARES = (1.0, 0.6, 0.3)
"""Shares of the wanted twist that are tried first."""

_FORWARD = (0.0, 0.15, -0.15, 0.3, -0.3, 0.6)
_TURNS = (0.0, 0.15, -0.15, 0.3, -0.3, 0.6, -0.6)
_SIDEWAYS = (0.0, 0.4, -0.4)
"""Parts of the twists that are tried then, nearest first: shares of the largest speeds."""

Offset: TypeAlias = Annotated[float, Bounds(-1.0, 1.0, "m")]
"""A length that may be negative."""


class Lookahead(NamedTuple):
    """Which poses a shield tests.

    Attributes:
        period: time for which a velocity holds, seconds.
        held: number of periods for which a twist is held before the robot brakes.
        tests: number of tested poses in a period.
    """

    period: float
    held: int
    tests: int


class Nearness(NamedTuple):
    """How near a robot may come to an obstacle; see `ShieldSettings`, metres."""

    margin: float
    deeper: float
    least: float


@dataclass(frozen=True)
class ShieldSettings:
    """How a shield checks.

    Remembered obstacles lie some 2 cm beside the true ones: when robots touched something, the
    nearest of them was 10 to 19 mm away. So `margin` is larger than that, and `least` keeps a robot
    from coming into contact by many small steps, each of which is within `deeper`.

    Attributes:
        foresight: time for which an action is held before the robot brakes, seconds.
        margin: distance below which an obstacle counts as touched, metres.
        deeper: a robot that is nearer already may not come nearer by more than this, metres.
        least: distance below which nothing may come nearer at all, metres; if negative, none is.
        period: time for which a velocity holds, seconds; then the limits let it change.
        tests: number of poses that are tested in each period.
    """

    foresight: Share = 0.2
    margin: Length = 0.03
    deeper: Length = 0.004
    least: Offset = 0.015
    period: Share = 0.1
    tests: Count = 1

    def __post_init__(self) -> None:
        check_fields(self)


class Shield:
    """Replaces an action that leads into a remembered obstacle by the nearest one that does not.

    Args:
        robot: the body.
        settings: None for the defaults.
    """

    def __init__(self, robot: RobotSpec, settings: ShieldSettings | None = None) -> None:
        self._robot, self._settings = robot, settings or ShieldSettings()
        self._shape = body_shape(robot)
        sideways = _SIDEWAYS if robot.holonomic else (0.0,)
        self._others = np.array(
            [(v, left, w) for v in _FORWARD for left in sideways for w in _TURNS]
        )

    def checked(
        self, action: NDArray[np.float32], points: FloatArray, pose: Pose, velocity: Twist
    ) -> NDArray[np.float32]:
        """The action, or the one nearest to it that leads into no obstacle; else zeros.

        Args:
            action: of the body.
            points: obstacles, metres, shape (n, 2), in the frame of `pose`.
            pose: of the robot.
            velocity: of the robot's centre.
        """
        robot, settings = self._robot, self._settings
        near = points_around(pose, points, REACH)
        wanted = np.array([action[0], action[1] if robot.holonomic else 0.0, action[-1]], float)
        order = np.argsort(np.abs(self._others - wanted).sum(axis=1), kind="stable")
        tried = np.vstack((np.outer(_SHARES, wanted), self._others[order]))
        k = first_free(
            near,
            self._shape,
            tried * (robot.max_speed, robot.max_sideways_speed, robot.max_turn_rate),
            velocity,
            (robot.max_acceleration, robot.max_acceleration, robot.max_turn_acceleration),
            Lookahead(settings.period, round(settings.foresight / settings.period), settings.tests),
            Nearness(settings.margin, settings.deeper, settings.least),
        )
        if k < 0:
            return np.zeros_like(action)
        return np.asarray(tried[k] if robot.holonomic else tried[k, [0, 2]], np.float32)


@kernel
def first_free(
    points: FloatArray,
    body: BodyShape,
    twists: FloatArray,
    velocity: Twist,
    limits: Twist,
    ahead: Lookahead,
    nearness: Nearness,
) -> int:
    """The first of some twists after which the robot can stop without touching anything.

    Args:
        points: obstacles, robot frame, metres, shape (n, 2).
        body: footprint.
        twists: that are wanted, of the axle, shape (m, 3).
        velocity: of the centre now.
        limits: largest accelerations forward, sideways and of the turn.
        ahead: which poses are tested.
        nearness: how near the robot may come.

    Returns:
        Its index, or -1.
    """
    near = np.empty((len(points), 3))
    for p in range(len(points)):
        x, y = points[p, 0], points[p, 1]
        near[p, 0], near[p, 1] = x, y
        near[p, 2] = max(abs(x) - body.half_length, abs(y) - body.half_width)
    for k in range(len(twists)):
        wanted = (twists[k, 0], twists[k, 1], twists[k, 2])
        if stops_free(near, body, wanted, velocity, limits, ahead, nearness):
            return k
    return -1


@kernel
def stops_free(
    near: FloatArray,
    body: BodyShape,
    wanted: Twist,
    velocity: Twist,
    limits: Twist,
    ahead: Lookahead,
    nearness: Nearness,
) -> bool:
    """Whether a robot that holds a twist for a moment and then brakes touches nothing."""
    pose = (body.axle, 0.0, 0.0)
    forward, left, turn = velocity
    left += body.axle * turn  # of the axle, as are the twists that are wanted
    for step in range(MAX_PERIODS):
        on = step < ahead.held
        forward = towards(forward, wanted[0] if on else 0.0, limits[0] * ahead.period)
        left = towards(left, wanted[1] if on else 0.0, limits[1] * ahead.period)
        turn = towards(turn, wanted[2] if on else 0.0, limits[2] * ahead.period)
        if not on and max(abs(forward), abs(left), abs(turn)) < 1e-6:
            return True
        move = Move(forward * ahead.period, left * ahead.period, turn * ahead.period)
        for k in range(1, ahead.tests + 1):
            at = moved(pose[0], pose[1], pose[2], move, k / ahead.tests)
            if comes_too_near(near, body, at, nearness):
                return False
        pose = moved(pose[0], pose[1], pose[2], move)
    return False


@kernel
def comes_too_near(near: FloatArray, body: BodyShape, axle: Pose, nearness: Nearness) -> bool:
    """Whether the body, with its axle at a pose, is nearer to an obstacle than it may come.

    Args:
        near: obstacles, robot frame, and their distance from the body now, metres, shape (n, 3).
        body: footprint.
        axle: pose in the robot frame.
        nearness: how near the robot may come.
    """
    c, s = math.cos(axle[2]), math.sin(axle[2])
    x, y = axle[0] - c * body.axle, axle[1] - s * body.axle
    for p in range(len(near)):
        dx, dy = near[p, 0] - x, near[p, 1] - y
        aside = abs(c * dy - s * dx) - body.half_width
        if aside < nearness.margin:
            outside = max(abs(c * dx + s * dy) - body.half_length, aside)
            if outside < nearness.margin and outside < enough(near[p, 2], nearness):
                return True
    return False


@kernel
def enough(now: float, nearness: Nearness) -> float:
    """Distance to which a robot may come from an obstacle within the margin, metres."""
    return max(now - nearness.deeper, min(now, nearness.least))


@kernel
def towards(value: float, wanted: float, most: float) -> float:
    """A value that changes towards another one, by no more than `most`."""
    return value + min(max(wanted - value, -most), most)
