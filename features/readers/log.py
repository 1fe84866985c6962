"""What every reader of scan logs gives: records, and clear errors."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from types import TracebackType
from typing import Protocol, Self

from semnav_env.features.frames import Pose
from semnav_env.features.scan import Scan


class LogError(ValueError):
    """A file that cannot be read as a log of scans; says why and what would do."""


class TruncatedLogError(LogError):
    """A compressed log that ends too early or is damaged; what came before it was yielded."""


@dataclass(frozen=True, slots=True)
class LogRecord:
    """One scan of a log, and where it was taken.

    Attributes:
        scan: the scan, in the frame of the lidar.
        pose: of the lidar in the log's frame, metres and radians; the corrected pose where the
            log is a corrected one.
        odometry: of the robot as the wheels count it; None before the log's first.
        line: line number in the log, from 1.
    """

    scan: Scan
    pose: Pose
    odometry: Pose | None
    line: int

    @property
    def stamp(self) -> float | None:
        """Time of the scan in seconds, on the log's clock."""
        return self.scan.stamp


class ScanLog(Protocol):
    """An open log, read once from beginning to end, one record in memory at a time.

    Attributes:
        scans: how many records were yielded so far.
        bad: how many lines were passed over so far, by reason.
        first_bad: the first line number of each reason.
    """

    scans: int
    bad: Counter[str]
    first_bad: dict[str, int]

    @property
    def fraction(self) -> float | None:
        """How much of the file has been read, 0 to 1; None where its size is unknown."""

    def __iter__(self) -> Iterator[LogRecord]:
        """The records that are left, in the order of the log."""

    def __enter__(self) -> Self:
        """The log itself."""

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the file."""
