"""Kernels of the obstacle memory.

A centre averages the hits nearest to it, so that a wall becomes one row of centres whose noise
across the wall averages out; a fixed grid would cut the noise in two where it straddles cells.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray, Pose, wrap_angle
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.heading import rough_angle

CENTRE = np.dtype(
    [
        ("x", "f8"),
        ("y", "f8"),
        ("hits", "f8"),
        ("scan", "f8"),
        ("travel", "f8"),
        ("turned", "f8"),
        ("row", "i4"),
        ("column", "i4"),
    ]
)
"""A centre: position in metres, number of hits, the `MemoryClock` of the last hit, and its voxel in
the table."""

OBSTACLE_STATE = np.dtype(
    [(name, "f8") for name in ("scan", "travel", "turned", "x", "y", "heading")] + [("count", "i8")]
)
"""The `MemoryClock` of the last scan, the lidar's pose then, metres and radians, odometry frame,
and the number of centres; shape (1,)."""

VOXEL = 0.05
"""Side of a voxel of the table, metres; a voxel holds at most one centre."""

JOIN_DISTANCE = 0.035
"""Distance below which two centres are joined, metres."""

TABLE_SIDE = 256
"""Voxels along one side of the table, which wraps around: 12.8 m, more than twice the remembered
radius. A power of two, so that `index & WRAP` wraps."""

WRAP = TABLE_SIDE - 1
"""Mask of an index into the table."""

TABLE_SHAPE = TABLE_SIDE, TABLE_SIDE + 16
"""Shape of the table's array. The last columns are not used: rows of a power of two bytes would
share few places of the processor's cache, and a wall along a column would not fit into it."""


class MemoryClock(NamedTuple):
    """Three measures of how long ago something was, any of which may end a memory.

    Attributes:
        scan: number of scans.
        travel: distance driven, metres.
        turned: angle turned in all, radians.
    """

    scan: float
    travel: float
    turned: float


class MemoryLimits(NamedTuple):
    """Those of `MemorySettings` that decide what is remembered."""

    radius: float
    merge: float
    window: int
    through: float
    max_age: MemoryClock


@kernel
def remember(
    state: Any,
    centres: NDArray[Any],
    table: NDArray[np.int32],
    pose: Pose,
    ranges: FloatArray,
    directions: FloatArray,
    range_max: float,
    limits: MemoryLimits,
) -> None:
    """Add one scan to a memory.

    Args:
        state: an entry of dtype `OBSTACLE_STATE`, changed in place.
        centres: dtype `CENTRE`, changed in place.
        table: of voxels, shape (TABLE_SIDE, TABLE_SIDE); -1 everywhere, before and after, so that
            many memories may share one.
        pose: of the lidar, odometry frame.
        ranges: metres, shape (n,).
        directions: unit vectors of the beams, lidar frame, shape (n, 2).
        range_max: metres.
        limits: of the memory.
    """
    if state.scan > 0.0:
        state.travel += math.hypot(pose[0] - state.x, pose[1] - state.y)
        state.turned += abs(wrap_angle(pose[2] - state.heading))
    state.x, state.y, state.heading = pose
    state.scan += 1.0
    now = MemoryClock(state.scan, state.travel, state.turned)
    state.count = _forget(
        centres, state.count, table, pose, ranges, directions, range_max, now, limits
    )
    state.count = _add_hits(
        centres, state.count, table, pose, ranges, directions, range_max, now, limits
    )
    for k in range(state.count):
        table[centres[k].row, centres[k].column] = -1


@kernel
def slot(x: float, y: float) -> tuple[int, int]:
    """Place of a point in the wrapped table."""
    return math.floor(y / VOXEL) & WRAP, math.floor(x / VOXEL) & WRAP


@kernel
def _forget(
    centres: NDArray[Any],
    count: int,
    table: NDArray[np.int32],
    pose: Pose,
    ranges: FloatArray,
    directions: FloatArray,
    range_max: float,
    now: MemoryClock,
    limits: MemoryLimits,
) -> int:
    """Drop centres that are old, far away or seen through; join those that are close together.

    Returns:
        the number of centres left, which are moved to the front and put into the table.
    """
    beams, max_age = _beams_of(pose, directions), limits.max_age
    kept, around = 0, np.empty(10, np.int32)
    for k in range(count):
        centre = centres[k]
        old = (
            now.scan - centre.scan > max_age.scan
            or now.travel - centre.travel > max_age.travel
            or now.turned - centre.turned > max_age.turned
        )
        if old or is_beyond(centre.x - pose[0], centre.y - pose[1], limits.radius + 0.2):
            continue
        if _seen_through(beams, centre.x, centre.y, ranges, range_max, limits.through):
            centre.hits = 0.5 * min(centre.hits, 40.0)
            if centre.hits < 1.0:
                continue
        j, i = slot(centre.x, centre.y)
        n = _gather(table, j, i, around)
        near = _nearest(centres, around, n, centre.x, centre.y, JOIN_DISTANCE)
        if near < 0:
            near = table[j, i]
        if near >= 0:
            join(centres[near], centre)
        else:
            table[j, i] = kept
            if kept < k:
                centres[kept] = centre
            centres[kept].row, centres[kept].column = j, i
            kept += 1
    return kept


@kernel
def is_beyond(dx: float, dy: float, distance: float) -> bool:
    """Whether a vector is longer than a distance; its exact length decides close cases alone."""
    squared = dx * dx + dy * dy
    if abs(squared - distance * distance) > 1e-9 * squared:
        return bool(squared > distance * distance)
    return math.hypot(dx, dy) > distance


@kernel
def _full_turn(angle: float) -> float:
    """An angle in (-2 pi, pi] as `angle % (2 pi)` gives it, in a tenth of the time."""
    return angle if angle >= 0.0 else angle + 2.0 * math.pi


@kernel
def join(into: Any, other: Any) -> None:
    """Make one centre of two, weighted by their hits."""
    share = other.hits / (into.hits + other.hits)
    into.x += share * (other.x - into.x)
    into.y += share * (other.y - into.y)
    into.hits += other.hits
    into.scan = max(into.scan, other.scan)
    into.travel = max(into.travel, other.travel)
    into.turned = max(into.turned, other.turned)


class LidarBeams(NamedTuple):
    """Where a lidar is and how its beams lie.

    Attributes:
        x: of the lidar, metres, in the frame of the centres.
        y: the same.
        cosine: of its heading.
        sine: the same.
        first_x: unit vector of the first beam, lidar frame.
        first_y: the same.
        increment: angle between two beams, radians.
    """

    x: float
    y: float
    cosine: float
    sine: float
    first_x: float
    first_y: float
    increment: float


@kernel
def _beams_of(pose: Pose, directions: FloatArray) -> LidarBeams:
    """The beams of a lidar at a pose, from their unit vectors in the lidar frame, shape (n, 2)."""
    ux, uy = directions[0]
    increment = math.atan2(
        ux * directions[1, 1] - uy * directions[1, 0], ux * directions[1, 0] + uy * directions[1, 1]
    )
    return LidarBeams(pose[0], pose[1], math.cos(pose[2]), math.sin(pose[2]), ux, uy, increment)


@kernel
def _seen_through(
    beams: LidarBeams, x: float, y: float, ranges: FloatArray, range_max: float, through: float
) -> bool:
    """Whether the three beams nearest to a point all reach farther than `through` behind it."""
    dx, dy = x - beams.x, y - beams.y
    px, py = beams.cosine * dx + beams.sine * dy, beams.cosine * dy - beams.sine * dx
    ux, uy = beams.first_x, beams.first_y
    along, across = ux * px + uy * py, ux * py - uy * px
    # the roughly nearest beam is one of the three: where it ends before, no exact angle is needed
    near = round(_full_turn(rough_angle(along, across)) / beams.increment)
    if 0 <= near < len(ranges) and ranges[near] <= math.sqrt(px * px + py * py) + through - 1e-9:
        return False
    distance = math.hypot(px, py) + through
    beam = round(_full_turn(math.atan2(across, along)) / beams.increment)
    if beam < 1 or beam > len(ranges) - 2:
        return False
    least = min(ranges[beam - 1], ranges[beam], ranges[beam + 1])
    most = max(ranges[beam - 1], ranges[beam], ranges[beam + 1])
    return bool(least > distance and most < range_max)


@kernel
def _add_hits(
    centres: NDArray[Any],
    count: int,
    table: NDArray[np.int32],
    pose: Pose,
    ranges: FloatArray,
    directions: FloatArray,
    range_max: float,
    now: MemoryClock,
    limits: MemoryLimits,
) -> int:
    """Refine the nearest centre with each hit, or make a new one; returns the number of centres."""
    c, s = math.cos(pose[2]), math.sin(pose[2])
    reach = min(limits.radius, range_max)
    around, n, row, column = np.empty(10, np.int32), 0, -1, -1
    for k in range(len(ranges)):
        if not 0.05 < ranges[k] < reach:
            continue
        px, py = ranges[k] * directions[k, 0], ranges[k] * directions[k, 1]
        x, y = pose[0] + c * px - s * py, pose[1] + s * px + c * py
        j, i = slot(x, y)
        if j != row or i != column:
            row, column, n = j, i, _gather(table, j, i, around)
        near = _nearest(centres, around, n, x, y, limits.merge)
        if near < 0:
            if count >= len(centres) or table[j, i] >= 0:
                continue
            near, row = count, -1  # what was gathered lacks the new one
            table[j, i] = near
            centres[near].x, centres[near].y, centres[near].hits = x, y, 0.0
            centres[near].row, centres[near].column = j, i
            count += 1
        centre = centres[near]
        centre.hits += 1.0
        weight = 1.0 / min(centre.hits, limits.window)
        centre.x += weight * (x - centre.x)
        centre.y += weight * (y - centre.y)
        centre.scan, centre.travel, centre.turned = now.scan, now.travel, now.turned
    return count


@kernel
def _gather(table: NDArray[np.int32], j: int, i: int, around: NDArray[np.int32]) -> int:
    """Write the centres in the voxels around one, row by row; returns how many there are.

    A number is written even where no centre is, and overwritten by the next: no branch is needed.
    """
    n = 0
    for b in range(j - 1, j + 2):
        for a in range(i - 1, i + 2):
            k = table[b & WRAP, a & WRAP]
            around[n] = k
            n += k >= 0
    return n


@kernel
def _nearest(
    centres: NDArray[Any], around: NDArray[np.int32], n: int, x: float, y: float, within: float
) -> int:
    """Which of the first `n` gathered centres is nearest to a point, or -1."""
    best, least = -1, within * within
    for m in range(n):
        k = around[m]
        squared = (centres[k].x - x) ** 2 + (centres[k].y - y) ** 2
        if squared < least:
            best, least = k, squared
    return best
