"""Kernels that write what a robot believes into the row of an observation.

The row holds the entries of `layout.ENTRIES` one after the other, and then the scan.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.language import MAX_CLAUSES
from semnav_env.mind.belief.understand import Senses
from semnav_env.mind.observations.layout import (
    CORNER_ROWS,
    DOOR_ROWS,
    FEATURE_BOUND,
    GOAL,
    ODOMETRY,
    PROBE_ROWS,
    REMEMBERED_ROWS,
    ROW_SIZE,
    STARTS,
    UNBOUNDED,
    WALL_ROWS,
    column,
)
from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.door_memory import door_counts
from semnav_features.kernels.layout import CORNERS, CORRIDORS, DOORS, WALLS
from semnav_features.kernels.scratch import Features

_WALLS, _WALLS_MASK = STARTS["walls"], STARTS["walls_mask"]
_DOORS, _DOORS_MASK = STARTS["doors"], STARTS["doors_mask"]
_CORNERS, _CORNERS_MASK = STARTS["corners"], STARTS["corners_mask"]
_CORRIDORS, _CORRIDORS_MASK = STARTS["corridors"], STARTS["corridors_mask"]
_REMEMBERED, _REMEMBERED_MASK = STARTS["remembered_doors"], STARTS["remembered_doors_mask"]
_BUMPS, _BUMPS_MASK = STARTS["bumps"], STARTS["bumps_mask"]
_CLAUSE = STARTS["clause"]
_POSE, _TWIST = column(ODOMETRY, "x"), column(ODOMETRY, "forward")
_KIND, _PLACE = STARTS["goal"], column(GOAL, "x")
_JAMBS, _HAS_DOOR = column(GOAL, "door_start_x"), column(GOAL, "has_door")


@kernel(shared=True)
def write_row(row: NDArray[np.float32], senses: Senses) -> None:
    """Write all entries; and the scan, if there is room for it.

    What is seen and remembered is left out where features are not observed.

    Args:
        row: shape (ROW_SIZE,) or (ROW_SIZE + beams,).
        senses: arrays of the belief.
    """
    believed = senses.estimate[0]
    pose = (believed.pose[0], believed.pose[1], believed.pose[2])
    if believed.observes_features:
        _write_features(row, senses.features[0], senses.mount)
        _, doors, state, _ = senses.remembered
        _write_remembered(row, doors, state[0], pose)
        _write_bumps(row, senses.bumps, pose)
        _keep_within(row[:_REMEMBERED], FEATURE_BOUND)
        _keep_within(row[_REMEMBERED:_CLAUSE], UNBOUNDED)
    limits = senses.limits[0]
    if len(row) > ROW_SIZE:  # with the scan
        _write_scan(row[ROW_SIZE:], senses.ranges, limits.range_min, limits.range_max)
    row[_CLAUSE:ROW_SIZE] = 0.0
    if believed.clause < MAX_CLAUSES:
        row[_CLAUSE + believed.clause] = 1.0
    c, s = math.cos(pose[2]), math.sin(pose[2])
    row[_POSE], row[_POSE + 1], row[_POSE + 2], row[_POSE + 3] = pose[0], pose[1], c, s
    for i in range(3):
        row[_TWIST + i] = believed.velocity[i]
    _write_goal(row, believed.target, pose, c, s)
    _keep_within(row[_CLAUSE:ROW_SIZE], UNBOUNDED)


@kernel
def _keep_within(values: NDArray[np.float32], bound: float) -> None:
    """Cut values to the bound of their entries: odometry may err by any distance."""
    limit = np.float32(bound)
    for i in range(np.uint64(len(values))):
        values[i] = min(max(values[i], -limit), limit)


@kernel
def _write_goal(row: NDArray[np.float32], goal: Any, pose: Pose, c: float, s: float) -> None:
    """Write what to head for, given in the odometry frame, in the robot frame."""
    place, door = goal.pose, goal.door
    row[_KIND + goal.kind] = 1.0
    row[_PLACE], row[_PLACE + 1] = to_robot(place[0], place[1], pose, c, s)
    row[_PLACE + 2], row[_PLACE + 3] = math.cos(place[2] - pose[2]), math.sin(place[2] - pose[2])
    if goal.has_door:
        row[_JAMBS], row[_JAMBS + 1] = to_robot(door[0], door[1], pose, c, s)
        row[_JAMBS + 2], row[_JAMBS + 3] = to_robot(door[2], door[3], pose, c, s)
        row[_HAS_DOOR] = 1.0


@kernel
def _write_bumps(row: NDArray[np.float32], bumps: Any, pose: Pose) -> None:
    """Write walls that were bumped into, given in the odometry frame, in the robot frame."""
    row[_BUMPS:_CLAUSE] = 0.0
    ends, used = bumps
    c, s = math.cos(pose[2]), math.sin(pose[2])
    for i in range(used[0]):
        at = _BUMPS + 4 * i
        row[at], row[at + 1] = to_robot(ends[i, 0], ends[i, 1], pose, c, s)
        row[at + 2], row[at + 3] = to_robot(ends[i, 2], ends[i, 3], pose, c, s)
        row[_BUMPS_MASK + i] = 1.0


@kernel
def _write_features(row: NDArray[np.float32], features: Features, mount: Pose) -> None:
    """Write the features of a scan, given in the lidar frame, in the robot frame."""
    c, s = math.cos(mount[2]), math.sin(mount[2])
    row[:_REMEMBERED] = 0.0
    for i in range(min(features.counts[WALLS], WALL_ROWS)):
        _write_ends(row, _WALLS + 4 * i, features.walls[i], mount[0], mount[1], c, s)
        row[_WALLS_MASK + i] = 1.0
    for i in range(min(features.counts[DOORS], DOOR_ROWS)):
        _write_ends(row, _DOORS + 4 * i, features.doors[i], mount[0], mount[1], c, s)
        row[_DOORS_MASK + i] = 1.0
    for i in range(min(features.counts[CORNERS], CORNER_ROWS)):
        corner = features.corners[i]
        row[_CORNERS + 3 * i] = mount[0] + c * corner.x - s * corner.y
        row[_CORNERS + 3 * i + 1] = mount[1] + s * corner.x + c * corner.y
        row[_CORNERS + 3 * i + 2] = corner.kind
        row[_CORNERS_MASK + i] = 1.0
    for i in range(min(features.counts[CORRIDORS], PROBE_ROWS)):
        probe = features.corridors[i]
        x, y = 0.5 * (probe.start_x + probe.end_x), 0.5 * (probe.start_y + probe.end_y)
        row[_CORRIDORS + 2 * i] = mount[0] + c * x - s * y
        row[_CORRIDORS + 2 * i + 1] = mount[1] + s * x + c * y
        row[_CORRIDORS_MASK + i] = 1.0


@kernel
def _write_remembered(row: NDArray[np.float32], doors: np.ndarray, state: Any, pose: Pose) -> None:
    """Write the remembered doors that count, odometry frame, in the robot frame, nearest first."""
    row[_REMEMBERED:_BUMPS] = 0.0
    used = state.doors
    away = np.empty(used)
    for i in range(used):
        dx = 0.5 * (doors[i].start_x + doors[i].end_x) - pose[0]
        dy = 0.5 * (doors[i].start_y + doors[i].end_y) - pose[1]
        away[i] = dx * dx + dy * dy if door_counts(doors[:used], i, state) else np.inf
    c, s = math.cos(pose[2]), -math.sin(pose[2])
    x, y = -(c * pose[0] - s * pose[1]), -(s * pose[0] + c * pose[1])
    for k in range(min(used, REMEMBERED_ROWS)):
        nearest = 0
        for i in range(1, used):
            nearest = i if away[i] < away[nearest] else nearest
        if away[nearest] == np.inf:
            break
        _write_ends(row, _REMEMBERED + 4 * k, doors[nearest], x, y, c, s)
        row[_REMEMBERED_MASK + k] = 1.0
        away[nearest] = np.inf


@kernel
def _write_scan(
    row: NDArray[np.float32], ranges: FloatArray, range_min: float, range_max: float
) -> None:
    """Write the ranges, and `range_max` where a beam has no return."""
    for i in range(np.uint64(len(ranges))):  # unsigned, or it is tested for counting from the end
        measured = ranges[i]
        row[i] = measured if (measured >= range_min) & (measured < range_max) else range_max


@kernel(inline=True)
def _write_ends(
    row: NDArray[np.float32], at: int, item: Any, x: float, y: float, c: float, s: float
) -> None:
    row[at] = x + c * item.start_x - s * item.start_y
    row[at + 1] = y + s * item.start_x + c * item.start_y
    row[at + 2] = x + c * item.end_x - s * item.end_y
    row[at + 3] = y + s * item.end_x + c * item.end_y


@kernel(inline=True)
def to_robot(x: float, y: float, pose: Pose, c: float, s: float) -> tuple[float, float]:
    """A point of the odometry frame in that of a robot; c and s of the robot's heading."""
    dx, dy = x - pose[0], y - pose[1]
    return c * dx + s * dy, c * dy - s * dx
