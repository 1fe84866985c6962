"""A second pass of the ray caster for the few things that move: discs and segments."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.lidar_spec import CosinesSines

NO_MOVING_THINGS = (np.zeros((0, 3)), np.zeros((0, 4)))
"""Discs and segments where nothing moves."""


@kernel
def cast_moving(
    x: float,
    y: float,
    heading: float,
    discs: FloatArray,
    segments: FloatArray,
    beams: CosinesSines,
    range_max: float,
    out: FloatArray,
) -> None:
    """Shorten exact ranges to where a disc or a segment is nearer.

    Args:
        x: of the lidar in the world, metres.
        y: of the lidar in the world, metres.
        heading: of the lidar in the world, radians.
        discs: x, y and radius, metres, shape (n, 3).
        segments: x1, y1, x2, y2 in metres, shape (m, 4).
        beams: `LidarSpec.cosines_sines`.
        range_max: metres.
        out: ranges in metres, +inf for no return, shape (beams,).
    """
    c, s = math.cos(heading), math.sin(heading)
    for k in range(len(discs)):
        dx, dy, radius = discs[k, 0] - x, discs[k, 1] - y, discs[k, 2]
        if math.hypot(dx, dy) < range_max + radius:
            _shorten_by_disc(c * dx + s * dy, c * dy - s * dx, radius, beams, range_max, out)
    for k in range(len(segments)):
        x1, y1 = segments[k, 0] - x, segments[k, 1] - y
        x2, y2 = segments[k, 2] - x, segments[k, 3] - y
        a = c * x1 + s * y1, c * y1 - s * x1
        b = c * x2 + s * y2, c * y2 - s * x2
        _shorten_by_segment(a, b, beams, range_max, out)


@kernel
def _shorten_by_disc(
    x: float, y: float, radius: float, beams: CosinesSines, range_max: float, out: FloatArray
) -> None:
    """A beam of direction u meets the disc around c at u . c - sqrt(r^2 - (u x c)^2)."""
    cos, sin = beams
    squared = radius * radius
    for i in range(len(out)):
        along, across = cos[i] * x + sin[i] * y, cos[i] * y - sin[i] * x
        if across * across < squared and along > 0.0:
            distance = max(along - math.sqrt(squared - across * across), 0.0)
            if distance < out[i] and distance < range_max:
                out[i] = distance


@kernel
def _shorten_by_segment(
    a: tuple[float, float],
    b: tuple[float, float],
    beams: CosinesSines,
    range_max: float,
    out: FloatArray,
) -> None:
    """A beam of direction u meets the line through a and b at (a x b) / (u x (b - a))."""
    cos, sin = beams
    dx, dy = b[0] - a[0], b[1] - a[1]
    area = a[0] * b[1] - a[1] * b[0]
    for i in range(len(out)):
        beside_a = cos[i] * a[1] - sin[i] * a[0]
        beside_b = cos[i] * b[1] - sin[i] * b[0]
        if beside_a * beside_b <= 0.0 and beside_a != beside_b:
            distance = area / (cos[i] * dy - sin[i] * dx)
            if 0.0 <= distance < out[i] and distance < range_max:
                out[i] = distance
