"""The length of a plane vector, correctly rounded."""

from __future__ import annotations

import math

from semnav_features.kernels.compiling import kernel

_SPLITTER = 2.0**27 + 1.0
"""Splits a double into halves whose products are exact (Dekker 1971)."""


@kernel
def exact_hypot(x: float, y: float) -> float:
    """`math.hypot` of CPython to the last bit; the C library's differs in one of 150 cases.

    One Newton step from h = sqrt(x^2 + y^2): h + (x^2 + y^2 - h^2) / 2h, where the squares are
    taken exactly.
    """
    x, y = max(abs(x), abs(y)), min(abs(x), abs(y))
    h = math.sqrt(x * x + y * y)
    if not 0.0 < h < math.inf:
        return h
    xx, yy, hh = x * x, y * y, h * h
    residual = (xx - hh) + yy
    residual += (_square_error(x, xx) - _square_error(h, hh)) + _square_error(y, yy)
    return h + residual / (2.0 * h)


@kernel
def _square_error(x: float, square: float) -> float:
    """The rounding error of the square of a number."""
    t = x * _SPLITTER
    high = t - (t - x)
    low = x - high
    return ((high * high - square) + 2.0 * high * low) + low * low
