"""Nearest points of walls, leaves and the robot, for people and leaves that move."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_env.world.dynamics.body_row import BODY_HEADING, BODY_X, BODY_Y, HALF_LENGTH, HALF_WIDTH
from semnav_env.world.lidar.culling import Culling, cell_of
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

WALL_RANGE = 2.0
"""Distance up to which walls matter to a person, metres: at 1.34 m/s more than a second of
walking."""

MAX_WALL_PIECES = 128
"""Largest number of pieces of wall that one person avoids, the size of a buffer; `walk` still lets
nobody step into the others."""


@kernel
def nearest_on_segment(
    x: float, y: float, x1: float, y1: float, x2: float, y2: float
) -> tuple[float, float]:
    """The point of a segment that is nearest to (x, y)."""
    dx, dy = x2 - x1, y2 - y1
    squared = dx * dx + dy * dy
    along = ((x - x1) * dx + (y - y1) * dy) / squared if squared > 0.0 else 0.0
    along = min(max(along, 0.0), 1.0)
    return x1 + along * dx, y1 + along * dy


@kernel
def nearest_on_body(x: float, y: float, body: FloatArray) -> tuple[float, float]:
    """The point of a robot's footprint that is nearest to (x, y), which may be (x, y) itself.

    Args:
        x: metres.
        y: metres.
        body: row of the robot, see `body_row.BODY_COLUMNS`, shape (8,).
    """
    c, s = math.cos(body[BODY_HEADING]), math.sin(body[BODY_HEADING])
    dx, dy = x - body[BODY_X], y - body[BODY_Y]
    ahead = min(max(c * dx + s * dy, -body[HALF_LENGTH]), body[HALF_LENGTH])
    left = min(max(c * dy - s * dx, -body[HALF_WIDTH]), body[HALF_WIDTH])
    return body[BODY_X] + c * ahead - s * left, body[BODY_Y] + s * ahead + c * left


@kernel
def walls_near(x: float, y: float, walls: Any, leaves: FloatArray, out: FloatArray) -> int:
    """Write the nearest points of the walls and leaves within `WALL_RANGE` of (x, y).

    Args:
        x: metres.
        y: metres.
        walls: `Culling` as (grid, starts, ends).
        leaves: x1, y1, x2, y2 of segments that move, shape (m, 4).
        out: rows x, y; shape (MOST, 2).

    Returns:
        How many there are; beyond `MAX_WALL_PIECES` the later ones are left out.
    """
    grid, starts, ends = walls
    cell = cell_of(grid, x, y)
    count = 0
    for i in range(len(leaves)):
        leaf = leaves[i]
        count = _keep(x, y, leaf[0], leaf[1], leaf[2], leaf[3], out, count)
    for k in range(starts[cell], starts[cell + 1]):
        count = _keep(x, y, ends[0, k], ends[1, k], ends[2, k], ends[3, k], out, count)
    return count


@kernel
def _keep(
    x: float, y: float, x1: float, y1: float, x2: float, y2: float, out: FloatArray, count: int
) -> int:
    near_x, near_y = nearest_on_segment(x, y, x1, y1, x2, y2)
    if (x - near_x) ** 2 + (y - near_y) ** 2 > WALL_RANGE * WALL_RANGE or count == len(out):
        return count
    out[count, 0], out[count, 1] = near_x, near_y
    return count + 1


@kernel
def nearest_wall(x: float, y: float, walls: Any, leaves: FloatArray) -> tuple[float, float]:
    """The nearest point of all walls and leaves within `WALL_RANGE`; far away if there is none."""
    grid, starts, ends = walls
    cell = cell_of(grid, x, y)
    best, best_x, best_y = np.inf, x + 10.0 * WALL_RANGE, y
    for k in range(starts[cell] - len(leaves), starts[cell + 1]):
        i = k - starts[cell] + len(leaves)
        if i < len(leaves):
            px, py = nearest_on_segment(
                x, y, leaves[i, 0], leaves[i, 1], leaves[i, 2], leaves[i, 3]
            )
        else:
            px, py = nearest_on_segment(x, y, ends[0, k], ends[1, k], ends[2, k], ends[3, k])
        squared = (x - px) ** 2 + (y - py) ** 2
        if squared < best:
            best, best_x, best_y = squared, px, py
    return best_x, best_y


def culled_walls(segments: FloatArray) -> tuple[np.ndarray, np.ndarray, FloatArray]:
    """The culled walls of segments, as `walls_near` takes them."""
    culling = Culling.of(segments, WALL_RANGE)
    return culling.grid, culling.starts, culling.ends
