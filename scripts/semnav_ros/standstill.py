"""Notices a robot that is told to move and does not: motors that are off, or a wheel that spins."""

from __future__ import annotations

import math

from semnav_features.frames import ORIGIN, Pose, Twist, wrap_angle

PATIENCE = 3.0
"""Time of being told to move after which a robot that did not is reported, seconds."""

MOVED = 0.02
"""What counts as having moved, metres or radians."""

SLOW = 0.05
"""Largest speed that counts as standing still, m/s or rad/s."""


class StandstillWatch:
    """Compares what a robot is told with what its odometry says."""

    def __init__(self) -> None:
        self._since, self._at = math.inf, ORIGIN

    def stands(self, stamp: float, pose: Pose, told: Twist) -> bool:
        """Whether the robot has stood for `PATIENCE`, although it was told to move all the time.

        Args:
            stamp: of the scan, seconds.
            pose: by odometry.
            told: the velocity that it is told now.
        """
        x, y, heading = pose
        far = math.dist((x, y), self._at[:2]) > MOVED
        turned = abs(wrap_angle(heading - self._at[2])) > MOVED
        rests = max(map(abs, told)) <= SLOW
        if far or turned or rests or stamp < self._since:
            self._since, self._at = stamp, pose
        return stamp - self._since > PATIENCE
