"""Kernels that test whether a rectangle has space in a floor plan."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely import get_num_coordinates

from semnav_env.world.maps.floor_plan import FloorPlan, edges_of
from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel

HAS_ROOM, HAS_NO_ROOM, IS_DOUBTFUL = 0, 1, 2
"""Answers of `box_room`; a doubtful case must be decided by exact geometry."""

DOUBT = 1e-6
"""Distance between the outline of a rectangle and an edge below which rounding decides, metres."""


@dataclass(frozen=True)
class SolidEdges:
    """The edges that bound the space in a floor plan, for `box_room`; rows are x1, y1, x2, y2.

    Attributes:
        edges: everything solid, and the outline, shape (n, 4), metres.
        outline: the rings of the boundary, shape (m, 4).
        furniture: the outlines of furniture that covers an area, shape (k, 4).
        pieces: index of the first edge of each piece of furniture, and `k`.
    """

    edges: FloatArray
    outline: FloatArray
    furniture: FloatArray
    pieces: NDArray[np.int64]

    @classmethod
    def of(cls, plan: FloorPlan) -> SolidEdges:
        """Those of a plan."""
        pieces = np.asarray(plan.furniture.geometries)
        starts = np.cumsum([0, *(get_num_coordinates(pieces) - 1)])  # a ring ends where it begins
        outline = edges_of(plan.boundary)
        return cls(np.vstack((plan.segments, outline)), outline, edges_of(pieces), starts)

    @property
    def arrays(self) -> tuple[FloatArray, FloatArray, FloatArray, NDArray[np.int64]]:
        """All of them, as kernels take them."""
        return self.edges, self.outline, self.furniture, self.pieces

    def room(self, pose: Pose, half_length: float, half_width: float) -> int:
        """Whether a rectangle has room at the pose of its centre, see `box_room`."""
        return box_room(*self.arrays, *pose, half_length, half_width)


@kernel
def box_room(
    edges: FloatArray,
    outline: FloatArray,
    furniture: FloatArray,
    pieces: NDArray[np.int64],
    x: float,
    y: float,
    heading: float,
    half_length: float,
    half_width: float,
) -> int:
    """Whether a rectangle lies in the boundary, touches nothing solid and is in no furniture.

    Where no edge comes near its outline, its centre tells on which side of all edges it is.

    Args:
        edges: as in `SolidEdges`, and so on.
        outline: likewise.
        furniture: likewise.
        pieces: likewise.
        x: of the centre, metres.
        y: the same.
        heading: radians.
        half_length: half the extent along the heading, metres.
        half_width: half the extent across it, metres.
    """
    near = _meets(edges, x, y, heading, half_length, half_width)
    if near != HAS_ROOM:
        return near
    if not is_inside(outline, x, y):
        return HAS_NO_ROOM
    for k in range(len(pieces) - 1):
        if is_inside(furniture[pieces[k] : pieces[k + 1]], x, y):
            return HAS_NO_ROOM
    return HAS_ROOM


@kernel
def _meets(
    edges: FloatArray, x: float, y: float, heading: float, half_length: float, half_width: float
) -> int:
    """Whether an edge meets the rectangle: `HAS_NO_ROOM` if so."""
    c, s = math.cos(heading), math.sin(heading)
    reach = math.sqrt(half_length * half_length + half_width * half_width) + DOUBT
    answer = HAS_ROOM
    for i in range(len(edges)):
        ax, ay, bx, by = edges[i, 0] - x, edges[i, 1] - y, edges[i, 2] - x, edges[i, 3] - y
        if min(ax, bx) > reach or max(ax, bx) < -reach:
            continue
        if min(ay, by) > reach or max(ay, by) < -reach:
            continue
        x1, y1, x2, y2 = c * ax + s * ay, c * ay - s * ax, c * bx + s * by, c * by - s * bx
        if _meets_box(x1, y1, x2, y2, half_length - DOUBT, half_width - DOUBT):
            return HAS_NO_ROOM
        if _meets_box(x1, y1, x2, y2, half_length + DOUBT, half_width + DOUBT):
            answer = IS_DOUBTFUL
    return answer


@kernel
def _meets_box(
    x1: float, y1: float, x2: float, y2: float, half_length: float, half_width: float
) -> bool:
    """Whether a segment meets the box around the origin: no axis separates them."""
    if min(x1, x2) > half_length or max(x1, x2) < -half_length:
        return False
    if min(y1, y2) > half_width or max(y1, y2) < -half_width:
        return False
    dx, dy = x2 - x1, y2 - y1
    return abs(dx * y1 - dy * x1) <= half_length * abs(dy) + half_width * abs(dx)


@kernel
def is_inside(edges: FloatArray, x: float, y: float) -> bool:
    """Whether a ray from a point to the east crosses the edges an odd number of times."""
    inside = False
    for i in range(len(edges)):
        x1, y1, x2, y2 = edges[i]
        if (y1 > y) != (y2 > y) and x < x1 + (x2 - x1) * (y - y1) / (y2 - y1):
            inside = not inside
    return inside
