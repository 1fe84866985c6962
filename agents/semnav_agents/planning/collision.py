"""Exact collision of a rectangular footprint with obstacle points.

Poses in the kernels of this folder are poses of the robot's axle: the point about which it turns on
the spot, so that such a turn changes the heading alone. `planner.plan` and the classes that agents
use take poses of the robot's centre.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_env.robots import RobotSpec
from semnav_env.world.grid.distance import distance_to_marked
from semnav_features.frames import FloatArray, Point
from semnav_features.kernels.compiling import kernel

FIELD_CELL = 0.05
"""Side of a cell of the distance field, metres; where it cannot decide, the points do."""

BIN_CELLS = 4
"""Cells along one side of a bin, in which the points are kept."""

CELL_DIAGONAL = FIELD_CELL * math.sqrt(2.0)
"""Largest error of the distance field, metres: a point and the place that is asked about each
lie up to half a cell diagonal from the centre of their cell."""

MAX_SWEEP_STEP = 0.06
"""Farthest that any part of the body moves between two tested poses, metres: between two tests an
obstacle reaches into the body by at most half of it."""


class Footprint(NamedTuple):
    """The robot's rectangle, measured from its axle, metres.

    Attributes:
        front: from the axle to the front.
        rear: from the axle to the rear.
        half_width: from the axle to either side.
    """

    front: float
    rear: float
    half_width: float


class ObstacleField(NamedTuple):
    """Obstacle points in a square window.

    Attributes:
        x: left edge, metres.
        y: lower edge, metres.
        distance: from each cell's centre to the nearest cell with a point, metres, (n, n), [y, x].
        first: where each bin's points start in `points`, (bins^2 + 1,).
        points: sorted by bin, metres, (N, 2).
    """

    x: float
    y: float
    distance: NDArray[np.float32]
    first: NDArray[np.int64]
    points: FloatArray


def footprint_of(robot: RobotSpec) -> Footprint:
    """The robot's footprint around its axle."""
    half = robot.length / 2
    return Footprint(half - robot.axle, half + robot.axle, robot.width / 2)


def obstacle_field(points: FloatArray, middle: Point, half_size: float) -> ObstacleField:
    """The obstacle points of a square window.

    Args:
        points: metres, shape (N, 2).
        middle: of the window, metres.
        half_size: half the side of the window, metres.
    """
    n = BIN_CELLS * math.ceil(2 * half_size / FIELD_CELL / BIN_CELLS)
    x, y = middle[0] - n * FIELD_CELL / 2, middle[1] - n * FIELD_CELL / 2
    return ObstacleField(x, y, *_sort_into_field(np.ascontiguousarray(points), x, y, n))


@kernel
def _sort_into_field(
    points: FloatArray, x: float, y: float, n: int
) -> tuple[NDArray[np.float32], NDArray[np.int64], FloatArray]:
    """Distance field, first point of each bin, and the points sorted by bin: a counting sort."""
    bins = n // BIN_CELLS
    marked = np.zeros((n, n), dtype=np.bool_)
    first = np.zeros(bins * bins + 1, dtype=np.int64)
    bin_of = np.full(len(points), -1, dtype=np.int64)
    for k in range(len(points)):
        i, j = (
            math.floor((points[k, 0] - x) / FIELD_CELL),
            math.floor((points[k, 1] - y) / FIELD_CELL),
        )
        if 0 <= i < n and 0 <= j < n:
            marked[j, i] = True
            bin_of[k] = (j // BIN_CELLS) * bins + i // BIN_CELLS
            first[bin_of[k] + 1] += 1
    for b in range(bins * bins):  # the counts become the places where bins start
        first[b + 1] += first[b]
    place = first[:-1].copy()
    kept = np.empty((first[-1], 2))
    for k in range(len(points)):
        if bin_of[k] >= 0:
            kept[place[bin_of[k]]] = points[k]
            place[bin_of[k]] += 1
    distance = np.empty((n, n), dtype=np.float32)
    distance_to_marked(marked, FIELD_CELL, distance)
    return distance, first, kept


@kernel
def distance_at(field: ObstacleField, x: float, y: float) -> float:
    """The field's distance at a point, metres; infinite outside the window."""
    i, j = math.floor((x - field.x) / FIELD_CELL), math.floor((y - field.y) / FIELD_CELL)
    n = field.distance.shape[0]
    if 0 <= i < n and 0 <= j < n:
        return float(field.distance[j, i])
    return math.inf


@kernel
def is_clear(
    field: ObstacleField, body: Footprint, x: float, y: float, heading: float, margin: float
) -> bool:
    """Whether the body at this axle pose, grown by `margin` metres, holds no obstacle point."""
    c, s = math.cos(heading), math.sin(heading)
    middle = (body.front - body.rear) / 2
    length, width = (body.front + body.rear) / 2 + margin, body.half_width + margin
    mx, my = x + c * middle, y + s * middle
    distance = distance_at(field, mx, my)
    # the nearest point lies outside the circle around the body, or inside its inscribed circle
    if distance > math.hypot(length, width) + CELL_DIAGONAL:
        return True
    if distance < min(length, width) - CELL_DIAGONAL:
        return False
    quarter = length / 4  # four circles along the body cover it; mostly no point is in any of them
    radius = math.hypot(quarter, width) + CELL_DIAGONAL
    for k in range(-3, 4, 2):
        if distance_at(field, mx + c * k * quarter, my + s * k * quarter) <= radius:
            return not _holds_point(field, mx, my, c, s, length, width)
    return True


@kernel
def _holds_point(
    field: ObstacleField, x: float, y: float, c: float, s: float, length: float, width: float
) -> bool:
    """Whether a point lies in the rectangle of these half sides around (x, y), turned by (c, s)."""
    size = FIELD_CELL * BIN_CELLS
    bins = field.distance.shape[0] // BIN_CELLS
    reach_x, reach_y = abs(c) * length + abs(s) * width, abs(s) * length + abs(c) * width
    i0 = max(0, math.floor((x - reach_x - field.x) / size))
    i1 = min(bins - 1, math.floor((x + reach_x - field.x) / size))
    j0 = max(0, math.floor((y - reach_y - field.y) / size))
    j1 = min(bins - 1, math.floor((y + reach_y - field.y) / size))
    for j in range(j0, j1 + 1):
        if i0 > i1:
            break
        for k in range(field.first[j * bins + i0], field.first[j * bins + i1 + 1]):
            dx, dy = field.points[k, 0] - x, field.points[k, 1] - y
            if abs(c * dx + s * dy) < length and abs(c * dy - s * dx) < width:
                return True
    return False


@kernel
def bins_around(field: ObstacleField, x: float, y: float, radius: float) -> list[tuple[int, int]]:
    """Ranges (first, last + 1) of `field.points`, one for each row of bins around a place."""
    size = FIELD_CELL * BIN_CELLS
    bins: int = field.distance.shape[0] // BIN_CELLS
    i0 = max(0, math.floor((x - radius - field.x) / size))
    i1 = min(bins - 1, math.floor((x + radius - field.x) / size))
    j0 = max(0, math.floor((y - radius - field.y) / size))
    j1 = min(bins - 1, math.floor((y + radius - field.y) / size))
    if i0 > i1:
        j1 = j0 - 1
    return [(field.first[j * bins + i0], field.first[j * bins + i1 + 1]) for j in range(j0, j1 + 1)]


@kernel
def room_at(field: ObstacleField, body: Footprint, x: float, y: float, heading: float) -> float:
    """Approximate distance from the body to the nearest obstacle point, metres, at least 0.

    It is measured from three inscribed circles along the body, which leave out its corners.
    """
    c, s = math.cos(heading), math.sin(heading)
    ahead, behind = body.front - body.half_width, body.half_width - body.rear
    nearest = distance_at(field, x + c * ahead, y + s * ahead)
    nearest = min(nearest, distance_at(field, x + c * behind, y + s * behind))
    middle = (ahead + behind) / 2
    nearest = min(nearest, distance_at(field, x + c * middle, y + s * middle))
    return max(0.0, nearest - body.half_width)
