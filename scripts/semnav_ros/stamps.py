"""Judges the stamps of scans: a scan may come twice, late or not at all, and clocks may jump."""

from __future__ import annotations

from enum import Enum

from semnav_ros.messages import Counts

CLOCK_JUMP = 1.0
"""A stamp that is older than the last one by more than this says that the clock went back, seconds;
a scan that is less late was only held up on its way."""

LONGEST_GAP = 0.5
"""Longest time between two scans that the belief is told, seconds: after that the robot stands."""


class Arrival(Enum):
    """What the stamp of a scan says."""

    NEW = "new"
    DOUBLED = "doubled"
    LATE = "late"
    CLOCK_WENT_BACK = "clock went back"


class StampJudge:
    """Judges the stamps of scans in the order of their arrival.

    Args:
        counts: where doubled, late and lost scans and jumps of the clock are counted.
    """

    def __init__(self, counts: Counts) -> None:
        self._counts = counts
        self._last: float | None = None

    def judge(self, stamp: float, period: float) -> tuple[Arrival, float | None]:
        """What a stamp says, and the seconds since the last scan; None where it does not say them.

        Args:
            stamp: of the scan, seconds.
            period: of the lidar, seconds.
        """
        last = self._last
        if last is None:
            self._last = stamp
            return Arrival.NEW, None
        gap = stamp - last
        if gap == 0.0:
            self._counts.doubled += 1
            return Arrival.DOUBLED, None
        if -CLOCK_JUMP < gap < 0.0:
            self._counts.late += 1
            return Arrival.LATE, None
        self._last = stamp
        if gap < 0.0:
            self._counts.clock_jumps += 1
            return Arrival.CLOCK_WENT_BACK, None
        self._counts.lost += max(0, round(min(gap, LONGEST_GAP) / period) - 1)
        return Arrival.NEW, min(gap, LONGEST_GAP)
