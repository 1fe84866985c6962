"""Places that a rectangular body can reach in a floor plan, turning where it must."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.world.grid.cells import Grid
from semnav_env.world.grid.occupancy import mark_segments
from semnav_env.world.grid.poses import Reach, reach_in_grid
from semnav_env.world.maps.cell_budget import spacing_within_budget
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import Point

REACH_SPACING = 0.05
"""Distance between the points of the grid, metres."""

HEADING_COUNT = 12
"""Number of headings over half a turn: a rectangle looks the same from behind."""

BORDER_CELLS = 4
"""Cells around the plan that nothing reaches."""

COARSEST_SPACING = 0.1
"""Largest spacing of the grid, metres: a coarser one shows no body the way through a door."""


def reach(
    plan: FloorPlan,
    length: float,
    width: float,
    spacing: float = REACH_SPACING,
    headings: int = HEADING_COUNT,
    start: Point | None = None,
    turn: float = math.pi,
    border: int = BORDER_CELLS,
) -> Reach:
    """The cells that a rectangular body reaches from the middle of the largest corridor.

    In a plan without corridors it starts in the middle of the boundary.

    Args:
        plan: the floor plan.
        length: length of the body, metres.
        width: width of the body, metres.
        spacing: spacing of the grid, metres; a large plan gets a coarser one.
        headings: number of headings of the body, evenly spread over `turn`.
        start: where the body is instead, (x, y) in metres.
        turn: half a turn, or a whole one where it matters which end is the front, radians. At the
            start the body may have any heading that is free.
        border: cells of the grid around the plan. No place counts that is nearer to the rim of the
            grid than the body's corners reach, so a body right inside an outer wall needs more.

    Raises:
        FloorPlanError: the plan is too large for a grid.
    """
    west, south, east, north = plan.boundary.bounds
    spacing = spacing_within_budget(
        plan, spacing, max(spacing, COARSEST_SPACING), "to tell which parts a robot reaches"
    )
    grid = Grid.over((west, south), (east, north), spacing, border, border)
    blocked = np.zeros(grid.shape, np.bool_)
    mark_segments(blocked, plan.segments, *grid.frame)
    cell = grid.cell(start or _start(plan))
    return reach_in_grid(blocked, grid, (length, width), headings, cell, turn)


def _start(plan: FloorPlan) -> Point:
    corridors = [region.polygon for region in plan.corridors]
    area = max(corridors, key=lambda polygon: polygon.area, default=plan.boundary)
    point = area.representative_point()
    return point.x, point.y
