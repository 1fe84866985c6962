"""Logs of BreezySLAM's examples: a Hokuyo URG-04LX, one scan in each line.

A line is whole numbers: the time in microseconds, 23 fields of the robot (its wheels' counts among
them, not used here), 682 ranges in millimetres, 0 for a missing return, and at most one more
number. The scanner takes 1024 steps a turn, of which it measures 44 to 725; step 384 looks forward
(Hokuyo, URG-04LX specifications).
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from semnav_features.readers.geometry import Geometry, checked_scan
from semnav_features.readers.log import BadRecordError, LogRecord
from semnav_features.readers.text import TextFile, TextLog
from semnav_features.scan import Scan

_FIRST, _BEAMS, _FORWARD = 24, 682, 340
_SPACING = 360.0 / 1024.0
_REACH = 5.6


def is_breezyslam(head: bytes) -> bool:
    """Whether a text that begins so is a log of BreezySLAM's."""
    fields = head[: head.find(b"\n")].split() if b"\n" in head else head.split()[:-1]
    return len(fields) >= _FIRST + _BEAMS and all(field.isdigit() for field in fields[:2])


class BreezySlamLog(TextLog):
    """An open log of BreezySLAM's; see `ScanLog`. There are no poses in it.

    Args:
        text: the file.
        geometry: what differs from the URG-04LX.
    """

    expected = "BreezySLAM's lines of 706 or 707 whole numbers"

    def __init__(self, text: TextFile, geometry: Geometry) -> None:
        super().__init__(text)
        self._step = math.radians(geometry.beam_spacing or _SPACING)
        self._range_max = geometry.nearer(_REACH)

    def records(self) -> Iterator[LogRecord]:
        """The records that are left."""
        for number, line in self._text.lines():
            if fields := line.split():
                try:
                    yield LogRecord(self._scan(fields), None, None, number)
                except BadRecordError as error:
                    self.count_bad(str(error), number)

    def _scan(self, fields: list[bytes]) -> Scan:
        if len(fields) not in (_FIRST + _BEAMS, _FIRST + _BEAMS + 1):
            raise BadRecordError("not 706 or 707 fields")
        try:
            stamp = int(fields[0]) * 1e-6
            ranges = np.array([float(field) for field in fields[_FIRST : _FIRST + _BEAMS]])
        except (ValueError, OverflowError):
            raise BadRecordError("a field that is not a number") from None
        start = -_FORWARD * self._step
        return checked_scan(ranges * 1e-3, start, self._step, self._range_max, stamp)
