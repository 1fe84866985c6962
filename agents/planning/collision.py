"""Exact collision of a rectangular footprint with obstacle points.

Poses in this folder's kernels are those of the AXLE, the point a turn on the spot turns about, so
that such a turn changes the heading alone; the public functions take poses of the centre.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from semnav_env.agents.planning.distance import distance_to_marked
from semnav_env.features.frames import FloatArray, Point
from semnav_env.robots import RobotSpec

CELL = 0.05
"""Metres; cells of the distance field."""

BIN = 4
"""Cells along one side of a bin of points."""

SLACK = CELL * math.sqrt(2.0)
"""Metres; a point and a query each lie up to half a cell diagonal from their cell's centre."""

STRIDE = 0.06
"""Metres; between two poses that are tested no part of the body moves farther."""


class Body(NamedTuple):
    """A rectangle around its axle: extents in metres."""

    front: float
    rear: float
    half_width: float


class Field(NamedTuple):
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


def body_of(robot: RobotSpec) -> Body:
    """The robot's footprint around its axle."""
    half = robot.length / 2
    return Body(half - robot.axle, half + robot.axle, robot.width / 2)


def field_of(points: FloatArray, middle: Point, half_size: float) -> Field:
    """The points, shape (N, 2), in the square window of that middle and half size in metres."""
    n = BIN * math.ceil(2 * half_size / CELL / BIN)
    x, y = middle[0] - n * CELL / 2, middle[1] - n * CELL / 2
    return Field(x, y, *_sort_into_field(np.ascontiguousarray(points), x, y, n))


@njit(cache=True)
def _sort_into_field(
    points: FloatArray, x: float, y: float, n: int
) -> tuple[NDArray[np.float32], NDArray[np.int64], FloatArray]:
    bins = n // BIN
    marked = np.zeros((n, n), dtype=np.bool_)
    first = np.zeros(bins * bins + 1, dtype=np.int64)
    bin_of = np.full(len(points), -1, dtype=np.int64)
    for k in range(len(points)):
        i, j = math.floor((points[k, 0] - x) / CELL), math.floor((points[k, 1] - y) / CELL)
        if 0 <= i < n and 0 <= j < n:
            marked[j, i] = True
            bin_of[k] = (j // BIN) * bins + i // BIN
            first[bin_of[k] + 1] += 1
    for b in range(bins * bins):
        first[b + 1] += first[b]
    place = first[:-1].copy()
    kept = np.empty((first[-1], 2))
    for k in range(len(points)):
        if bin_of[k] >= 0:
            kept[place[bin_of[k]]] = points[k]
            place[bin_of[k]] += 1
    return distance_to_marked(marked, CELL), first, kept


@njit(cache=True)
def distance_at(field: Field, x: float, y: float) -> float:
    """The field's distance at a point, metres; infinite outside the window."""
    i, j = math.floor((x - field.x) / CELL), math.floor((y - field.y) / CELL)
    n = field.distance.shape[0]
    if 0 <= i < n and 0 <= j < n:
        return float(field.distance[j, i])
    return math.inf


@njit(cache=True)
def is_clear(field: Field, body: Body, x: float, y: float, heading: float, margin: float) -> bool:
    """Whether the body at this axle pose, grown by `margin` metres, holds no obstacle point."""
    c, s = math.cos(heading), math.sin(heading)
    middle = (body.front - body.rear) / 2
    length, width = (body.front + body.rear) / 2 + margin, body.half_width + margin
    mx, my = x + c * middle, y + s * middle
    distance = distance_at(field, mx, my)
    if distance > math.hypot(length, width) + SLACK:
        return True
    if distance < min(length, width) - SLACK:
        return False
    quarter = length / 4
    radius = math.hypot(quarter, width) + SLACK
    for k in range(-3, 4, 2):
        if distance_at(field, mx + c * k * quarter, my + s * k * quarter) <= radius:
            return not _holds_point(field, mx, my, c, s, length, width)
    return True


@njit(cache=True)
def _holds_point(
    field: Field, x: float, y: float, c: float, s: float, length: float, width: float
) -> bool:
    size = CELL * BIN
    bins = field.distance.shape[0] // BIN
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


@njit(cache=True)
def bins_around(field: Field, x: float, y: float, radius: float) -> list[tuple[int, int]]:
    """Where the points of the rows of bins around a place start and end."""
    size = CELL * BIN
    bins = field.distance.shape[0] // BIN
    i0 = max(0, math.floor((x - radius - field.x) / size))
    i1 = min(bins - 1, math.floor((x + radius - field.x) / size))
    j0 = max(0, math.floor((y - radius - field.y) / size))
    j1 = min(bins - 1, math.floor((y + radius - field.y) / size))
    if i0 > i1:
        j1 = j0 - 1
    return [(field.first[j * bins + i0], field.first[j * bins + i1 + 1]) for j in range(j0, j1 + 1)]


@njit(cache=True)
def room_at(field: Field, body: Body, x: float, y: float, heading: float) -> float:
    """About how far the body's sides and ends are from the nearest point, metres, never below 0.

    Taken at three inscribed circles along the body, which leaves out its corners.
    """
    c, s = math.cos(heading), math.sin(heading)
    ahead, behind = body.front - body.half_width, body.half_width - body.rear
    nearest = distance_at(field, x + c * ahead, y + s * ahead)
    nearest = min(nearest, distance_at(field, x + c * behind, y + s * behind))
    middle = (ahead + behind) / 2
    nearest = min(nearest, distance_at(field, x + c * middle, y + s * middle))
    return max(0.0, nearest - body.half_width)
