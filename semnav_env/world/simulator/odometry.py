"""Dead reckoning that drifts: the motion of a robot measured by its own wheels or legs."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import Annotated, TypeAlias

import numpy as np

from semnav_env.world.lidar.counter_rng import bits, normal, stream
from semnav_env.world.physics.drive_record import POSE
from semnav_features.checked_fields import Bounds, Share, check_fields
from semnav_features.frames import Pose
from semnav_features.kernels.compiling import kernel

Noise: TypeAlias = Annotated[float, Bounds(0.0, 10.0)]

_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class OdometrySettings:
    """Errors of odometry.

    A bias is a standard deviation, drawn from once an episode. The variance of a noise is
    proportional to the motion, so that it does not depend on how often odometry is read. The
    squares of distance, turn and veer noise have the roles of alpha 3, 1 and 2 in Thrun, Burgard,
    Fox, "Probabilistic Robotics" (2005), section 5.4.

    Attributes:
        distance_bias: of the scale of travelled distance, about 1; no unit.
        turn_bias: of the scale of turns, about 1; no unit.
        distance_noise: of the distance travelled forward, and of that sideways, m per sqrt(m).
        turn_noise: of the angle turned, rad per sqrt(rad).
        veer_noise: of the heading, by the distance travelled, rad per sqrt(m).
        veer_bias: of the heading, by the distance travelled, rad/m: wheels of unequal diameter.
        slip: share of the motion that the wheels or legs make, and the body does not because it
            touches something, that odometry counts all the same; 0 to 1.

    Raises:
        ValueError: one of them is no number or out of its bounds; names it.
    """

    distance_bias: Noise = 0.01
    turn_bias: Noise = 0.01
    distance_noise: Noise = 0.01
    turn_noise: Noise = 0.01
    veer_noise: Noise = 0.005
    veer_bias: Noise = 0.0
    slip: Share = 0.0

    def __post_init__(self) -> None:
        check_fields(self)

    def scaled(self, factor: float) -> OdometrySettings:
        """The settings with biases and noises that are `factor` times as large; slip stays."""
        errors = {f.name: factor * getattr(self, f.name) for f in fields(self) if f.name != "slip"}
        return replace(self, **errors)


EXACT = OdometrySettings(0.0, 0.0, 0.0, 0.0, 0.0)
"""Odometry without drift."""


ODOMETRY = np.dtype(
    [
        ("pose", POSE),
        ("before", POSE),
        ("distance_scale", "f8"),
        ("turn_scale", "f8"),
        ("veer", "f8"),
        ("slip", "f8"),
        ("distance_noise", "f8"),
        ("turn_noise", "f8"),
        ("veer_noise", "f8"),
        ("seed", "i8"),
        ("updates", "i8"),
    ]
)
"""Dead reckoning of one robot; shape (1,).

    pose: of the robot's centre, odometry frame.
    before: true pose at the last update, world frame.
    distance_scale, turn_scale: of travelled distance and of turns, drawn for the episode.
    veer: heading error by the distance travelled, rad/m, drawn for the episode.
    distance_noise, turn_noise, veer_noise, slip: as in `OdometrySettings`.
    seed: of the episode's noise.
    updates: in this episode; -1 before the first reset.
"""


class Odometry:
    """Integrates the robot's displacements with the errors of `settings`.

    The noise of an update is a function of the episode's seed and the number of the update, so a
    pickled copy continues exactly like the original.

    Args:
        settings: errors of the odometry.

    Attributes:
        record: the data for compiled code, dtype `ODOMETRY`; always the same array.
    """

    def __init__(self, settings: OdometrySettings = OdometrySettings()) -> None:
        self.settings = settings
        self.record = np.zeros(1, ODOMETRY)
        for name in ("distance_noise", "turn_noise", "veer_noise", "slip"):
            self.record[name] = getattr(settings, name)
        self.record["updates"] = -1

    @property
    def pose(self) -> Pose:
        """Pose of the robot's centre in the odom frame, whose origin is the start pose."""
        x, y, heading = self.record["pose"].item()
        return x, y, heading

    def reset(self, true_pose: Pose, rng: np.random.Generator) -> None:
        """Start an episode at `true_pose`, world frame; draws its biases and seed from `rng`."""
        settings, record = self.settings, self.record
        record["seed"] = rng.integers(2**62)
        record["distance_scale"] = 1.0 + settings.distance_bias * float(rng.standard_normal())
        record["turn_scale"] = 1.0 + settings.turn_bias * float(rng.standard_normal())
        veers = settings.veer_bias > 0.0
        record["veer"] = settings.veer_bias * float(rng.standard_normal()) if veers else 0.0
        record["pose"], record["before"], record["updates"] = (0.0, 0.0, 0.0), true_pose, 0

    def update(self, true_pose: Pose) -> Pose:
        """Update with the true pose of the robot, world frame; returns `pose`.

        Raises:
            RuntimeError: before the first `reset`.
        """
        if self.record["updates"][0] < 0:
            raise RuntimeError("call reset(true_pose, rng) first")
        advance(self.record, *true_pose, 0.0, 0.0, 0.0)
        return self.pose


@kernel
def _turned(angle: float) -> float:
    """The same angle in [-pi, pi]."""
    return float(angle - _TURN * np.rint(angle / _TURN))


@kernel
def _walk(moved: float, draws: np.uint64, index: int) -> float:
    """The error of a random walk over a motion, at one unit of noise."""
    return math.sqrt(abs(moved)) * float(normal(bits(draws, index)))


@kernel
def advance(
    record: np.ndarray,
    x: float,
    y: float,
    heading: float,
    lost_forward: float,
    lost_left: float,
    lost_turn: float,
) -> None:
    """Move the odometry pose on by a true displacement.

    Args:
        record: dtype `ODOMETRY`.
        x: of the robot now, world frame, metres.
        y: of the robot now, world frame, metres.
        heading: of the robot now, radians.
        lost_forward: motion that the wheels or legs made and the body did not, metres.
        lost_left: likewise, metres.
        lost_turn: likewise, radians.
    """
    r = record[0]
    c, s = math.cos(r.before.heading), math.sin(r.before.heading)
    dx, dy, turn = x - r.before.x, y - r.before.y, _turned(heading - r.before.heading)
    forward, left = c * dx + s * dy, c * dy - s * dx
    forward, left = forward + r.slip * lost_forward, left + r.slip * lost_left
    turn += r.slip * lost_turn
    distance = math.hypot(forward, left)
    draws = stream(r.seed, 0, r.updates)
    veer = r.veer * distance + r.veer_noise * _walk(distance, draws, 3)
    forward = r.distance_scale * forward + r.distance_noise * _walk(forward, draws, 0)
    left = r.distance_scale * left + r.distance_noise * _walk(left, draws, 1)
    turn = r.turn_scale * turn + r.turn_noise * _walk(turn, draws, 2) + veer
    c, s = math.cos(r.pose.heading), math.sin(r.pose.heading)
    r.pose.x = r.pose.x + c * forward - s * left
    r.pose.y = r.pose.y + s * forward + c * left
    r.pose.heading = _turned(r.pose.heading + turn)
    r.before.x, r.before.y, r.before.heading = x, y, heading
    r.updates += 1
