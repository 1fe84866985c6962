"""One budget for every grid and table whose size depends on the size of a floor plan."""

from __future__ import annotations

import math

from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.rules import FloorPlanError

MAX_CELLS = 6_000_000
"""Largest number of cells of a grid over a floor plan, of entries of a table, and of points on its
walls: eight times those of a floor of 90 m x 80 m, and at up to 50 bytes each some 300 MB."""


def spacing_within_budget(plan: FloorPlan, usual: float, coarsest: float, purpose: str) -> float:
    """Spacing of a grid over a plan, metres: the usual one where the budget allows it.

    Args:
        plan: its boundary is covered.
        usual: spacing that is wanted, metres.
        coarsest: largest spacing of use, metres; with a larger one robots miss doors.
        purpose: what the grid is for, in words that follow "it is too large".

    Raises:
        FloorPlanError: the plan is too large even for the coarsest grid.
    """
    west, south, east, north = plan.boundary.bounds
    width, height = east - west, north - south
    needed = max(usual, math.sqrt(width * height / MAX_CELLS))
    if needed > coarsest:
        raise FloorPlanError(
            f"{plan.name} spans {width:,.0f} m x {height:,.0f} m; it is too large {purpose}: give "
            f"a boundary of at most {MAX_CELLS * coarsest**2:,.0f} m2, and coordinates in metres"
        )
    return needed


def check_cells(count: float, what: str) -> None:
    """Refuse more cells, entries or points than the budget allows.

    Args:
        count: how many there would be.
        what: their kind and origin, for the message.

    Raises:
        FloorPlanError: names the number, and the budget.
    """
    if count > MAX_CELLS:
        raise FloorPlanError(
            f"{what} take {count:,.0f} cells; at most {MAX_CELLS:,} are made: draw less or make it "
            "smaller, with coordinates in metres"
        )
