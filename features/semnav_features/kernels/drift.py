"""Corrects the drift of odometry: walls that are seen again must lie where they lay before.

Mes 2021 (section 2.2) proposes to correct the drift of SPOT by a door that it detects; here every
remembered wall is such a landmark.
"""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np

from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.lanes import WIDTH, bits, first_lanes, load, smaller
from semnav_features.kernels.normal_equations import solve_step
from semnav_features.kernels.remembered import (
    HITS,
    VARIANCE,
    Ends,
    ends_of_wall,
    ends_of_walls,
    lowest_bit,
)

MIN_LANDMARK_SIGHTINGS = 5
"""A remembered wall tells where the robot is once it was seen this often."""

MIN_OVERLAP, MAX_WEIGHING_OVERLAP = 0.4, 3.0
"""Two walls are compared where both are, if that stretch is this long; what exceeds the second
length adds no weight, metres."""

MAX_LANDMARK_OFFSET = 0.3
"""Two walls that lie farther than this beside each other are not the same wall, metres."""

MIN_PARALLEL_COSINE = math.cos(math.radians(10.0))
"""Cosine of the largest angle between two sightings of the same wall."""

WALL_DEVIATION = 0.01
"""Standard deviation of the distance between two sightings of a metre of a straight wall, metres,
to which that of the wall's own sightings is added. Walls with ledges, and furniture that looks like
another wall from elsewhere, say little of where the robot is."""

OUTLIER_DISTANCE = 0.1
"""Distance at which the weight of a sighting has fallen to one half, metres."""

DRIFT_DEVIATION, DRIFT_ANGLE_DEVIATION = 0.01, 0.004
"""Standard deviations of the drift from one scan to the next, metres and radians."""

Sums: TypeAlias = tuple[float, float, float, float, float, float, float, float, float]
"""Normal equations for x, y and rotation: the entries xx, xy, yy, xr, yr, rr of the matrix, and the
right-hand side."""

PRIOR: Sums = (
    *(1.0 / DRIFT_DEVIATION**2, 0.0, 1.0 / DRIFT_DEVIATION**2),
    *(0.0, 0.0, 1.0 / DRIFT_ANGLE_DEVIATION**2),
    *(0.0, 0.0, 0.0),
)
"""What is known of the drift before any wall is seen."""


@kernel
def with_sighting(wall: Ends, known: FloatArray, used: int, pose: Pose, sums: Sums) -> Sums:
    """The normal equations with what a wall of a scan adds to them; see `scene_drift`."""
    like, begin, end = _nearest_like(wall, known, used)
    if like < 0:
        return sums
    x1, y1, x2, y2 = wall
    ux, uy = x2 - x1, y2 - y1
    stretch = x1 + begin * ux, y1 + begin * uy, x1 + end * ux, y1 + end * uy
    variance = WALL_DEVIATION**2 + known[VARIANCE, like]
    return _added(stretch, ends_of_wall(known, like), variance, pose, sums)


@kernel
def corrected(pose: Pose, sums: Sums) -> Pose:
    """The pose after the step that solves the normal equations."""
    xx, xy, yy, xr, yr, rr, bx, by, br = sums
    return solve_step(pose, (xx, xy, yy, xr, yr, rr), (bx, by, br))


@kernel
def _nearest_like(wall: Ends, known: FloatArray, used: int) -> tuple[int, float, float]:
    """The remembered wall nearest beside a wall that faces and runs as it does.

    Returns:
        Its index, -1 if there is none; and the shares of the wall between which both are.
    """
    x1, y1, x2, y2 = wall
    ux, uy = x2 - x1, y2 - y1
    nearest, like, begin, end = MAX_LANDMARK_OFFSET, -1, 0.0, 0.0
    for start in range(0, used, WIDTH):
        candidates = _alike(wall, known, start, used)
        while candidates != 0:
            k = start + int(np.int64(lowest_bit(candidates)))
            candidates &= candidates - np.uint64(1)
            start_x, start_y, end_x, end_y = ends_of_wall(known, k)
            dx, dy = end_x - start_x, end_y - start_y
            length = math.sqrt(dx * dx + dy * dy)
            first = ((x1 - start_x) * dx + (y1 - start_y) * dy) / length
            last = ((x2 - start_x) * dx + (y2 - start_y) * dy) / length
            low, high = max(first, 0.0), min(last, length)
            if high - low < MIN_OVERLAP:
                continue
            low, high = (low - first) / (last - first), (high - first) / (last - first)
            middle = 0.5 * (low + high)
            x, y = x1 + middle * ux - start_x, y1 + middle * uy - start_y
            beside = abs(y * dx - x * dy) / length
            if beside < nearest:
                nearest, like, begin, end = beside, k, low, high
    return like, begin, end


@kernel
def _alike(wall: Ends, known: FloatArray, start: int, used: int) -> np.uint64:
    """Which of the eight remembered walls from `start` on may be those that a wall is beside.

    Returns:
        Bit i is set if wall `start + i` was seen often enough, is parallel to the wall, overlaps
        it, and has an end of the wall near its line: the middle of the stretch that both share is
        no nearer than the nearer end.
    """
    x1, y1, x2, y2 = wall
    ux, uy = x2 - x1, y2 - y1
    size, reach = ux * ux + uy * uy, (1.01 * MAX_LANDMARK_OFFSET) ** 2
    start_x, start_y, end_x, end_y = ends_of_walls(known, start)
    dx, dy = end_x - start_x, end_y - start_y
    dot, square = ux * dx + uy * dy, dx * dx + dy * dy
    parallel = (dot >= 0.0) & (dot * dot >= MIN_PARALLEL_COSINE**2 * size * square)
    a = (x1 - start_x) * dy - (y1 - start_y) * dx
    b = (x2 - start_x) * dy - (y2 - start_y) * dx
    near = (a * b <= 0.0) | (smaller(a * a, b * b) <= reach * square)
    first = (x1 - start_x) * dx + (y1 - start_y) * dy
    last = (x2 - start_x) * dx + (y2 - start_y) * dy
    overlaps = (first < square) & (last > 0.0)
    often = load(known[HITS], start) >= float(MIN_LANDMARK_SIGHTINGS)
    return np.uint64(bits(parallel & near & overlaps & often & first_lanes(used - start)))


@kernel
def _added(stretch: Ends, old: Ends, variance: float, pose: Pose, sums: Sums) -> Sums:
    """Add both ends of a stretch of a wall beside a remembered one to the normal equations.

    With the unit normal n of the remembered line and d = n . (p - q), a shift moves d by n, and a
    rotation about the lidar moves it by the lever arm (p - lidar) x n. The variance is of d, for a
    metre of wall.
    """
    x1, y1, x2, y2 = stretch
    xx, xy, yy, xr, yr, rr, bx, by, br = sums
    start_x, start_y, end_x, end_y = old
    dx, dy = end_x - start_x, end_y - start_y
    length = math.sqrt(dx * dx + dy * dy)
    nx, ny = -dy / length, dx / length
    shared = math.sqrt((x2 - x1) ** 2 + (y2 - y1) ** 2)
    weight = 0.5 * min(shared, MAX_WEIGHING_OVERLAP) / variance
    for x, y in ((x1, y1), (x2, y2)):
        off = nx * (x - start_x) + ny * (y - start_y)
        lever = ny * (x - pose[0]) - nx * (y - pose[1])
        counts = weight / (1.0 + (off / OUTLIER_DISTANCE) ** 2)
        xx += counts * nx * nx
        xy += counts * nx * ny
        yy += counts * ny * ny
        xr += counts * nx * lever
        yr += counts * ny * lever
        rr += counts * lever * lever
        bx -= counts * nx * off
        by -= counts * ny * off
        br -= counts * lever * off
    return xx, xy, yy, xr, yr, rr, bx, by, br
