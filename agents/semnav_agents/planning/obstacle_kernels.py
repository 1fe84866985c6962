"""Kernels of the obstacle memory.

A centre averages the hits nearest to it, so that a wall becomes one row of centres whose noise
across the wall averages out; a fixed grid would cut the noise in two where it straddles cells.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel

CENTRE = np.dtype(
    [
        ("x", "f8"),
        ("y", "f8"),
        ("hits", "f8"),
        ("scan", "f8"),
        ("travel", "f8"),
        ("turned", "f8"),
    ]
)
"""A centre: position in metres, number of hits, and the `MemoryClock` of the last hit."""

VOXEL = 0.05
"""Side of a voxel of the table, metres; a voxel holds at most one centre."""

NEIGHBOUR_DISTANCE = 0.09
"""Distance of a neighbour, metres; a centre with far fewer hits than a neighbour is noise."""

JOIN_DISTANCE = 0.035
"""Distance below which two centres are joined, metres."""

TABLE_SIDE = 256
"""Voxels along one side of the table, which wraps around: 12.8 m, more than twice the remembered
radius."""


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


@kernel
def slot(x: float, y: float) -> tuple[int, int]:
    """Place of a point in the wrapped table."""
    return math.floor(y / VOXEL) % TABLE_SIDE, math.floor(x / VOXEL) % TABLE_SIDE


@kernel
def forget(
    centres: NDArray[Any],
    count: int,
    pose: Pose,
    ranges: FloatArray,
    directions: FloatArray,
    range_max: float,
    now: MemoryClock,
    max_age: MemoryClock,
    radius: float,
    through: float,
) -> tuple[int, NDArray[np.int32]]:
    """Drop centres that are old, far away or seen through; join those that are close together.

    Returns:
        the number of centres left, which are moved to the front, and the table from voxels to
        them (-1: none).
    """
    table = np.full((TABLE_SIDE, TABLE_SIDE), -1, dtype=np.int32)
    kept = 0
    for k in range(count):
        centre = centres[k]
        old = (
            now.scan - centre.scan > max_age.scan
            or now.travel - centre.travel > max_age.travel
            or now.turned - centre.turned > max_age.turned
        )
        if old or math.hypot(centre.x - pose[0], centre.y - pose[1]) > radius + 0.2:
            continue
        if seen_through(pose, centre.x, centre.y, ranges, directions, range_max, through):
            centre.hits = 0.5 * min(centre.hits, 40.0)
            if centre.hits < 1.0:
                continue
        j, i = slot(centre.x, centre.y)
        near = nearest(centres, table, centre.x, centre.y, JOIN_DISTANCE)
        if near < 0:
            near = table[j, i]
        if near >= 0:
            join(centres[near], centre)
        else:
            table[j, i] = kept
            centres[kept] = centre
            kept += 1
    return kept, table


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


@kernel
def seen_through(
    pose: Pose,
    x: float,
    y: float,
    ranges: FloatArray,
    directions: FloatArray,
    range_max: float,
    through: float,
) -> bool:
    """Whether the three beams nearest to a point all reach farther than `through` behind it."""
    c, s = math.cos(pose[2]), math.sin(pose[2])
    dx, dy = x - pose[0], y - pose[1]
    px, py = c * dx + s * dy, c * dy - s * dx
    ux, uy = directions[0]
    increment = math.atan2(
        ux * directions[1, 1] - uy * directions[1, 0], ux * directions[1, 0] + uy * directions[1, 1]
    )
    angle = math.atan2(ux * py - uy * px, ux * px + uy * py) % (2.0 * math.pi)
    beam = round(angle / increment)
    if beam < 1 or beam > len(ranges) - 2:
        return False
    distance = math.hypot(px, py) + through
    least = min(ranges[beam - 1], ranges[beam], ranges[beam + 1])
    most = max(ranges[beam - 1], ranges[beam], ranges[beam + 1])
    return bool(least > distance and most < range_max)


@kernel
def add_hits(
    centres: NDArray[Any],
    count: int,
    table: NDArray[np.int32],
    pose: Pose,
    ranges: FloatArray,
    directions: FloatArray,
    range_max: float,
    now: MemoryClock,
    radius: float,
    merge: float,
    window: int,
) -> int:
    """Refine the nearest centre with each hit, or make a new one; returns the number of centres."""
    c, s = math.cos(pose[2]), math.sin(pose[2])
    reach = min(radius, range_max)
    for k in range(len(ranges)):
        if not 0.05 < ranges[k] < reach:
            continue
        px, py = ranges[k] * directions[k, 0], ranges[k] * directions[k, 1]
        x, y = pose[0] + c * px - s * py, pose[1] + s * px + c * py
        near = nearest(centres, table, x, y, merge)
        if near < 0:
            j, i = slot(x, y)
            if count >= len(centres) or table[j, i] >= 0:
                continue
            near = count
            table[j, i] = near
            centres[near].x, centres[near].y, centres[near].hits = x, y, 0.0
            count += 1
        centre = centres[near]
        centre.hits += 1.0
        weight = 1.0 / min(centre.hits, window)
        centre.x += weight * (x - centre.x)
        centre.y += weight * (y - centre.y)
        centre.scan, centre.travel, centre.turned = now.scan, now.travel, now.turned
    return count


@kernel
def nearest(
    centres: NDArray[Any], table: NDArray[np.int32], x: float, y: float, within: float
) -> int:
    """The centre nearest to a point among the voxels around it, or -1."""
    j, i = slot(x, y)
    best, least = -1, within * within
    for b in range(j - 1, j + 2):
        for a in range(i - 1, i + 2):
            k: int = table[b % TABLE_SIDE, a % TABLE_SIDE]
            if k >= 0:
                squared = (centres[k].x - x) ** 2 + (centres[k].y - y) ** 2
                if squared < least:
                    best, least = k, squared
    return best


@kernel
def select(centres: NDArray[Any], sure: int, share: float, blunt: float) -> FloatArray:
    """Positions of the centres that were hit often enough, by themselves and beside neighbours.

    The last centre of a row averages over the end of the wall it stands for. A centre with
    neighbours on one side only therefore gets a second point, `blunt` metres farther out.
    """
    table = np.full((TABLE_SIDE, TABLE_SIDE), -1, dtype=np.int32)
    for k in range(len(centres)):
        j, i = slot(centres[k].x, centres[k].y)
        best: int = table[j, i]
        if best < 0 or centres[best].hits < centres[k].hits:
            table[j, i] = k
    points = np.empty((2 * len(centres), 2))
    n = 0
    for k in range(len(centres)):
        centre = centres[k]
        most, weight, x, y = neighbourhood(centres, table, k, share)
        if centre.hits >= sure and centre.hits >= share * most:
            points[n, 0], points[n, 1] = centre.x, centre.y
            n += 1
            away = math.hypot(x, y)
            if weight > 0 and away > 0.6 * weight and centre.hits >= 2.0 * share * most:
                points[n, 0], points[n, 1] = (
                    centre.x - blunt * x / away,
                    centre.y - blunt * y / away,
                )
                n += 1
    return points[:n]


@kernel
def neighbourhood(
    centres: NDArray[Any], table: NDArray[np.int32], k: int, share: float
) -> tuple[float, float, float, float]:
    """What lies around a centre.

    Returns:
        the largest number of hits of a neighbour; the number of centres up to two voxels away;
        x and y of the sum of the unit vectors to them.
    """
    j, i = slot(centres[k].x, centres[k].y)
    most, count, x, y = 0.0, 0.0, 0.0, 0.0
    for b in range(j - 2, j + 3):
        for a in range(i - 2, i + 3):
            m: int = table[b % TABLE_SIDE, a % TABLE_SIDE]
            if m < 0 or m == k:
                continue
            dx, dy = centres[m].x - centres[k].x, centres[m].y - centres[k].y
            away = math.hypot(dx, dy)
            if away < NEIGHBOUR_DISTANCE:
                most = max(most, centres[m].hits)
            if centres[m].hits >= share * centres[k].hits and away > 1e-6:
                count, x, y = count + 1.0, x + dx / away, y + dy / away
    return most, count, x, y
