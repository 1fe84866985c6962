"""Values of scans that a log does not contain, and the check that every scan of a log passes."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, TypeAlias

from semnav_features.checked_fields import Bounds, check_fields
from semnav_features.frames import FloatArray, Pose
from semnav_features.readers.log import BadRecordError
from semnav_features.scan import MAX_RANGE, Scan

_FARTHEST = 4.0 * math.pi
Direction: TypeAlias = Annotated[float, Bounds(-_FARTHEST, _FARTHEST, "rad")]

_LATEST = 1e11
"""Largest accepted time in seconds: a date after the year 5000."""

_NANOSECONDS = (1e18, 1e19)
"""Numbers of 19 digits: nanoseconds since 1970, on a date from 2001 to 2286."""

_WIDEST = 3.0 * math.pi
"""Largest angle of a scan, radians: a turn and a half, because some scanners repeat beams."""


@dataclass(frozen=True, slots=True)
class Geometry:
    """Values of scans that a log does not contain.

    Attributes:
        range_max: ranges at or beyond it are missing returns, metres; a smaller limit in the log
            itself counts. SICK's scanners send 81.91 and some logs 50.
        beam_spacing: degrees between the beams of CARMEN's FLASER lines and BreezySLAM's logs,
            whose middle beam points forward; None to derive it from the number of beams.
        angle_min: direction of the first beam of CSV and npz logs, radians; None to take the
            log's own.
        angle_increment: angle between their beams, radians, negative if they run clockwise;
            None to take the log's own.

    Raises:
        ValueError: a field is no number, or out of its bounds; names it.
    """

    range_max: Annotated[float, Bounds(0.01, MAX_RANGE, "m")] = 50.0
    beam_spacing: Annotated[float | None, Bounds(1e-3, 360.0, "degrees")] = None
    angle_min: Direction | None = None
    angle_increment: Direction | None = None

    def __post_init__(self) -> None:
        check_fields(self)

    def nearer(self, range_max: float) -> float:
        """The log's own limit, metres, if it has one and that is the smaller."""
        return self.range_max if range_max <= 0 else min(range_max, self.range_max)


def checked_scan(
    ranges: FloatArray,
    start: float,
    step: float,
    range_max: float,
    stamp: float | None,
    range_min: float = 0.05,
) -> Scan:
    """A scan of a log's numbers.

    Raises:
        BadRecordError: they make none.
    """
    if stamp is not None and not math.isfinite(stamp):
        raise BadRecordError("a time that is not finite")
    if not len(ranges):
        raise BadRecordError("no beams")
    swept = abs(step) * (len(ranges) - 1)
    if not (abs(start) <= _FARTHEST and step != 0.0 and swept <= _WIDEST):
        raise BadRecordError(_fault_of_angles(start, step, swept))
    if not 0 <= range_min < range_max:
        raise BadRecordError("limits of the range that are out of order")
    try:
        return Scan(ranges, start, step, range_min, range_max, stamp)
    except ValueError:
        raise BadRecordError("ranges that are not metres") from None


def stamp_in_seconds(stamp: float) -> float:
    """A time of a table in seconds; nanoseconds since 1970 are recognised.

    Raises:
        BadRecordError: it is too large to be either.
    """
    if _NANOSECONDS[0] <= stamp < _NANOSECONDS[1]:
        return stamp * 1e-9
    if abs(stamp) > _LATEST:
        raise BadRecordError(
            f"a time beyond {_LATEST:.0e}, which is not in seconds; divide milliseconds by 1000, "
            "microseconds by 1e6"
        )
    return stamp


def _fault_of_angles(start: float, step: float, swept: float) -> str:
    """The error in the angles of a scan, which are in radians."""
    fault = "angles that do not fit a sweep of one turn"
    if abs(start) <= _FARTHEST and _WIDEST < swept <= 360.0:
        return f"{fault}: angle_increment={step:g} looks like degrees; give radians"
    if _FARTHEST < abs(start) <= 360.0:
        return f"{fault}: angle_min={start:g} looks like degrees; give radians"
    return fault


def checked_pose(x: float, y: float, heading: float) -> Pose:
    """A pose of a log's numbers.

    Raises:
        BadRecordError: one is not finite.
    """
    if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(heading)):
        raise BadRecordError("a pose that is not finite")
    return x, y, heading
