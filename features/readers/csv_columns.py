"""The rows of a CSV log, and what their columns mean."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from semnav_env.features.frames import FloatArray, Pose
from semnav_env.features.readers.geometry import checked_pose
from semnav_env.features.readers.log import BadRecordError, LogError
from semnav_env.features.validation import shown

_MEANINGS = {
    "stamp": ("stamp", "time", "timestamp", "t"),
    "nanoseconds": ("%time",),
    "x": ("x",),
    "y": ("y",),
    "theta": ("theta", "yaw", "heading"),
    "angle_min": ("angle_min",),
    "angle_increment": ("angle_increment",),
    "range_min": ("range_min",),
    "range_max": ("range_max",),
}
_RANGE = re.compile(r"(r|ranges?|beams?|d|dist|distances?)?[\W_]*\d+\]?\Z")
_SEPARATORS = (b",", b";", b"\t")
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"


@dataclass(frozen=True)
class Columns:
    """Where to find what in the rows of a CSV log.

    Attributes:
        count: how many columns there are.
        ranges: columns of the ranges, in order, shape (beams,).
        places: column of everything else, by its meaning.
    """

    count: int
    ranges: NDArray[np.intp]
    places: dict[str, int]

    @classmethod
    def of(cls, cells: list[bytes]) -> Self:
        """The columns, by the first row: nothing but ranges unless it is a header.

        Raises:
            LogError: a header names no ranges, or a meaning twice.
        """
        if not is_header(cells):
            return cls(len(cells), np.arange(len(cells)), {})
        names = [_short(cell) for cell in cells]
        ranges = [place for place, name in enumerate(names) if _RANGE.match(name)]
        if not ranges:
            raise LogError(
                f"no column of ranges among {shown(', '.join(names[:8]))}; name them r0, r1, ..."
            )
        places: dict[str, int] = {}
        for meaning, known in _MEANINGS.items():
            matches = [place for place, name in enumerate(names) if name in known]
            if len(matches) > 1:
                raise LogError(f"{len(matches)} columns that mean {meaning!r}; keep one")
            if matches:
                places[meaning] = matches[0]
        return cls(len(names), np.array(ranges), places)

    def row(self, cells: list[bytes]) -> FloatArray:
        """The numbers of a row, shape (count,); NaN in columns without a meaning.

        Raises:
            BadRecordError: too many cells or too few, or one that holds no number.
        """
        if len(cells) != self.count:
            raise BadRecordError("not as many cells as the first row")
        row = np.full(self.count, np.nan)
        used = [*self.ranges.tolist(), *self.places.values()]
        row[used] = _numbers([cells[place] for place in used])
        return row

    def number(self, row: FloatArray, meaning: str) -> float | None:
        """What a row says of `meaning`; None if it has no such column."""
        return float(row[self.places[meaning]]) if meaning in self.places else None

    def stamp(self, row: FloatArray) -> float | None:
        """Time of a row in seconds."""
        nanoseconds = self.number(row, "nanoseconds")
        return self.number(row, "stamp") if nanoseconds is None else nanoseconds * 1e-9

    def pose(self, row: FloatArray) -> Pose | None:
        """Pose of a row; None without columns x, y and theta.

        Raises:
            BadRecordError: it is not finite.
        """
        x, y, theta = (self.number(row, name) for name in ("x", "y", "theta"))
        return None if x is None or y is None or theta is None else checked_pose(x, y, theta)


def cells_of(line: bytes) -> list[bytes]:
    """The cells of a line, at commas, semicolons or tabs, whichever there are more of."""
    separator = max(_SEPARATORS, key=line.count)
    return line.removeprefix(_BYTE_ORDER_MARK).strip(b"\r\n ").split(separator)


def _numbers(cells: list[bytes]) -> FloatArray:
    """The numbers of a row, NaN for an empty cell.

    Raises:
        BadRecordError: a cell holds something else.
    """
    try:
        return np.array([float(cell) if cell.strip() else np.nan for cell in cells])
    except ValueError:
        raise BadRecordError("a cell that is not a number") from None


def is_header(cells: list[bytes]) -> bool:
    """Whether a first row is one of names, or counts its columns from 0, as pandas does.

    A column without a name before those that are counted is pandas' index.
    """
    try:
        _numbers(cells)
    except BadRecordError:
        return True
    named = cells if cells[0].strip() else cells[1:]
    counted = [cell.strip() for cell in named]
    return len(counted) > 1 and counted == [b"%d" % place for place in range(len(counted))]


def _short(cell: bytes) -> str:
    """A name without quotes and the path that `rostopic echo -p` puts before it."""
    return cell.decode("utf-8", "replace").strip(" \"'").lower().rpartition(".")[2]
