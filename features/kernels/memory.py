"""Numba kernels that join the walls and doors of many scans in one frame."""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.layout import DOORS, WALLS

REMEMBERED = np.dtype(
    [
        ("start_x", "f8"),
        ("start_y", "f8"),
        ("end_x", "f8"),
        ("end_y", "f8"),
        ("hits", "i8"),
        ("misses", "i8"),
    ]
)
"""A remembered wall or door: its ends, how often it was seen, how often contradicted."""


@njit(cache=True)
def place(entry: NDArray, x: float, y: float, heading: float) -> tuple[float, float, float, float]:
    """The ends of a wall or door, moved from the frame at (x, y, heading) to its parent."""
    c, s = math.cos(heading), math.sin(heading)
    return (
        x + c * entry.start_x - s * entry.start_y,
        y + s * entry.start_x + c * entry.start_y,
        x + c * entry.end_x - s * entry.end_y,
        y + s * entry.end_x + c * entry.end_y,
    )


@njit(cache=True)
def remember_walls(
    seen: NDArray, count: int, pose: tuple[float, float, float], memory: NDArray, used: int
) -> int:
    """Fuse the walls of a scan with the remembered ones.

    A wall joins a remembered one that faces the same side, within 8 degrees and 0.15 m of its
    line, and overlaps it or ends less than 0.3 m from it: a gap one could pass stays open.

    Args:
        seen: the scan's walls (`layout.WALL`), lidar frame.
        count: how many.
        pose: of the lidar in the memory's frame.
        memory: `REMEMBERED`, changed in place; when it is full, new walls are left out.
        used: entries used before.

    Returns:
        Entries used afterwards.
    """
    for i in range(count):
        x1, y1, x2, y2 = place(seen[i], pose[0], pose[1], pose[2])
        length = math.hypot(x2 - x1, y2 - y1)
        if length < 1e-6:
            continue
        ux, uy = (x2 - x1) / length, (y2 - y1) / length
        match = -1
        for k in range(used):
            if _same_wall(memory[k], x1, y1, x2, y2, ux, uy):
                match = k
                break
        if match >= 0:
            _fuse_wall(memory[match], x1, y1, x2, y2, length)
        elif used < len(memory):
            entry = memory[used]
            entry.start_x, entry.start_y, entry.end_x, entry.end_y = x1, y1, x2, y2
            entry.hits, entry.misses = 1, 0
            used += 1
    return used


@njit(cache=True)
def _same_wall(
    old: NDArray, x1: float, y1: float, x2: float, y2: float, ux: float, uy: float
) -> bool:
    dx, dy = old.end_x - old.start_x, old.end_y - old.start_y
    length = math.hypot(dx, dy)
    if dx * ux + dy * uy < 0.990 * length:
        return False
    vx, vy = dx / length, dy / length
    t1 = (x1 - old.start_x) * vx + (y1 - old.start_y) * vy
    t2 = (x2 - old.start_x) * vx + (y2 - old.start_y) * vy
    if t1 > length + 0.3 or t2 < -0.3:
        return False
    mid = 0.5 * (max(t1, 0.0) + min(t2, length))
    share = (mid - t1) / max(t2 - t1, 1e-9)
    px, py = x1 + share * (x2 - x1), y1 + share * (y2 - y1)
    return abs((px - old.start_x) * vy - (py - old.start_y) * vx) < 0.15


@njit(cache=True)
def _fuse_wall(old: NDArray, x1: float, y1: float, x2: float, y2: float, length: float) -> None:
    """The line is the mean weighted by length and sightings; its extent is the union of both."""
    dx, dy = old.end_x - old.start_x, old.end_y - old.start_y
    old_length = math.hypot(dx, dy)
    weight = old_length * min(old.hits, 10)
    total = weight + length
    mx = weight * dx / old_length + (x2 - x1)
    my = weight * dy / old_length + (y2 - y1)
    norm = math.hypot(mx, my)
    vx, vy = mx / norm, my / norm
    cx = (weight * 0.5 * (old.start_x + old.end_x) + length * 0.5 * (x1 + x2)) / total
    cy = (weight * 0.5 * (old.start_y + old.end_y) + length * 0.5 * (y1 + y2)) / total
    low = min((old.start_x - cx) * vx + (old.start_y - cy) * vy, (x1 - cx) * vx + (y1 - cy) * vy)
    high = max((old.end_x - cx) * vx + (old.end_y - cy) * vy, (x2 - cx) * vx + (y2 - cy) * vy)
    old.start_x, old.start_y = cx + low * vx, cy + low * vy
    old.end_x, old.end_y = cx + high * vx, cy + high * vy
    old.hits += 1


@njit(cache=True)
def remember_doors(
    seen: NDArray, count: int, pose: tuple[float, float, float], memory: NDArray, used: int
) -> int:
    """Fuse the doors of a scan with the remembered ones; arguments as for `remember_walls`.

    Two sightings are one door if both jambs agree within 0.4 m, whichever side it is seen from;
    the jambs become the mean of the last ten sightings.
    """
    for i in range(count):
        x1, y1, x2, y2 = place(seen[i], pose[0], pose[1], pose[2])
        best, nearest, swap = -1, 0.4, False
        for k in range(used):
            old = memory[k]
            same = max(
                math.hypot(x1 - old.start_x, y1 - old.start_y),
                math.hypot(x2 - old.end_x, y2 - old.end_y),
            )
            other = max(
                math.hypot(x2 - old.start_x, y2 - old.start_y),
                math.hypot(x1 - old.end_x, y1 - old.end_y),
            )
            if min(same, other) < nearest:
                best, nearest, swap = k, min(same, other), other < same
        if best >= 0:
            old = memory[best]
            if swap:
                x1, y1, x2, y2 = x2, y2, x1, y1
            share = 1.0 / min(old.hits + 1, 10)
            old.start_x += share * (x1 - old.start_x)
            old.start_y += share * (y1 - old.start_y)
            old.end_x += share * (x2 - old.end_x)
            old.end_y += share * (y2 - old.end_y)
            old.hits += 1
        elif used < len(memory):
            old = memory[used]
            old.start_x, old.start_y, old.end_x, old.end_y = x1, y1, x2, y2
            old.hits, old.misses = 1, 0
            used += 1
    return used


@njit(cache=True)
def contradict_doors(
    ranges: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: tuple[float, float, float],
    memory: NDArray,
    used: int,
) -> None:
    """Count a miss for every remembered door whose opening the scan finds filled.

    Args:
        ranges: of the scan, metres, shape (n,).
        angle_min: of the scan, radians.
        angle_increment: of the scan, radians.
        pose: of the lidar in the memory's frame.
        memory: `REMEMBERED` doors, changed in place.
        used: entries used.
    """
    for k in range(used):
        door = memory[k]
        filled = 0
        for share in (0.3, 0.5, 0.7):
            dx = door.start_x + share * (door.end_x - door.start_x) - pose[0]
            dy = door.start_y + share * (door.end_y - door.start_y) - pose[1]
            turn = math.atan2(dy, dx) - pose[2] - angle_min
            turn -= 2.0 * math.pi * math.floor(turn / (2.0 * math.pi))
            beam = int(turn / angle_increment + 0.5)
            distance = math.hypot(dx, dy)
            if beam < len(ranges) and distance > 0.5 and abs(ranges[beam] - distance) < 0.12:
                filled += 1
        if filled >= 2:
            door.misses += 1


@njit(cache=True)
def remember(
    walls: NDArray,
    doors: NDArray,
    counts: NDArray,
    ranges: FloatArray,
    angle_min: float,
    angle_increment: float,
    pose: tuple[float, float, float],
    memory: tuple[NDArray, NDArray, NDArray],
) -> None:
    """Add one scan to the memory.

    Args:
        walls: the scan's walls (`layout.WALL`), lidar frame.
        doors: its doors (`layout.DOOR`).
        counts: entries used, by kind.
        ranges: of the scan, metres.
        angle_min: of the scan, radians.
        angle_increment: of the scan, radians.
        pose: of the lidar in the memory's frame.
        memory: walls, doors (`REMEMBERED`) and how many of each are used, changed in place.
    """
    known_walls, known_doors, used = memory
    used[0] = remember_walls(walls, counts[WALLS], pose, known_walls, used[0])
    contradict_doors(ranges, angle_min, angle_increment, pose, known_doors, used[1])
    used[1] = remember_doors(doors, counts[DOORS], pose, known_doors, used[1])
