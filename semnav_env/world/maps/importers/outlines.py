"""Outlines of the solid pixels of an image, along the pixels' edges.

Contour finders of image libraries join the centres of border pixels, so that a wall one pixel thick
gets no thickness and everything else loses one pixel. Here every pixel is the square that it is.
"""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from semnav_features.frames import FloatArray

EAST, NORTH, WEST, SOUTH = range(4)
EDGE_STEPS = np.array(((1, 0), (0, -1), (-1, 0), (0, 1)))
"""Columns and rows that an edge goes, by its direction, shape (4, 2)."""


def outlines(solid: NDArray[np.bool_], tolerance: float = 0.0) -> list[FloatArray]:
    """The closed outlines of the solid pixels and of the holes in them.

    Pixels that touch at a corner belong together, so nothing sees through a slanted wall.

    With a tolerance, an outline runs through the middles of the pixels' edges, which cuts every
    corner by up to 0.36 pixels and makes a slanted wall's steps a line, and is then simplified so
    that no point moves by more than the tolerance (Douglas and Peucker).

    Args:
        solid: shape (rows, columns).
        tolerance: pixels; 0 for the exact outline.

    Returns:
        Of each outline its corners (column, row), shape (k, 2), the last like the first; (0, 0)
        is the upper left corner of the image, (columns, rows) the lower right one.
    """
    rings = [
        closed_ring(points + 0.5 * steps if tolerance else points)
        for points, steps in _walks(solid)
    ]
    simple = shapely.simplify(np.asarray([shapely.linearrings(ring) for ring in rings]), tolerance)
    return [shapely.get_coordinates(ring) for ring in simple]


def _walks(solid: NDArray[np.bool_]) -> list[tuple[FloatArray, FloatArray]]:
    """For each outline, with solid pixels on the left, the start and the step of each edge."""
    starts, directions = _edges(solid)
    following = _following(starts, directions, solid.shape[1] + 1).tolist()
    left = np.ones(len(starts), dtype=bool)
    walks = []
    for first in range(len(starts)):
        walk = []
        edge = first
        while left[edge]:
            left[edge] = False
            walk.append(edge)
            edge = following[edge]
        if walk:
            walks.append((starts[walk].astype(np.float64), EDGE_STEPS[directions[walk]]))
    return walks


def _edges(solid: NDArray[np.bool_]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Edges between a solid pixel and another one: (column, row) of the start, and direction."""
    padded = np.pad(solid, 1)
    inside = padded[1:-1, 1:-1]
    beside = (padded[2:, 1:-1], padded[1:-1, 2:], padded[:-2, 1:-1], padded[1:-1, :-2])
    corners = ((0, 1), (1, 1), (1, 0), (0, 0))
    starts, directions = [], []
    for direction, (neighbour, corner) in enumerate(zip(beside, corners, strict=True)):
        rows, columns = np.nonzero(inside & ~neighbour)
        starts.append(np.stack((columns, rows), axis=1) + corner)
        directions.append(np.full(len(rows), direction))
    return np.concatenate(starts), np.concatenate(directions)


def _following(
    starts: NDArray[np.intp], directions: NDArray[np.intp], width: int
) -> NDArray[np.intp]:
    """Index of the edge after each; where two pixels touch at a corner, the other pixel's edge."""
    keys = 4 * (starts[:, 1] * width + starts[:, 0]) + directions
    order = np.argsort(keys)
    ends = starts + EDGE_STEPS[directions]
    corner = 4 * (ends[:, 1] * width + ends[:, 0])
    following = np.full(len(starts), -1)
    for turn in (1, 0, -1):  # left, straight on, right: the last that there is counts
        wanted = corner + (directions + turn) % 4
        place = np.minimum(np.searchsorted(keys, wanted, sorter=order), len(keys) - 1)
        there = keys[order[place]] == wanted
        following[there] = order[place[there]]
    return following


def closed_ring(points: FloatArray) -> FloatArray:
    """A ring's points, the first once more at the end."""
    return np.concatenate((points, points[:1]))
