"""Writes what was sensed into the row of an observation."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from semnav_env.commands import MAX_CLAUSES
from semnav_env.features.frames import FloatArray, Pose, points_to_local
from semnav_env.features.kernels.door_memory import door_counts
from semnav_env.features.kernels.layout import CORNERS, CORRIDORS, DOORS, WALLS
from semnav_env.features.kernels.scratch import Features
from semnav_env.grounding.goal import Goal, door_of
from semnav_env.observations import (
    KINDS,
    N_CORNERS,
    N_CORRIDORS,
    N_DOORS,
    N_FELT,
    N_REMEMBERED,
    N_WALLS,
    ROW_SIZE,
    STARTS,
)

_WALLS, _DOORS, _CORNERS = STARTS["walls"], STARTS["doors"], STARTS["corners"]
_CORRIDORS, _REMEMBERED = STARTS["corridors"], STARTS["remembered_doors"]
_FELT, _REST = STARTS["felt"], STARTS["clause"]


@njit(cache=True, error_model="numpy")
def write_features(
    row: NDArray[np.float32], features: Features, mount: tuple[float, float, float]
) -> None:
    """Write the features of a scan, given in the lidar frame, into the row in the robot frame."""
    c, s = math.cos(mount[2]), math.sin(mount[2])
    row[:_REMEMBERED] = 0.0
    for i in range(min(features.counts[WALLS], N_WALLS)):
        wall = features.walls[i]
        _write_ends(row, _WALLS + 4 * i, wall, mount[0], mount[1], c, s)
        row[_WALLS + 4 * N_WALLS + i] = 1.0
    for i in range(min(features.counts[DOORS], N_DOORS)):
        door = features.doors[i]
        _write_ends(row, _DOORS + 4 * i, door, mount[0], mount[1], c, s)
        row[_DOORS + 4 * N_DOORS + i] = 1.0
    for i in range(min(features.counts[CORNERS], N_CORNERS)):
        corner = features.corners[i]
        row[_CORNERS + 3 * i] = mount[0] + c * corner.x - s * corner.y
        row[_CORNERS + 3 * i + 1] = mount[1] + s * corner.x + c * corner.y
        row[_CORNERS + 3 * i + 2] = corner.kind
        row[_CORNERS + 3 * N_CORNERS + i] = 1.0
    for i in range(min(features.counts[CORRIDORS], N_CORRIDORS)):
        probe = features.corridors[i]
        x, y = 0.5 * (probe.start_x + probe.end_x), 0.5 * (probe.start_y + probe.end_y)
        row[_CORRIDORS + 2 * i] = mount[0] + c * x - s * y
        row[_CORRIDORS + 2 * i + 1] = mount[1] + s * x + c * y
        row[_CORRIDORS + 2 * N_CORRIDORS + i] = 1.0


@njit(cache=True, error_model="numpy")
def write_remembered(
    row: NDArray[np.float32], doors: np.ndarray, used: int, pose: tuple[float, float, float]
) -> None:
    """Write the remembered doors that count, given in the odometry frame, in the robot frame."""
    row[_REMEMBERED:_FELT] = 0.0
    c, s = math.cos(pose[2]), -math.sin(pose[2])
    x, y = -(c * pose[0] - s * pose[1]), -(s * pose[0] + c * pose[1])
    k = 0
    for i in range(used):
        if k < N_REMEMBERED and door_counts(doors[:used], i):
            door = doors[i]
            _write_ends(row, _REMEMBERED + 4 * k, door, x, y, c, s)
            row[_REMEMBERED + 4 * N_REMEMBERED + k] = 1.0
            k += 1


def write_felt(row: NDArray[np.float32], walls: FloatArray, pose: Pose) -> None:
    """Write walls that were felt, given in the odometry frame, in the robot frame, shape (n, 4)."""
    row[_FELT:_REST] = 0.0
    n = min(len(walls), N_FELT)
    row[_FELT : _FELT + 4 * n] = points_to_local(pose, walls[:n].reshape(-1, 2)).ravel()
    row[_FELT + 4 * N_FELT : _FELT + 4 * N_FELT + n] = 1.0


@njit(cache=True, error_model="numpy")
def write_scan(
    row: NDArray[np.float32], ranges: FloatArray, range_min: float, range_max: float
) -> None:
    """Write the ranges, and `range_max` where a beam has no return."""
    for i in range(np.uint64(len(ranges))):  # unsigned, or it is tested for counting from the end
        measured = ranges[i]
        row[i] = measured if (measured >= range_min) & (measured < range_max) else range_max


@njit(cache=True, inline="always")
def _write_ends(
    row: NDArray[np.float32], at: int, item: Any, x: float, y: float, c: float, s: float
) -> None:
    row[at] = x + c * item.start_x - s * item.start_y
    row[at + 1] = y + s * item.start_x + c * item.start_y
    row[at + 2] = x + c * item.end_x - s * item.end_y
    row[at + 3] = y + s * item.end_x + c * item.end_y


@njit(cache=True, error_model="numpy")
def write_state(
    row: NDArray[np.float32],
    active: int,
    odometry: tuple[float, float, float],
    velocity: tuple[float, float, float],
    kind: int,
    goal: tuple[float, float, float],
    door: tuple[float, float, float, float],
    has_door: bool,
) -> None:
    """Write the active clause, the odometry and the goal (given in the odometry frame).

    The odometry is x, y, cosine and sine of the heading, and the velocity forward, left and
    turning. The goal is its kind (one of four), x, y, cosine and sine of its heading, the start
    and end of its door, and whether it has one.
    """
    row[_REST:ROW_SIZE] = 0.0
    if active < MAX_CLAUSES:
        row[_REST + active] = 1.0
    k = _REST + MAX_CLAUSES
    c, s = math.cos(odometry[2]), math.sin(odometry[2])
    row[k], row[k + 1], row[k + 2], row[k + 3] = odometry[0], odometry[1], c, s
    row[k + 4], row[k + 5], row[k + 6] = velocity
    k += 7
    row[k + kind] = 1.0
    k += KINDS
    row[k], row[k + 1] = _local(goal[0], goal[1], odometry, c, s)
    row[k + 2], row[k + 3] = math.cos(goal[2] - odometry[2]), math.sin(goal[2] - odometry[2])
    if has_door:
        row[k + 4], row[k + 5] = _local(door[0], door[1], odometry, c, s)
        row[k + 6], row[k + 7] = _local(door[2], door[3], odometry, c, s)
        row[k + 8] = 1.0


@njit(cache=True, inline="always")
def _local(
    x: float, y: float, pose: tuple[float, float, float], c: float, s: float
) -> tuple[float, float]:
    dx, dy = x - pose[0], y - pose[1]
    return c * dx + s * dy, c * dy - s * dx


_NO_DOOR = (0.0, 0.0, 0.0, 0.0)


def door_ends(goal: Goal) -> tuple[float, float, float, float]:
    """The goal's door as four numbers; zeros if it has none."""
    door = door_of(goal)
    return _NO_DOOR if door is None else (*door.start, *door.end)
