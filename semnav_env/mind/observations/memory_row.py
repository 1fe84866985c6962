"""Kernels that write what a robot remembers and was told: the row of `observation="command"`.

The row holds what `row.write_row` writes, the scan included, and then `layout.MEMORY_ENTRIES`. All
of it is seen from where the robot is; none of it depends on how the command was grounded.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.mind.belief.understand import Senses
from semnav_env.mind.observations.layout import (
    FEATURE_BOUND,
    HALLWAY,
    JUNCTION_ROWS,
    MEMORY_STARTS,
    REMEMBERED_WALL_ROWS,
    ROW_SIZE,
)
from semnav_env.mind.observations.row import to_robot, write_row
from semnav_features.corridor import MIN_CONTINUATION
from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.corridor_survey import survey
from semnav_features.kernels.memory import what_counts

_WALLS, _WALLS_MASK = MEMORY_STARTS["remembered_walls"], MEMORY_STARTS["remembered_walls_mask"]
_JUNCTIONS, _JUNCTIONS_MASK = MEMORY_STARTS["junctions"], MEMORY_STARTS["junctions_mask"]
_WAYS, _WAYS_MASK = MEMORY_STARTS["told_ways"], MEMORY_STARTS["told_ways_mask"]
_DOORS, _DOORS_MASK = MEMORY_STARTS["told_doors"], MEMORY_STARTS["told_doors_mask"]
_HALLWAY, _START = MEMORY_STARTS["hallway"], MEMORY_STARTS["start"]
_HALF_WIDTH = _HALLWAY + HALLWAY.columns.index("half_width")


@kernel(shared=True)
def write_command_row(row: NDArray[np.float32], senses: Senses) -> None:
    """Write all entries, the scan, and what is remembered and told.

    Args:
        row: shape (ROW_SIZE + beams + MEMORY_SIZE,).
        senses: arrays of the belief.
    """
    split = ROW_SIZE + len(senses.ranges)
    write_row(row[:split], senses)
    believed = senses.estimate[0].pose
    pose, memory = (believed[0], believed[1], believed[2]), row[split:]
    memory[:] = 0.0
    walls, doors, _ = what_counts(senses.remembered)
    pieces, used = senses.bumps
    _write_walls(memory, walls, pose)
    _write_corridor(memory, np.concatenate((walls, pieces[: used[0]])), doors, pose)
    _write_told(memory, senses.told, pose)
    c, s = math.cos(pose[2]), math.sin(pose[2])
    memory[_START], memory[_START + 1] = to_robot(0.0, 0.0, pose, c, s)
    memory[_START + 2], memory[_START + 3] = c, -s


@kernel
def _write_walls(memory: NDArray[np.float32], walls: FloatArray, pose: Pose) -> None:
    """Write the remembered walls, the nearest first."""
    c, s = math.cos(pose[2]), math.sin(pose[2])
    away = np.empty(len(walls))
    for i in range(len(walls)):
        away[i] = _distance(walls[i], pose[0], pose[1])
    order = np.argsort(away)
    for k in range(min(len(walls), REMEMBERED_WALL_ROWS)):
        _write_line(memory, _WALLS + 4 * k, walls[order[k]], pose, c, s)
        memory[_WALLS_MASK + k] = 1.0


@kernel
def _distance(wall: FloatArray, x: float, y: float) -> float:
    """The distance from a point to a wall, metres."""
    dx, dy = wall[2] - wall[0], wall[3] - wall[1]
    square = max(dx * dx + dy * dy, 1e-12)
    along = min(max(((x - wall[0]) * dx + (y - wall[1]) * dy) / square, 0.0), 1.0)
    return math.hypot(wall[0] + along * dx - x, wall[1] + along * dy - y)


@kernel
def _write_corridor(
    memory: NDArray[np.float32], walls: FloatArray, doors: FloatArray, pose: Pose
) -> None:
    """Write the axis of the corridor that the robot looks along, and the arms that leave it."""
    doubtful = np.zeros(len(doors), np.bool_)
    frame, half_width, end, _, openings = survey(walls, doors, doubtful, pose[0], pose[1], pose[2])
    c, s = math.cos(pose[2]), math.sin(pose[2])
    turned = frame[2] - pose[2]
    memory[_HALLWAY], memory[_HALLWAY + 1] = to_robot(frame[0], frame[1], pose, c, s)
    memory[_HALLWAY + 2], memory[_HALLWAY + 3] = math.cos(turned), math.sin(turned)
    memory[_HALF_WIDTH] = min(half_width, FEATURE_BOUND)
    memory[_HALF_WIDTH + 1] = min(end, FEATURE_BOUND)
    memory[_HALF_WIDTH + 2] = 1.0 if math.isfinite(end) else 0.0
    axis = (math.cos(frame[2]), math.sin(frame[2]))
    for k in range(min(len(openings), JUNCTION_ROWS)):
        _write_junction(memory, k, openings[k], frame, axis, pose, end)


@kernel
def _write_junction(
    memory: NDArray[np.float32],
    k: int,
    opening: Any,
    frame: Pose,
    axis: tuple[float, float],
    pose: Pose,
    end: float,
) -> None:
    """Write the mouth of an arm: its near and its far edge, its side, whether one can go past."""
    c, s = math.cos(pose[2]), math.sin(pose[2])
    side = 1.0 if opening.left else -1.0
    at, beside = _JUNCTIONS + 6 * k, side * opening.offset
    for i in range(2):
        along = opening.near if i == 0 else opening.far
        x = frame[0] + axis[0] * along - axis[1] * beside
        y = frame[1] + axis[1] * along + axis[0] * beside
        memory[at + 2 * i], memory[at + 2 * i + 1] = to_robot(x, y, pose, c, s)
    memory[at + 4] = side
    memory[at + 5] = 1.0 if opening.far < end - MIN_CONTINUATION else 0.0
    memory[_JUNCTIONS_MASK + k] = 1.0


@kernel
def _write_told(memory: NDArray[np.float32], told: Any, pose: Pose) -> None:
    """Write the told ways and their doors, given in the odometry frame, in the robot frame."""
    places, doors, used = told
    c, s = math.cos(pose[2]), math.sin(pose[2])
    for k in range(used[0]):
        at = _WAYS + 3 * k
        memory[at] = places[k, 0]
        memory[at + 1], memory[at + 2] = to_robot(places[k, 1], places[k, 2], pose, c, s)
        memory[_WAYS_MASK + k] = 1.0
    for k in range(used[1]):
        memory[_DOORS + 5 * k] = doors[k, 0]
        _write_line(memory, _DOORS + 5 * k + 1, doors[k, 1:], pose, c, s)
        memory[_DOORS_MASK + k] = 1.0


@kernel(inline=True)
def _write_line(
    memory: NDArray[np.float32], at: int, line: FloatArray, pose: Pose, c: float, s: float
) -> None:
    memory[at], memory[at + 1] = to_robot(line[0], line[1], pose, c, s)
    memory[at + 2], memory[at + 3] = to_robot(line[2], line[3], pose, c, s)
