"""Dead reckoning that drifts: what a robot believes of its motion from its own wheels or legs."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numba import njit

from semnav_env.features.frames import Pose
from semnav_env.lidar.counter_rng import bits, normal, stream

_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class OdometrySettings:
    """How odometry errs.

    A bias is drawn once an episode: the standard deviation of a factor's distance from 1. The
    variance of a noise is proportional to the motion, so that it does not depend on how often
    odometry is read. The squares of distance, turn and veer noise have the roles of alpha 3, 1 and
    2 in Thrun, Burgard, Fox, "Probabilistic Robotics" (2005), section 5.4.

    Attributes:
        distance_bias: of the scale of travelled distance; no unit.
        turn_bias: of the scale of turns; no unit.
        distance_noise: of the distance travelled forward, and of that sideways, m per sqrt(m).
        turn_noise: of the angle turned, rad per sqrt(rad).
        veer_noise: of the heading, by the distance travelled, rad per sqrt(m).

    Raises:
        ValueError: one of them is negative or not finite; names it.
    """

    distance_bias: float = 0.01
    turn_bias: float = 0.01
    distance_noise: float = 0.01
    turn_noise: float = 0.01
    veer_noise: float = 0.005

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not 0.0 <= value < math.inf:
                raise ValueError(f"{field.name} is {value}; it must be finite and not negative")


EXACT = OdometrySettings(0.0, 0.0, 0.0, 0.0, 0.0)
"""Odometry without drift."""


class Odometry:
    """Integrates the robot's displacements with the errors of `settings`.

    The noise of an update is a function of the episode's seed and the number of the update, so
    a pickled copy goes on exactly as the original does.

    Args:
        settings: how it errs.

    Attributes:
        pose: of the robot's centre in the odometry frame, whose origin is the start pose.
    """

    def __init__(self, settings: OdometrySettings = OdometrySettings()) -> None:
        self.settings = settings
        self.pose: Pose = (0.0, 0.0, 0.0)
        self._true: Pose | None = None

    def reset(self, true_pose: Pose, rng: np.random.Generator) -> None:
        """Start an episode at `true_pose`, world frame; draws three numbers from `rng`."""
        settings = self.settings
        self._seed = int(rng.integers(2**62))
        self._scales = (
            1.0 + settings.distance_bias * float(rng.standard_normal()),
            1.0 + settings.turn_bias * float(rng.standard_normal()),
        )
        self._noise = (settings.distance_noise, settings.turn_noise, settings.veer_noise)
        self._updates = 0
        self._true, self.pose = true_pose, (0.0, 0.0, 0.0)

    def update(self, true_pose: Pose) -> Pose:
        """Move on to where the robot truly is now, world frame; returns `pose`.

        Raises:
            RuntimeError: before the first `reset`.
        """
        if self._true is None:
            raise RuntimeError("call reset(true_pose, rng) first")
        self.pose = advance(
            self.pose,
            self._true,
            true_pose,
            self._scales,
            self._noise,
            self._seed,
            self._updates,
        )
        self._true = true_pose
        self._updates += 1
        return self.pose


@njit(cache=True, error_model="numpy")
def _turned(angle: float) -> float:
    """The same angle in [-pi, pi]."""
    return float(angle - _TURN * np.rint(angle / _TURN))


@njit(cache=True, error_model="numpy")
def _walk(moved: float, draws: np.uint64, index: int) -> float:
    """The error of a random walk over a motion, at one unit of noise."""
    return math.sqrt(abs(moved)) * float(normal(bits(draws, index)))


@njit(cache=True, error_model="numpy")
def advance(
    pose: Pose,
    before: Pose,
    after: Pose,
    scales: tuple[float, float],
    noise: tuple[float, float, float],
    seed: int,
    update: int,
) -> Pose:
    """The odometry pose after a true displacement.

    Args:
        pose: odometry pose so far.
        before: true pose at the last update, world frame.
        after: true pose now.
        scales: factors of distance and turn.
        noise: distance, turn and veer noise as in `OdometrySettings`.
        seed: of the episode.
        update: number of this update in the episode.
    """
    c, s = math.cos(before[2]), math.sin(before[2])
    x, y = after[0] - before[0], after[1] - before[1]
    forward, left, turn = c * x + s * y, c * y - s * x, _turned(after[2] - before[2])
    distance = math.hypot(forward, left)
    draws = stream(seed, 0, update)
    veer = noise[2] * _walk(distance, draws, 3)
    forward = scales[0] * forward + noise[0] * _walk(forward, draws, 0)
    left = scales[0] * left + noise[0] * _walk(left, draws, 1)
    turn = scales[1] * turn + noise[1] * _walk(turn, draws, 2) + veer
    c, s = math.cos(pose[2]), math.sin(pose[2])
    return (
        pose[0] + c * forward - s * left,
        pose[1] + s * forward + c * left,
        _turned(pose[2] + turn),
    )
