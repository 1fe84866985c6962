"""The state of the filter: a pose, and the biases of its odometry."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from semnav_features.frames import FloatArray, Pose, compose, relative


class OdometryErrors(Protocol):
    """Errors of odometry; `OdometrySettings` of the simulator is one, and describes each field."""

    @property
    def distance_bias(self) -> float:
        """Standard deviation of the scale of distances; no unit."""
        ...

    @property
    def turn_bias(self) -> float:
        """Standard deviation of the scale of turns; no unit."""
        ...

    @property
    def veer_bias(self) -> float:
        """Standard deviation of the heading by the distance travelled, rad/m."""
        ...

    @property
    def distance_noise(self) -> float:
        """Random walk of the distance travelled, m per sqrt(m)."""
        ...

    @property
    def turn_noise(self) -> float:
        """Random walk of the angle turned, rad per sqrt(rad)."""
        ...

    @property
    def veer_noise(self) -> float:
        """Random walk of the heading by the distance travelled, rad per sqrt(m)."""
        ...

    @property
    def slip(self) -> float:
        """Share of a blocked motion that odometry counts, 0 to 1."""
        ...


@dataclass(frozen=True, eq=False)
class ReckonedState:
    """The estimate of the filter.

    Attributes:
        pose: pose of the robot's centre, world frame.
        biases: of odometry in this episode: relative errors of its distances and of its turns, and
            its veer in rad/m.
        covariance: of (x, y, heading, *biases), shape (6, 6).
    """

    pose: Pose
    biases: tuple[float, float, float]
    covariance: FloatArray

    @classmethod
    def at(cls, pose: Pose, covariance: FloatArray, errors: OdometryErrors) -> ReckonedState:
        """The state at a pose with a covariance of shape (3, 3) and unknown biases."""
        whole = np.zeros((6, 6))
        whole[:3, :3] = covariance
        spread = errors.distance_bias, errors.turn_bias, errors.veer_bias
        whole[3:, 3:] = np.diag(np.square(spread))
        return cls(pose, (0.0, 0.0, 0.0), whole)

    def moved(
        self, before: Pose, after: Pose, errors: OdometryErrors, touching: bool
    ) -> ReckonedState:
        """The state after a motion (Thrun, Burgard and Fox 2005, table 7.2, lines 2 to 7).

        The covariance P becomes F P F^T + Q, where F is the Jacobian of the motion and Q the
        random walk of odometry over it.

        Args:
            before: odometry at this state, odometry frame.
            after: odometry now.
            errors: errors of odometry.
            touching: whether the body touches something, so that odometry may count motion that
                was not made: the random walk is wider by `slip`.
        """
        distance_error, turn_error, veer = self.biases
        forward, left, turn = relative(before, after)
        forward, left = forward / (1.0 + distance_error), left / (1.0 + distance_error)
        distance = math.hypot(forward, left)
        turn = (turn - veer * distance) / (1.0 + turn_error)
        c, s = math.cos(self.pose[2]), math.sin(self.pose[2])
        dx, dy = c * forward - s * left, s * forward + c * left
        jacobian = np.eye(6)
        jacobian[0, 2:4] = -dy, -dx / (1.0 + distance_error)
        jacobian[1, 2:4] = dx, -dy / (1.0 + distance_error)
        jacobian[2, 4:6] = -turn / (1.0 + turn_error), -distance / (1.0 + turn_error)
        covariance = jacobian @ self.covariance @ jacobian.T
        slip = errors.slip if touching else 0.0
        noise = np.diag(
            (
                (errors.distance_noise**2 + slip**2) * abs(forward),
                (errors.distance_noise**2 + slip**2) * abs(left),
                (errors.turn_noise**2 + slip**2) * abs(turn) + errors.veer_noise**2 * distance,
            )
        )
        turned = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        covariance[:3, :3] += turned @ noise @ turned.T
        return ReckonedState(
            compose(self.pose, (forward, left, turn)), self.biases, symmetric(covariance)
        )


def symmetric(covariance: FloatArray) -> FloatArray:
    """The covariance, made symmetric again after rounding."""
    return 0.5 * (covariance + covariance.T)
