"""Logs as comma-separated values, with one scan in each row."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

from semnav_features.frames import FloatArray
from semnav_features.readers.csv_columns import (
    Columns,
    cells_of,
    is_header,
    is_passed_over,
    separator_of,
)
from semnav_features.readers.geometry import Geometry, checked_scan
from semnav_features.readers.log import BadRecordError, LogError, LogRecord
from semnav_features.readers.text import TextFile, TextLog
from semnav_features.scan import Scan
from semnav_features.validation import shown

_ANGLES = ("angle_min", "angle_increment")
_SETTING = re.compile(
    rb"(angle_min|angle_increment|range_min|range_max)\s*[=:]\s*([^\s,;]+(?:,\d[^\s,;]*)?)"
)


def is_csv(head: bytes) -> bool:
    """Whether a text that begins so is a table of numbers, or of columns that hold ranges."""
    for line in head.splitlines(keepends=True):
        if not (is_passed_over(line) or line.startswith(b"#")):
            if not line.endswith(b"\n"):
                line = line[: line.rfind(separator_of(line))]  # its last cell may be cut
            try:
                return Columns.of(line).count > 1
            except LogError:
                return False
    return False


class CsvLog(TextLog):
    """An open CSV log; see `ScanLog`.

    The columns are ranges in metres, or what a header names (see `Columns`). The angles come
    from `geometry`, else from columns, else from a comment before the first row such as

        # angle_min=-2.356 angle_increment=0.0058 range_max=10

    Args:
        text: the file.
        geometry: values that the file does not contain.
    """

    expected = "rows of ranges, separated by commas"

    def __init__(self, text: TextFile, geometry: Geometry) -> None:
        super().__init__(text)
        self._geometry = geometry
        self._said: dict[str, float] = {}

    def records(self) -> Iterator[LogRecord]:
        """The records that are left; raises `LogError` if nothing says the angles."""
        columns: Columns | None = None
        for number, line in self._text.lines():
            if line.startswith(b"#"):
                self._hear(line, number)
                continue
            if is_passed_over(line):
                continue
            if columns is None:
                columns = self._columns(line)
                if is_header(cells_of(line, columns.separator)):
                    continue
            try:
                yield self._record(columns, line, number)
            except BadRecordError as error:
                self.count_bad(str(error), number)

    def _hear(self, comment: bytes, number: int) -> None:
        for name, value in _SETTING.findall(comment):
            try:
                self._said[name.decode()] = float(value.replace(b",", b"."))
            except ValueError:
                said = shown(value.decode("ascii", "replace"))
                raise LogError(
                    f"{self.path}, line {number}: {name.decode()} is {said}; it must be a "
                    "number, in metres or radians"
                ) from None

    def _columns(self, line: bytes) -> Columns:
        try:
            columns = Columns.of(line)
        except LogError as error:
            raise LogError(f"{self.path}: {error}") from None
        for name in _ANGLES:
            if not (name in self._said or name in columns.places or self._given(name) is not None):
                raise LogError(
                    f"{self.path} does not say where its beams point; give angle_min and "
                    "angle_increment in radians, or make its first line "
                    "`# angle_min=-2.356 angle_increment=0.0058`"
                )
        return columns

    def _record(self, columns: Columns, line: bytes, number: int) -> LogRecord:
        row = columns.row(line)
        return LogRecord(self._scan(columns, row), columns.pose(row), None, number)

    def _scan(self, columns: Columns, row: FloatArray) -> Scan:
        def said(name: str, otherwise: float = math.nan) -> float:
            for value in (self._given(name), columns.number(row, name), self._said.get(name)):
                if value is not None:
                    return value
            return otherwise

        return checked_scan(
            row[columns.ranges],
            said("angle_min"),
            said("angle_increment"),
            self._geometry.nearer(said("range_max", math.inf)),
            columns.stamp(row),
            said("range_min", 0.05),
        )

    def _given(self, name: str) -> float | None:
        return getattr(self._geometry, name) if name in _ANGLES else None
