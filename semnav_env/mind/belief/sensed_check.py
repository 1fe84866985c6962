"""Checks the input of a real robot; that of a simulated robot needs no check."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from semnav_features.validation import finite_float, finite_triple, require


def checked_ranges(ranges: ArrayLike, beams: int, lidar: str) -> np.ndarray:
    """The ranges of a scan as an array.

    Raises:
        ValueError: another number of ranges, or a value that is not a real number.
    """
    array = np.asarray(ranges)
    if array.shape != (beams,):
        raise ValueError(f"ranges have shape {array.shape}; {lidar} gives {(beams,)}")
    if array.dtype.kind not in "fiu":
        raise ValueError(f"ranges have dtype {array.dtype}; they must be real numbers in metres")
    return array


def check_sensed(odometry: object, velocity: object, bumps: object, seconds: object) -> None:
    """Check the values that come with a scan; see `BeliefTracker.update`.

    Raises:
        ValueError: three numbers that are not finite, or a time that is not above 0; names it.
    """
    finite_triple("odometry", odometry)
    known = isinstance(bumps, Sequence | np.ndarray)
    require(known, "bumps", bumps, "a list of contacts, of three finite numbers each")
    for each in bumps:  # type: ignore[attr-defined]
        finite_triple("a bump", each)
    if velocity is not None:
        finite_triple("velocity", velocity)
    right = "finite and above 0"
    require(finite_float("seconds", seconds, right) > 0.0, "seconds", seconds, right)
