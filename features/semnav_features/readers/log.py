"""Records and errors of all readers of scan logs."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import ClassVar, Protocol, Self

from semnav_features.frames import Pose
from semnav_features.scan import Scan


class LogError(ValueError):
    """A file cannot be read as a log of scans; the message says why and what can be read."""


class TruncatedLogError(LogError):
    """A log is truncated or damaged; its readable records were yielded."""


class BadRecordError(ValueError):
    """One record that cannot be read; the message is the same for all records of its fault."""


class DamageError(Exception):
    """The data of a log cannot be read any further."""


@dataclass(frozen=True, slots=True)
class LogRecord:
    """One scan of a log, with its pose.

    Attributes:
        scan: the scan, in the frame of the lidar.
        pose: of the lidar in the log's frame, metres and radians; the corrected pose where the
            log is a corrected one, None where it has none.
        odometry: of the robot as the wheels count it; None before the log's first.
        line: number in the log, from 1: the line of a text, the row of an array, the number of
            the message on its topic.
    """

    scan: Scan
    pose: Pose | None
    odometry: Pose | None
    line: int

    @property
    def stamp(self) -> float | None:
        """Time of the scan in seconds, on the log's clock; None where it has none."""
        return self.scan.stamp


class ScanLog(Protocol):
    """An open log, read once from beginning to end, one record in memory at a time.

    Attributes:
        unit: what the log consists of and `LogRecord.line` counts: line, row or message.
        scans: number of records yielded so far.
        bad: number of units skipped so far, by reason.
        first_bad: the number of the first unit of each reason.
    """

    unit: ClassVar[str]
    scans: int
    bad: Counter[str]
    first_bad: dict[str, int]

    @property
    def fraction(self) -> float | None:
        """Share of the log that has been read, 0 to 1; None if its size is unknown."""

    def __iter__(self) -> Iterator[LogRecord]:
        """The records that are left, in the order of the log."""
        ...

    def __enter__(self) -> Self:
        """The log itself."""
        ...

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the file."""


class LogReader(ABC):
    """Base class of the readers of all formats; a reader defines how records are read.

    Iterating raises `LogError` if there is no scan, and `TruncatedLogError` after the last
    readable record if the data are damaged or end too early.
    """

    path: Path
    scans: int
    unit: ClassVar[str] = "line"
    expected: ClassVar[str]
    """Contents of a log of this format, for the error about a log without them."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.scans = 0
        self.bad: Counter[str] = Counter()
        self.first_bad: dict[str, int] = {}

    @property
    @abstractmethod
    def fraction(self) -> float | None:
        """Share of the log that has been read; see `ScanLog`."""

    @abstractmethod
    def records(self) -> Iterator[LogRecord]:
        """The records that are left; raises `DamageError` where the data can be read no more."""

    @abstractmethod
    def close(self) -> None:
        """Close the file."""

    def count_bad(self, reason: str, number: int) -> None:
        """Note that a unit of the log was skipped."""
        self.bad[reason] += 1
        self.first_bad.setdefault(reason, number)

    def __iter__(self) -> Iterator[LogRecord]:
        """The records that are left, in the order of the log."""
        try:
            for record in self.records():
                self.scans += 1
                yield record
        except DamageError:
            raise TruncatedLogError(
                f"{self.path} is truncated or damaged: its data could be read up to scan "
                f"{self.scans}; copy or download it again"
            ) from None
        if not self.scans:
            raise LogError(
                f"{self.path} holds no laser scan; expected {self.expected}"
                + "".join(f"; {n} x {reason}" for reason, n in self.bad.most_common(3))
            )

    def __enter__(self) -> Self:
        """The log itself."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Close the file."""
        self.close()
