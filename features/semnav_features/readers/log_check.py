"""Finds errors of a whole log, even if each of its scans can be read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal, TypeAlias

import numpy as np

from semnav_features.readers.log import LogRecord
from semnav_features.readers.pose_check import PoseCheck
from semnav_features.readers.stamp_check import StampCheck
from semnav_features.scan import typical_length

PoseSource: TypeAlias = Literal["pose", "odometry"]
"""A field of `LogRecord` with the pose of a scan."""


class LogCheck:
    """Checks the records of a log while they are read.

        check = LogCheck(log.unit)
        for record in check.watched(log):
            ...
        for note in check.notes():
            print(note)

    Args:
        unit: what `LogRecord.line` counts.
        uses: sources of the poses that are used; only these are checked.
    """

    def __init__(self, unit: str, uses: Iterable[PoseSource] = ("pose", "odometry")) -> None:
        self._unit = unit
        self._poses = {source: PoseCheck(source, unit) for source in uses}
        self._stamps = StampCheck(unit)
        self._scans = self._far_scans = self._first_far = 0
        self._typical = self._range_max = 0.0

    def watched(self, records: Iterable[LogRecord]) -> Iterator[LogRecord]:
        """The records themselves."""
        for record in records:
            self.look(record)
            yield record

    def look(self, record: LogRecord) -> None:
        """Check the next record."""
        self._look_at_ranges(record)
        self._stamps.look(record)
        for source, check in self._poses.items():
            if (pose := getattr(record, source)) is not None:
                check.look(pose, record)

    def notes(self) -> list[str]:
        """The notes, one line each, with the begin of the error and advice."""
        notes = [each for check in self._poses.values() for each in check.notes()]
        return [*self._range_notes(), *notes, *self._stamps.notes()]

    def _look_at_ranges(self, record: LogRecord) -> None:
        scan = record.scan
        self._scans += 1
        if np.count_nonzero(scan.ranges >= scan.range_max) <= 0.25 * len(scan.ranges):
            return  # spares most scans the sorting
        typical = typical_length(scan.ranges)
        if typical >= scan.range_max:
            self._far_scans += 1
            if not self._first_far:
                self._first_far = record.line
                self._typical, self._range_max = typical, scan.range_max

    def _range_notes(self) -> Iterator[str]:
        if self._far_scans > 0.5 * self._scans:
            yield (
                f"{self._unit} {self._first_far}: most ranges lie beyond {self._range_max:g} m, "
                f"their median is {self._typical:.4g}, and so in {self._far_scans} of "
                f"{self._scans} scans; they count as no return: divide centimetres by 100, or "
                "give a larger --range-max"
            )
