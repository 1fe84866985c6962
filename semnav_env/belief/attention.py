"""When a clause is worth grounding anew: grounding at every scan would cost too much."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from semnav_env.features.frames import Pose

MemorySize = tuple[int, int]
"""How many remembered walls and doors count."""


@dataclass(frozen=True)
class AttentionLimits:
    """What makes a look due.

    Attributes:
        travel: distance since the last look, metres.
        heading_change: change of heading since the last look, radians.
        door_check: every so many scans a look is due if other doors count by then.
        rest_check: after so many scans a look is due if other walls count or the robot has moved.
        least_travel: less than this is not moved, metres.
        first_scans: number of the scan from which the first features count, see `SceneMemory`.
    """

    travel: float = 1.5
    heading_change: float = 0.5
    door_check: int = 5
    rest_check: int = 30
    least_travel: float = 0.2
    first_scans: int = 3


LIMITS = AttentionLimits()
_NOWHERE: Pose = (math.inf, math.inf, 0.0)


class Attention:
    """Remembers from where and on what the robot last grounded its clause."""

    def __init__(self) -> None:
        self._pose: Pose = _NOWHERE
        self._scan = 0
        self._size: MemorySize = (0, 0)

    def note(self, pose: Pose, scan: int, size: MemorySize) -> None:
        """A clause has been grounded.

        Args:
            pose: believed pose, odometry frame.
            scan: number of the scan.
            size: of the memory.
        """
        self._pose, self._scan, self._size = pose, scan, size

    def demand(self) -> None:
        """Make a look due at once."""
        self._pose = _NOWHERE

    def is_due(self, pose: Pose, scan: int, size: Callable[[], MemorySize]) -> bool:
        """Whether to ground anew.

        Args:
            pose: believed pose, odometry frame.
            scan: number of the scan.
            size: of the memory; counting takes time and is asked for only where it matters.
        """
        x, y, heading = self._pose
        moved = (pose[0] - x) ** 2 + (pose[1] - y) ** 2
        if moved > LIMITS.travel**2:
            return True
        if abs(math.remainder(pose[2] - heading, math.tau)) > LIMITS.heading_change:
            return True
        since = scan - self._scan
        if since % LIMITS.door_check and scan != LIMITS.first_scans:
            return False
        walls, doors = size()
        differs = walls != self._size[0] or moved > LIMITS.least_travel**2
        rested = since >= LIMITS.rest_check or scan == LIMITS.first_scans
        return doors != self._size[1] or (differs and rested)
