"""Exact ray casting by an interval raster: segments are drawn into the row of beams.

Of a segment from a to b (metres, lidar frame, counter-clockwise, so that a x b > 0) a beam of
direction u sees the point at range r with r (u . n) = a x b, where n = (b_y - a_y, a_x - b_x).
So 1 / r = u . (n / (a x b)) is linear in the beam's direction, and the nearest of all segments
is the largest of the reciprocals: one multiply-add and one maximum for a beam, no division, no
branch. Which beams meet the segment follows from the directions of a and b. Where there are many
segments, those behind all that is drawn so far in their sectors are left out.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.world.lidar.culling import cell_of
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.lanes import (
    WIDTH,
    larger,
    load,
    select,
    smaller,
    smallest,
    spread,
    store,
)
from semnav_features.lidar_spec import CosinesSines

_FULL_TURN = 2.0 * math.pi
_ANGLE_ERROR = 2e-4
"""Bound on the error of `_coarse_atan2`, radians; twice what it is."""

_END_TOLERANCE = -1e-12
"""A beam that passes an end of a segment by less still meets it, m: closes shared vertices."""

_NO_SPAN = -1e9
"""Value of the span, in beams, of a segment that no beam can meet."""

_AX, _AY, _BX, _BY, _NX, _NY, _FIRST, _SPAN = range(8)
"""Rows of the table of prepared segments: a, b, n / (a x b), a's beam and the span in beams."""

_DRAWN_FIRST = 12
"""Number of segments drawn before the first test of whether those that are left are hidden."""

_SECTOR = 32
"""Number of beams in a sector; a segment beyond the farthest range of its sectors is hidden."""

_NEARER = 1.0 + 1e-9
"""Factor by which rounding may make the reciprocal of a squared range too small, at most."""


@kernel
def cast(
    x: float,
    y: float,
    heading: float,
    grid: np.ndarray,
    starts: NDArray[np.int64],
    ends: FloatArray,
    beams: CosinesSines,
    sensor: np.ndarray,
    out: FloatArray,
) -> None:
    """Write the exact ranges that a lidar sees.

    Args:
        x: of the lidar in the world, metres.
        y: of the lidar in the world, metres.
        heading: of the lidar in the world, radians.
        grid: `Culling.grid`, made for at least this lidar's range_max.
        starts: `Culling.starts`.
        ends: `Culling.ends`.
        beams: `LidarSpec.cosines_sines`.
        sensor: `LidarSpec.sensor`, shape (1,).
        out: ranges in metres, shape (beams,); +inf where nothing is nearer than range_max.
    """
    cell: int = cell_of(grid, x, y)
    start, stop = starts[cell], starts[cell + 1]
    table = np.empty((8, stop - start))
    _prepare(x, y, heading, ends, start, stop, sensor, table)
    farthest = 1.0 / sensor[0].range_max
    guard = 1.0 + _ANGLE_ERROR / sensor[0].angle_increment
    beams_per_turn = _FULL_TURN / sensor[0].angle_increment
    sectors = np.empty((out.shape[0] + _SECTOR - 1) // _SECTOR)
    nearest = np.full(_SECTOR * len(sectors), farthest)  # with room beyond the last beam
    done, count = 0, table.shape[1]
    while done < count:
        begin, done = done, min(max(4 * done, _DRAWN_FIRST), count)
        if begin > 0:
            _note_farthest(nearest, sectors)
        for k in range(begin, done):
            if table[_SPAN, k] <= _NO_SPAN:
                continue
            if begin == 0 or not _is_hidden(table, k, guard, out.shape[0], sectors):
                _draw(table, k, beams, guard, beams_per_turn, out.shape[0] - 1, nearest)
    for i in range(np.uint64(out.shape[0])):
        inverse = nearest[i]
        out[i] = 1.0 / inverse if inverse > farthest else np.inf


@kernel(inline=True)
def _coarse_atan2(y: float, x: float) -> float:
    """Arc tangent of y / x in (-pi, pi], good to 1e-4 rad (a polynomial without branches)."""
    run, rise = abs(x), abs(y)
    steep = rise > run
    q = (run if steep else rise) / (rise if steep else run)
    s = q * q
    angle = ((-0.0464964749 * s + 0.15931422) * s - 0.327622764) * s * q + q
    angle = 0.5 * math.pi - angle if steep else angle
    angle = math.pi - angle if x < 0.0 else angle
    return -angle if y < 0.0 else angle


@kernel
def _prepare(
    x: float,
    y: float,
    heading: float,
    ends: FloatArray,
    start: int,
    stop: int,
    sensor: np.ndarray,
    table: FloatArray,
) -> None:
    """Turn segments start:stop into columns of the table and mark those that no beam can meet."""
    c, s = math.cos(heading), math.sin(heading)
    angle_min, beams_per_radian = sensor[0].angle_min, 1.0 / sensor[0].angle_increment
    farthest_squared = 1.0 / (sensor[0].range_max * sensor[0].range_max)
    x1s, y1s = ends[0, start:stop], ends[1, start:stop]
    x2s, y2s = ends[2, start:stop], ends[3, start:stop]
    axs, ays, bxs, bys = table[_AX], table[_AY], table[_BX], table[_BY]
    nxs, nys, firsts, spans = table[_NX], table[_NY], table[_FIRST], table[_SPAN]
    for k in range(np.uint64(stop - start)):
        dx1, dy1, dx2, dy2 = x1s[k] - x, y1s[k] - y, x2s[k] - x, y2s[k] - y
        x1, y1 = c * dx1 + s * dy1, c * dy1 - s * dx1
        x2, y2 = c * dx2 + s * dy2, c * dy2 - s * dx2
        cross = x1 * y2 - y1 * x2
        clockwise = cross < 0.0
        cross = abs(cross)
        ax = x2 if clockwise else x1
        ay = y2 if clockwise else y1
        bx = x1 if clockwise else x2
        by = y1 if clockwise else y2
        nx, ny = (by - ay) / cross, (ax - bx) / cross
        towards_a = _coarse_atan2(ay, ax)
        span = _coarse_atan2(by, bx) - towards_a
        span = span + _FULL_TURN if span < -1.0 else span
        first = towards_a - angle_min
        first = first + _FULL_TURN if first < _ANGLE_ERROR else first
        # The segment is seen edge-on, or its whole line is out of range: |n / (a x b)| is the
        # reciprocal of the line's distance.
        unseen = (cross < 1e-30) | (nx * nx + ny * ny < farthest_squared)
        axs[k], ays[k], bxs[k], bys[k], nxs[k], nys[k] = ax, ay, bx, by, nx, ny
        firsts[k] = first * beams_per_radian
        spans[k] = _NO_SPAN if unseen else span * beams_per_radian


@kernel
def _draw(
    table: FloatArray,
    k: int,
    beams: CosinesSines,
    guard: float,
    beams_per_turn: float,
    last_beam: int,
    nearest: FloatArray,
) -> None:
    """Raise the reciprocal ranges in `nearest` to those of one segment."""
    cosines, sines = beams
    start = table[_FIRST, k] - guard
    stop = table[_FIRST, k] + table[_SPAN, k] + guard
    ax, ay, bx, by = table[_AX, k], table[_AY, k], table[_BX, k], table[_BY, k]
    nx, ny, nothing = table[_NX, k], table[_NY, k], spread(0.0)
    # All beams that meet the segment are among start to stop: `guard` covers the error of the
    # angles. A further pass, a turn lower, takes the part of a segment that lies across angle_min.
    while stop >= 0.0:
        first = math.ceil(start) if start > 0.0 else 0
        last = math.floor(stop) if stop < last_beam else last_beam
        for i in range(first - first % WIDTH, last + 1, WIDTH):
            # Exactly, beam u meets the segment if a x u >= 0 and u x b >= 0.
            cos, sin = load(cosines, i), load(sines, i)
            met = (ax * sin - ay * cos >= _END_TOLERANCE) & (cos * by - sin * bx >= _END_TOLERANCE)
            inverse = select(met, nx * cos + ny * sin, nothing)
            store(nearest, i, larger(inverse, load(nearest, i)))
        start -= beams_per_turn
        stop -= beams_per_turn


@kernel
def _note_farthest(nearest: FloatArray, sectors: FloatArray) -> None:
    """Write the smallest squared reciprocal range of each sector."""
    for i in range(len(sectors)):
        lanes = load(nearest, _SECTOR * i)
        for k in range(_SECTOR * i + WIDTH, _SECTOR * (i + 1), WIDTH):
            lanes = smaller(lanes, load(nearest, k))
        sectors[i] = smallest(lanes) ** 2


@kernel
def _is_hidden(table: FloatArray, k: int, guard: float, beams: int, sectors: FloatArray) -> bool:
    """Whether a segment is farther away than all that is drawn so far in its sectors."""
    start = table[_FIRST, k] - guard
    stop = table[_FIRST, k] + table[_SPAN, k] + guard
    if start < 0.0 or stop >= beams:
        return False  # it may lie across the first beam
    nearest = _NEARER * _nearest(table, k)
    for i in range(np.uint64(start / _SECTOR), np.uint64(stop / _SECTOR) + np.uint64(1)):
        if nearest >= sectors[i]:
            return False
    return True


@kernel
def _nearest(table: FloatArray, k: int) -> Any:
    """The reciprocal of the squared distance of a segment's nearest point."""
    ax, ay, bx, by = table[_AX, k], table[_AY, k], table[_BX, k], table[_BY, k]
    dx, dy = bx - ax, by - ay
    if ax * dx + ay * dy > 0.0:
        return 1.0 / (ax * ax + ay * ay)
    if bx * dx + by * dy < 0.0:
        return 1.0 / (bx * bx + by * by)
    return table[_NX, k] ** 2 + table[_NY, k] ** 2
