"""Localises a robot in a known floor plan: odometry, corrected by the doors that it detects."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from heapq import nsmallest
from typing import Annotated

import numpy as np

from semnav_env.mind.localization.dead_reckoning import OdometryErrors, ReckonedState
from semnav_env.mind.localization.door_fit import fitted
from semnav_env.mind.localization.door_pose import check_detected, is_covariance
from semnav_features.checked_fields import Bounds, Length, Share, check_fields
from semnav_features.clouds.detected_door import DetectedDoor, expect_door, frame_of
from semnav_features.elements import Door
from semnav_features.frames import FloatArray, Pose, to_parent

GATES = {2: 5.99, 4: 9.49}
"""Squared Mahalanobis distance within which 95 % of right matches lie, by the number of
coordinates: quantiles of the chi-squared distribution. A right door that is refused costs little,
for it is seen again a step later."""

COMPARED_DOORS = 3
"""Number of doors of the plan with which a detected one is compared: the nearest ones."""


@dataclass(frozen=True)
class LocalizerRules:
    """Settings of the choice of detected doors that correct the pose.

    Attributes:
        least_confidence: of a detection, 0 to 1.
        plan_sigma: standard deviation of a jamb in the plan from where it was built, metres.
        margin: by so much the squared Mahalanobis distance to the second nearest door of the plan
            must exceed that to the nearest. 9: at equal shapes of the covariances the nearest one
            is then exp(4.5) = 90 times as likely.
    """

    least_confidence: Share = 0.3
    plan_sigma: Length = 0.02
    margin: Annotated[float, Bounds(0.0, 1e6)] = 9.0

    def __post_init__(self) -> None:
        check_fields(self)


class PlanLocalizer:
    """Extended Kalman filter over the pose of a robot whose floor plan is known.

        localizer = PlanLocalizer(plan.scene.doors, start, SPOT_ODOMETRY)
        localizer.move(odometry)                    # in each control period
        for door, sigma in localizer.expected(reach=3.0):
            detected = finder.find_door(cloud, door, sigma)
            if detected is not None:
                localizer.correct(detected)

    The biases of odometry are part of the state (`ReckonedState`), so that doors calibrate it.

    Args:
        doors_world: of the plan, world frame; anything with `start` and `end`.
        start: believed pose at the first `move`, world frame.
        errors: how the odometry errs.
        start_covariance: of x, y (square metres) and heading, shape (3, 3); None: 5 cm and 1
            degree.
        rules: which doors correct the pose.

    Raises:
        ValueError: numbers that are not finite, a door without width, or a matrix that is no
            covariance.
    """

    doors_world: tuple[Door, ...]
    rules: LocalizerRules

    def __init__(
        self,
        doors_world: Sequence[Door],
        start: Pose,
        errors: OdometryErrors,
        start_covariance: FloatArray | None = None,
        rules: LocalizerRules = LocalizerRules(),
    ) -> None:
        if start_covariance is None:
            start_covariance = np.diag([0.05**2, 0.05**2, math.radians(1.0) ** 2])
        if start_covariance.shape != (3, 3) or not is_covariance(start_covariance):
            raise ValueError("start_covariance is 3 x 3, symmetric and not negative")
        _check_finite("start", start)
        for door in doors_world:
            frame_of(door)
        self.doors_world, self.rules = tuple(doors_world), rules
        self._errors = errors
        self._state = ReckonedState.at(start, start_covariance, errors)
        self._odometry: Pose | None = None

    @property
    def pose(self) -> Pose:
        """Believed pose of the robot's centre, world frame."""
        return self._state.pose

    @property
    def covariance(self) -> FloatArray:
        """Of x, y (square metres) and heading, shape (3, 3)."""
        return self._state.covariance[:3, :3].copy()

    def move(self, odometry: Pose, touching: bool = False) -> None:
        """Advance by the motion since the last call; the first call gives the origin.

        Args:
            odometry: pose by dead reckoning, any fixed frame.
            touching: whether the body touches something: then odometry slips.

        Raises:
            ValueError: odometry that is not finite.
        """
        _check_finite("odometry", odometry)
        if self._odometry is not None:
            self._state = self._state.moved(self._odometry, odometry, self._errors, touching)
        self._odometry = odometry

    def expected(self, reach: float) -> Iterator[tuple[Door, float]]:
        """Yield the doors of the plan within reach, with the standard deviation of their jambs.

        Args:
            reach: largest distance to the middle of a door, metres.

        Yields:
            A door, and the standard deviation of its jambs in metres: what a detector takes.
        """
        for door in self.doors_world:
            if math.dist(door.midpoint, self.pose[:2]) <= reach:
                yield expect_door(door, self.pose, self.covariance)

    def correct(self, detected: DetectedDoor) -> Door | None:
        """Correct the pose by a detected door.

        It is matched with the door of the plan that has the least Mahalanobis distance (Thrun,
        Burgard and Fox 2005, table 7.3, lines 9 to 16).

        Args:
            detected: robot frame; its start belongs to the start of that door, as in `expected`.

        Returns:
            The door of the plan that it is; None if no door lies within the gate, if another one
            is nearly as near, or if it is too doubtful; then nothing is corrected.

        Raises:
            ValueError: see `check_detected`.
        """
        check_detected(detected)
        if detected.confidence < self.rules.least_confidence or not self.doors_world:
            return None
        sigma = self.rules.plan_sigma
        fits = [fitted(self._state, door, detected, sigma) for door in self._nearest(detected)]
        best, *others = sorted(fits, key=lambda fit: fit.distance)
        gate = GATES[4 if detected.is_whole else 2]
        if best.distance > gate or any(
            other.distance < best.distance + self.rules.margin for other in others
        ):
            return None
        self._state = best.state
        return best.door

    def _nearest(self, detected: DetectedDoor) -> list[Door]:
        """The doors of the plan whose middles lie nearest to that of a detected one."""
        middle = to_parent(self.pose, detected.midpoint)
        return nsmallest(
            COMPARED_DOORS, self.doors_world, lambda door: math.dist(door.midpoint, middle)
        )


def _check_finite(name: str, pose: Pose) -> None:
    if not all(map(math.isfinite, pose)):
        raise ValueError(f"{name} is {pose}; it must be three finite numbers")
