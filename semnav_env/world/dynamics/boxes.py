"""Boxes that are put down by hand."""

from __future__ import annotations

import numpy as np
from shapely import Polygon

from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import FloatArray, Point
from semnav_features.validation import require

BOX_SIDE = 0.5
"""Length of a side of a box, metres."""

BOX_CLEARANCE = 0.05
"""Space that is left free between a box and whatever else stands or moves, metres."""

SIDES = 4
"""Number of segments of a box."""


def box_corners(middle: Point) -> FloatArray:
    """Corners of a box, counter-clockwise, metres, shape (4, 2)."""
    signs = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    return np.asarray(middle) + 0.5 * BOX_SIDE * signs


def box_sides(middle: Point) -> FloatArray:
    """Sides of a box as x1, y1, x2, y2, metres, shape (4, 4)."""
    corners = box_corners(middle)
    return np.hstack((corners, np.roll(corners, -1, axis=0)))


def check_box_place(plan: FloorPlan, middle: Point) -> None:
    """Refuse a place where a box would stick in a wall or in furniture.

    Args:
        plan: the plan.
        middle: of the box, metres.

    Raises:
        ValueError: the box would not stand on free floor; says why.
    """
    box = Polygon(box_corners(middle))
    require(plan.boundary.covers(box), "box", middle, "inside the floor plan")
    clear = len(plan.solids.query(box, predicate="intersects")) == 0
    clear = clear and len(plan.furniture.query(box, predicate="covered_by")) == 0
    require(clear, "box", middle, f"where {BOX_SIDE} m square touch no wall and no furniture")
