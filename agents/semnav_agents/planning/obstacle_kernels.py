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

NEIGHBOUR_DISTANCE = 0.09
"""Distance of a neighbour, metres; a centre with far fewer hits than a neighbour is noise."""

NEIGHBOUR_REACH = 3 * VOXEL
"""Distance beyond which nothing is a neighbour, metres: those up to two voxels away are."""

MIN_LEAN = 0.6
"""Share of its neighbours to whose side a centre must lean to be the end of a row."""

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


class SelectionLimits(NamedTuple):
    """Those of `MemorySettings` that decide which centres count as obstacles.

    Attributes:
        sure: least number of hits.
        share: least number of hits, as a share of a neighbour's.
        blunt: length by which the ends of walls are shortened, metres.
    """

    sure: int
    share: float
    blunt: float


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
        if old or _is_beyond(centre.x - pose[0], centre.y - pose[1], limits.radius + 0.2):
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
def _is_beyond(dx: float, dy: float, distance: float) -> bool:
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


class SearchBox(NamedTuple):
    """A rectangle along the axes, metres."""

    left: float
    lower: float
    right: float
    upper: float


@kernel
def box_around(x: float, y: float, reach: float) -> SearchBox:
    """The square of half side `reach` around a place."""
    return SearchBox(x - reach, y - reach, x + reach, y + reach)


@kernel
def _holds(box: SearchBox, x: float, y: float, more: float) -> bool:
    """Whether a place lies in a box that is wider by `more` at each side."""
    return box.left - more < x < box.right + more and box.lower - more < y < box.upper + more


@kernel
def select(
    centres: NDArray[Any], table: NDArray[np.int32], box: SearchBox, limits: SelectionLimits
) -> FloatArray:
    """Positions of the centres that were hit often enough, by themselves and beside neighbours.

    The last centre of a row averages over the end of the wall it stands for. A centre with
    neighbours on one side only therefore gets a second point, `blunt` metres farther out.

    Args:
        centres: all of them.
        table: of voxels, -1 everywhere, before and after.
        box: where positions are wanted; some positions lie beside it.
        limits: of what counts.
    """
    chosen, n = np.empty(len(centres), np.int64), 0
    for k in range(len(centres)):
        if _holds(box, centres[k].x, centres[k].y, limits.blunt + NEIGHBOUR_REACH):
            chosen[n] = k
            n += 1
            j, i = slot(centres[k].x, centres[k].y)
            best: int = table[j, i]
            if best < 0 or centres[best].hits < centres[k].hits:
                table[j, i] = k
    points = _sure_points(centres, chosen[:n], table, box, limits)
    for k in chosen[:n]:
        j, i = slot(centres[k].x, centres[k].y)
        table[j, i] = -1
    return points


@kernel
def _sure_points(
    centres: NDArray[Any],
    chosen: NDArray[np.int64],
    table: NDArray[np.int32],
    box: SearchBox,
    limits: SelectionLimits,
) -> FloatArray:
    """See `select`; of the chosen centres those in the box."""
    points, n, share = np.empty((2 * len(chosen), 2)), 0, limits.share
    for k in chosen:
        centre = centres[k]
        if centre.hits < limits.sure or not _holds(box, centre.x, centre.y, limits.blunt):
            continue
        most, may_end = _neighbours(centres, table, k, share)
        if centre.hits < share * most:
            continue
        points[n, 0], points[n, 1] = centre.x, centre.y
        n += 1
        if not may_end or centre.hits < 2.0 * share * most:
            continue
        weight, to_x, to_y = _lean(centres, table, k, share)
        away = math.hypot(to_x, to_y)
        if weight > 0 and away > MIN_LEAN * weight:
            points[n, 0] = centre.x - limits.blunt * to_x / away
            points[n, 1] = centre.y - limits.blunt * to_y / away
            n += 1
    return points[:n]


@kernel
def _neighbours(
    centres: NDArray[Any], table: NDArray[np.int32], k: int, share: float
) -> tuple[float, bool]:
    """The largest number of hits of a neighbour, and whether `_lean` may be that of an end.

    Lengths are rounded here: only close cases need them exactly, most need no length at all.
    """
    j, i = slot(centres[k].x, centres[k].y)
    most, count, x, y, is_apart = 0.0, 0.0, 0.0, 0.0, True
    for b in range(j - 2, j + 3):
        for a in range(i - 2, i + 3):
            m: int = table[b & WRAP, a & WRAP]
            if m < 0 or m == k:
                continue
            dx, dy = centres[m].x - centres[k].x, centres[m].y - centres[k].y
            if not _is_beyond(dx, dy, NEIGHBOUR_DISTANCE):
                most = max(most, centres[m].hits)
            squared = dx * dx + dy * dy
            is_apart &= squared > 1e-11
            if centres[m].hits >= share * centres[k].hits:
                inverse = 1.0 / math.sqrt(squared)
                count, x, y = count + 1.0, x + dx * inverse, y + dy * inverse
    least = MIN_LEAN * count - 1e-9
    return most, not is_apart or least < 0.0 or x * x + y * y > least * least


@kernel
def _lean(
    centres: NDArray[Any], table: NDArray[np.int32], k: int, share: float
) -> tuple[float, float, float]:
    """The number of centres up to two voxels away, and the sum of the unit vectors to them."""
    j, i = slot(centres[k].x, centres[k].y)
    count, x, y = 0.0, 0.0, 0.0
    for b in range(j - 2, j + 3):
        for a in range(i - 2, i + 3):
            m: int = table[b & WRAP, a & WRAP]
            if m < 0 or m == k:
                continue
            dx, dy = centres[m].x - centres[k].x, centres[m].y - centres[k].y
            away = math.hypot(dx, dy)
            if centres[m].hits >= share * centres[k].hits and away > 1e-6:
                count, x, y = count + 1.0, x + dx / away, y + dy / away
    return count, x, y
