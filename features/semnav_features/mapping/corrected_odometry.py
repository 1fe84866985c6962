"""Odometry whose drift is corrected by walls, corners and columns that are seen again."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from semnav_features.checked_fields import Bounds, check_fields
from semnav_features.extraction import extract
from semnav_features.frames import ORIGIN, FloatArray, Pose, compose
from semnav_features.mapping.landmark_map import LandmarkMap
from semnav_features.mapping.landmark_settings import LandmarkSettings
from semnav_features.memory import SceneMemory
from semnav_features.scan import Scan


@dataclass(frozen=True)
class StepErrors:
    """Standard deviations of odometry from one scan to the next, a constant and a part that grows.

    Attributes:
        position: of the place, metres, however short the step.
        per_metre: what each metre adds, metres.
        angle: of the heading, radians, however small the turn.
        per_radian: what each radian adds, radians.

    Raises:
        ValueError: one of them is out of its range; names it and its range.
    """

    position: Annotated[float, Bounds(1e-4, 10.0)] = 0.01
    per_metre: Annotated[float, Bounds(0.0, 10.0)] = 0.02
    angle: Annotated[float, Bounds(1e-4, 10.0)] = 0.004
    per_radian: Annotated[float, Bounds(0.0, 10.0)] = 0.03

    def __post_init__(self) -> None:
        check_fields(self)

    def information(self, moved: Pose) -> FloatArray:
        """Inverse covariance of x, y and heading after a motion, shape (3, 3)."""
        position = self.position + self.per_metre * math.hypot(moved[0], moved[1])
        angle = self.angle + self.per_radian * abs(moved[2])
        return np.diag((position**-2, position**-2, angle**-2))


class CorrectedOdometry:
    """The pose of a lidar from odometry, corrected by what it sees again.

    First the walls correct it (`SceneMemory.locate`), which say nothing of the place along a
    corridor; then the landmarks do (`LandmarkMap.locate`), which do. What no wall or landmark
    determines stays as odometry has it. Loops are closed only where the drift is still small
    enough for a landmark to be recognised.

    Args:
        start: pose at the first scan.
        landmarks: whether corners and arcs correct it, too, or walls alone.
        errors: of the odometry from scan to scan.
        settings: of the landmarks.

    Attributes:
        pose: at the last scan.
        landmarks: the map of landmarks; None if walls alone correct.
        matched: number of landmarks that corrected the last pose.
    """

    pose: Pose
    landmarks: LandmarkMap | None
    matched: int

    def __init__(
        self,
        start: Pose = ORIGIN,
        landmarks: bool = True,
        errors: StepErrors = StepErrors(),
        settings: LandmarkSettings = LandmarkSettings(),
    ) -> None:
        self.pose = start
        self.landmarks = LandmarkMap(settings) if landmarks else None
        self.matched = 0
        self._walls = SceneMemory()
        self._errors = errors

    def update(self, scan: Scan, moved: Pose = ORIGIN) -> Pose:
        """Process the next scan, and return its pose.

        Args:
            scan: the scan.
            moved: its pose in the frame of the scan before by odometry; that of the first counts
                from the start.
        """
        scene = extract(scan)
        pose = self._walls.locate(scene, compose(self.pose, moved))
        if self.landmarks is not None:
            fix = self.landmarks.locate(scene, scan, pose, self._errors.information(moved))
            pose, self.matched = fix.pose, fix.matched
            self.landmarks.add(scene, scan, pose)
        self._walls.see(scene, scan, pose)
        self.pose = pose
        return pose
