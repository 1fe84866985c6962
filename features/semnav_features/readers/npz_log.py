"""Logs as NumPy's npz archives: an array of ranges, one scan a row."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import ClassVar

from semnav_features.frames import FloatArray
from semnav_features.readers.geometry import (
    Geometry,
    checked_pose,
    checked_scan,
    stamp_in_seconds,
)
from semnav_features.readers.log import BadRecordError, LogError, LogReader, LogRecord
from semnav_features.readers.npz_arrays import NpzArrays
from semnav_features.validation import shown


class NpzLog(LogReader):
    """An open npz log; see `ScanLog`.

    Arrays: `ranges` (n, beams) in metres; `angle_min` and `angle_increment` in radians; and if
    they are there `range_min` and `range_max` in metres, `stamps` (n,) in seconds and `poses`
    (n, 3) of the lidar. Nothing in the file is unpickled.

    Args:
        path: the file.
        geometry: what the file leaves unsaid.

    Raises:
        LogError: an array is missing or has another shape.
        DamageError: the archive is not whole.
    """

    unit: ClassVar[str] = "row"
    expected = "an array `ranges` with a row for each scan"

    def __init__(self, path: Path, geometry: Geometry) -> None:
        super().__init__(path)
        self._read = 0
        self._arrays = NpzArrays(path)
        try:
            self._open(geometry)
        except BaseException:
            self._arrays.close()
            raise

    @property
    def fraction(self) -> float | None:
        """Share of the rows that have been read, 0 to 1; None without rows."""
        return self._read / self._count if self._count else None

    def records(self) -> Iterator[LogRecord]:
        """The records that are left."""
        for row in self._arrays.rows("ranges"):
            self._read += 1
            try:
                yield self._record(row, self._read)
            except BadRecordError as error:
                self.count_bad(str(error), self._read)

    def close(self) -> None:
        """Close the file."""
        self._arrays.close()

    def _open(self, geometry: Geometry) -> None:
        shape = self._arrays.shape("ranges")
        if len(shape) != 2:
            raise LogError(
                f"{self.path}: array 'ranges' has shape {shown(shape)}; it must be (scans, beams)"
            )
        self._count = shape[0]
        self._start = self._angle("angle_min", geometry.angle_min)
        self._step = self._angle("angle_increment", geometry.angle_increment)
        self._limits = (
            geometry.nearer(self._arrays.number("range_max") or math.inf),
            self._arrays.number("range_min") or 0.05,
        )
        self._stamps = self._arrays.table("stamps", (self._count,))
        self._poses = self._arrays.table("poses", (self._count, 3))

    def _angle(self, name: str, given: float | None) -> float:
        angle = self._arrays.number(name) if given is None else given
        if angle is None:
            raise LogError(
                f"{self.path} has no array {name!r}; give {name} in radians, or save it with the "
                "ranges: np.savez(path, ranges=..., angle_min=..., angle_increment=...)"
            )
        return angle

    def _record(self, row: FloatArray, number: int) -> LogRecord:
        range_max, range_min = self._limits
        stamp = None if self._stamps is None else stamp_in_seconds(float(self._stamps[number - 1]))
        pose = None if self._poses is None else checked_pose(*self._poses[number - 1].tolist())
        scan = checked_scan(row, self._start, self._step, range_max, stamp, range_min)
        return LogRecord(scan, pose, None, number)
