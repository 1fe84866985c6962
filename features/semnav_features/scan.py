"""A scan of a 2D lidar."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from semnav_features.frames import FloatArray
from semnav_features.validation import finite_float

_MAX_FIRST_ANGLE = 8.0 * math.pi
"""Largest accepted first direction, radians; a larger number must be degrees."""

MAX_RANGE = 1000.0
"""Longest range that any lidar of a robot has, metres."""

_NO_LENGTH = 1000.0 * MAX_RANGE
"""Range from which on a number means a missing return, in metres and in millimetres."""

_MAX_SWEEP = 4.0 * math.pi
"""Largest accepted angle of a scan, radians; some scanners repeat a few beams of the circle."""


@dataclass(frozen=True, eq=False)
class Scan:
    """A scan of a 2D lidar, beams counter-clockwise, in the lidar frame.

    NaN, infinity, zero, negative values and anything at or beyond `range_max` or below
    `range_min` are missing returns (REP 117, and the practice of drivers).

    A negative increment says that the scanner turned clockwise from `angle_min`; the order of the
    beams is then reversed, so that the attributes always run counter-clockwise.

    Attributes:
        ranges: distances in metres, shape (n,). Any array of real numbers is accepted and copied;
            what is masked in a masked array is no return.
        angle_min: direction of beam 0 in radians, x forward, counter-clockwise.
        angle_increment: angle between beams in radians; positive, whatever sign it was given.
        range_min: shortest valid distance in metres.
        range_max: longest valid distance in metres.
        stamp: time in seconds, if known.

    Raises:
        ValueError: not one-dimensional, no beams, not real numbers, an increment of zero, angles
            that must be degrees, limits out of order, or lengths that must be millimetres.
    """

    ranges: FloatArray
    angle_min: float
    angle_increment: float
    range_min: float = 0.05
    range_max: float = 10.0
    stamp: float | None = None

    def __init__(
        self,
        ranges: ArrayLike,
        angle_min: float,
        angle_increment: float,
        range_min: float = 0.05,
        range_max: float = 10.0,
        stamp: float | None = None,
    ) -> None:
        values = dict(
            angle_min=finite_float("angle_min", angle_min),
            angle_increment=finite_float("angle_increment", angle_increment),
            range_min=finite_float("range_min", range_min),
            range_max=finite_float("range_max", range_max),
        )
        if stamp is not None:
            finite_float("stamp", stamp)
        _check_limits(values)
        array = _check_ranges(ranges, values["range_max"])
        _check_angles(values["angle_min"], values["angle_increment"], len(array))
        if values["angle_increment"] < 0:
            values["angle_min"] += values["angle_increment"] * (len(array) - 1)
            values["angle_increment"] *= -1.0
            array = array[::-1].copy()
        array.setflags(write=False)
        for name, value in dict(ranges=array, stamp=stamp, **values).items():
            object.__setattr__(self, name, value)

    @property
    def angles(self) -> FloatArray:
        """Direction of each beam in radians, shape (n,)."""
        steps = np.arange(len(self.ranges), dtype=np.float64)
        return self.angle_min + self.angle_increment * steps

    @property
    def valid(self) -> np.ndarray:
        """Mask of the beams that returned a distance, shape (n,), bool."""
        with np.errstate(invalid="ignore"):
            beyond_least = (self.ranges >= self.range_min) & (self.ranges > 0.0)
            return beyond_least & (self.ranges < self.range_max)


def _check_limits(values: dict[str, float]) -> None:
    if not 0 <= values["range_min"] < values["range_max"]:
        raise ValueError(
            f"range_min {values['range_min']} and range_max {values['range_max']} must satisfy "
            "0 <= range_min < range_max"
        )
    if values["range_max"] > MAX_RANGE:
        raise ValueError(
            f"range_max is {values['range_max']:g}; it must be metres, at most {MAX_RANGE:g}: "
            "divide ranges and limits in millimetres by 1000"
        )


def _check_angles(angle_min: float, increment: float, beams: int) -> None:
    if increment == 0:
        raise ValueError("angle_increment is 0; it is the angle between two beams, in radians")
    if abs(angle_min) > _MAX_FIRST_ANGLE:
        raise ValueError(
            f"angle_min is {angle_min:g}, more than four turns; give it in radians, "
            "not degrees (math.radians)"
        )
    if (sweep := abs(increment) * (beams - 1)) > _MAX_SWEEP:
        raise ValueError(
            f"angle_increment {increment:g} makes {beams} beams sweep {sweep:.4g} radians, more "
            "than two turns; give it in radians, not degrees (math.radians)"
        )


def _check_ranges(ranges: ArrayLike, range_max: float) -> FloatArray:
    masked = np.ma.getmaskarray(ranges) if isinstance(ranges, np.ma.MaskedArray) else None
    raw = np.asarray(ranges)
    if raw.ndim != 1:
        raise ValueError(f"ranges have shape {raw.shape}; one scan is one-dimensional")
    if raw.dtype.kind not in "fiu":
        raise ValueError(f"ranges have dtype {raw.dtype}; they must be real numbers in metres")
    if len(raw) == 0:
        raise ValueError("ranges are empty; a scan has at least one beam")
    array: FloatArray = raw.astype(np.float64)
    if masked is not None:
        array[masked] = np.nan
    check_unit(array, range_max)
    return array


def check_unit(ranges: FloatArray, range_max: float) -> None:
    """Refuse ranges that must be millimetres.

    Each length counts once: a number that drivers send for "no return" is one length of many
    beams, and those of real returns differ.

    Raises:
        ValueError: at least half of the lengths lie beyond 20 times `range_max`.
    """
    far = 20.0 * range_max
    if not (ranges > far).any():  # spares most scans the sorting
        return
    if (typical := typical_length(ranges)) > far:
        raise ValueError(
            f"ranges have a median of {typical:.0f} but range_max is {range_max} m; "
            "they look like millimetres: divide them by 1000"
        )


def typical_length(ranges: FloatArray) -> float:
    """Median of the different lengths of a scan; 0 if there are none, or one of many beams."""
    measured = ranges[(ranges > 0) & (ranges < _NO_LENGTH)]
    lengths = np.unique(measured)
    if len(lengths) == 0 or len(lengths) == 1 < len(measured):
        return 0.0
    return float(lengths[(len(lengths) - 1) // 2])


def plain_codes(ranges: ArrayLike, range_min: float, range_max: float) -> FloatArray:
    """A copy of ranges in which all missing returns have the codes of REP 117.

    Args:
        ranges: metres, shape (n,).
        range_min: shortest valid range, metres.
        range_max: what is as far or farther is no return, metres.

    Returns:
        The returns as they are; -inf for what is too near to tell, which is -inf or lies between
        0 and `range_min`; +inf for all else that is no return: NaN, 0, -1, a number for "nothing".
    """
    plain = np.array(ranges, dtype=np.float64)
    with np.errstate(invalid="ignore"):
        too_near = (plain == -np.inf) | ((plain > 0.0) & (plain < range_min))
        nothing = ~((plain > 0.0) & (plain < range_max))
    plain[nothing] = np.inf
    plain[too_near] = -np.inf
    return plain
