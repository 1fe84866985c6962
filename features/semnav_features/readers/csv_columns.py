"""The rows of a CSV log, and the meaning of their columns."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray, Pose
from semnav_features.readers.geometry import checked_pose, stamp_in_seconds
from semnav_features.readers.log import BadRecordError, LogError
from semnav_features.validation import shown

_MEANINGS = {
    "stamp": ("stamp", "time", "timestamp", "t"),
    "nanoseconds": ("%time", "stamp_ns", "time_ns", "timestamp_ns"),
    "whole_seconds": ("sec", "secs"),
    "further_nanoseconds": ("nanosec", "nsec", "nsecs"),
    "x": ("x",),
    "y": ("y",),
    "theta": ("theta", "yaw", "heading"),
    "angle_min": ("angle_min",),
    "angle_increment": ("angle_increment",),
    "range_min": ("range_min",),
    "range_max": ("range_max",),
}
_RANGE = re.compile(r"(r|ranges?|beams?|d|dist|distances?)?[\W_]*[0-9]{1,9}\]?\Z")
_NUMBER_IN_NAME = re.compile(r"(-?(?:[0-9]+\.)?[0-9]+)\W*\Z")
_NAME_END = 40
"""Last characters of a column's name in which its number is looked for: the search takes time that
grows with the square of their count."""

_SEPARATORS = (b",", b";", b"\t")
_DECIMAL_COMMA = re.compile(rb"\s*\"?[+-]?\d*,\d+([eE][+-]?\d+)?\"?\s*\Z")
_NO_COMMA = re.compile(rb"[^,]*\Z")
_BYTE_ORDER_MARK = b"\xef\xbb\xbf"


@dataclass(frozen=True)
class Columns:
    """The meaning of the columns of a CSV log.

    Attributes:
        separator: separator of the cells of all rows.
        count: number of columns.
        ranges: columns of the ranges, in order, shape (beams,).
        places: column of each other value, by its meaning.
    """

    separator: bytes
    count: int
    ranges: NDArray[np.intp]
    places: dict[str, int]

    @classmethod
    def of(cls, line: bytes) -> Self:
        """The columns, by the first row: nothing but ranges unless it is a header.

        Raises:
            LogError: a header names no ranges, or in no order, a meaning twice, or half a pose.
        """
        separator = separator_of(line)
        cells = cells_of(line, separator)
        if not is_header(cells):
            return cls(separator, len(cells), np.arange(len(cells)), {})
        names = [_short(cell) for cell in cells]
        ranges = [place for place, name in enumerate(names) if _RANGE.match(name)]
        if not ranges:
            raise LogError(
                f"no column of ranges among {shown(', '.join(names[:8]))}; name them r0, r1, ..."
            )
        if not _is_in_order([cells[place] for place in ranges]):
            few = b", ".join(cells[place].strip() for place in ranges[:8])
            raise LogError(
                f"the columns of ranges, {shown(few.decode('utf-8', 'replace'))}, are not numbered "
                "in equal steps; put them in the order of the beams, with none left out, under a "
                "header that names them r0, r1, ..."
            )
        places: dict[str, int] = {}
        for meaning, known in _MEANINGS.items():
            matches = [place for place, name in enumerate(names) if name in known]
            if len(matches) > 1:
                raise LogError(f"{len(matches)} columns that mean {meaning!r}; keep one")
            if matches:
                places[meaning] = matches[0]
        if {"x", "y"} <= places.keys() and "theta" not in places:
            raise LogError(
                "columns x and y without a heading make no pose; add the heading, in radians, as "
                f"{' or '.join(_MEANINGS['theta'])}, or leave x and y out"
            )
        return cls(separator, len(names), np.array(ranges), places)

    def row(self, line: bytes) -> FloatArray:
        """The numbers of a row, shape (count,); NaN in columns without a meaning.

        Raises:
            BadRecordError: too many cells or too few, or one that holds no number.
        """
        cells = cells_of(line, self.separator)
        if len(cells) != self.count:
            raise BadRecordError("not as many cells as the first row")
        row = np.full(self.count, np.nan)
        used = [*self.ranges.tolist(), *self.places.values()]
        row[used] = _numbers([cells[place] for place in used])
        return row

    def number(self, row: FloatArray, meaning: str) -> float | None:
        """The value of a row for `meaning`; None if it has no such column."""
        return float(row[self.places[meaning]]) if meaning in self.places else None

    def stamp(self, row: FloatArray) -> float | None:
        """Time of a row in seconds.

        Raises:
            BadRecordError: it is too large to be seconds.
        """
        nanoseconds = self.number(row, "nanoseconds")
        if nanoseconds is not None:
            return nanoseconds * 1e-9
        stamp = self.number(row, "stamp")
        if stamp is None and (stamp := self.number(row, "whole_seconds")) is not None:
            stamp += 1e-9 * (self.number(row, "further_nanoseconds") or 0.0)
        return None if stamp is None else stamp_in_seconds(stamp)

    def pose(self, row: FloatArray) -> Pose | None:
        """Pose of a row; None without columns x, y and theta.

        Raises:
            BadRecordError: it is not finite.
        """
        x, y, theta = (self.number(row, name) for name in ("x", "y", "theta"))
        return None if x is None or y is None or theta is None else checked_pose(x, y, theta)


def is_passed_over(line: bytes) -> bool:
    """Whether a line holds no row: it is empty, or Excel's `sep=;`."""
    return not line.strip() or line.removeprefix(_BYTE_ORDER_MARK).lower().startswith(b"sep=")


def separator_of(line: bytes) -> bytes:
    """The separator of the cells of a line: the most frequent of commas, semicolons and tabs.

    Commas in numbers, as in `2,51;2,50`, separate nothing.
    """
    for separator in _SEPARATORS[1:]:
        cells = cells_of(line, separator)
        if len(cells) > 1 and all(_DECIMAL_COMMA.match(c) or _NO_COMMA.match(c) for c in cells):
            return separator
    return max(_SEPARATORS, key=line.count)


def cells_of(line: bytes, separator: bytes) -> list[bytes]:
    """The cells of a line."""
    return line.removeprefix(_BYTE_ORDER_MARK).strip(b"\r\n ").split(separator)


def _numbers(cells: list[bytes]) -> FloatArray:
    """The numbers of a row, NaN for an empty cell; a comma in a cell is a decimal one.

    Raises:
        BadRecordError: a cell holds something else.
    """
    try:
        plain = [cell.strip(b' \t"').replace(b",", b".") for cell in cells]
        return np.array([float(cell) if cell else np.nan for cell in plain])
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


def _is_in_order(names: list[bytes]) -> bool:
    """Whether columns of ranges are numbered as beams are: upwards, and in steps of like size.

    A minus sign may belong to a number, as in degrees, or part it from the name.
    """
    ends = [name.decode("utf-8", "replace").strip(" \"'")[-_NAME_END:] for name in names]
    signed = [_NUMBER_IN_NAME.search(end) for end in ends]
    degrees = [float(found[1]) if found else np.nan for found in signed]
    counts = [float(re.findall(r"[0-9]+", end)[-1]) for end in ends]
    return len(names) == 1 or any(
        min(steps) > 0 and max(steps) < 2 * min(steps)
        for steps in (np.diff(degrees), np.diff(counts))
    )


def _short(cell: bytes) -> str:
    """A name without quotes and the path that `rostopic echo -p` puts before it."""
    return cell.decode("utf-8", "replace").strip(" \"'").lower().rpartition(".")[2]
