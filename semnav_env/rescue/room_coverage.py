"""The seen share of each room, for which the floor plan is needed."""

from __future__ import annotations

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from semnav_env.rescue.settings import PersonDetectorSettings
from semnav_env.rescue.visible_floor import CELL, floor_grid, visible_floor
from semnav_env.robots import RobotSpec
from semnav_env.world.grid.rays import Cells, mark_in_view
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import FloatArray, Pose


class RoomCoverage:
    """The floor of the rooms and open areas of a plan, cell by cell.

    A cell is floor if its middle lies in a room and in no piece of furniture and no person. Of the
    floor only what the detector on its mount can see at all counts: from some pose that the body
    can reach (`visible_floor`). A pocket behind a desk that no look reaches is not held against it.

    Args:
        plan: the truth.
        robot: the body.
        detector: its range and field of view.

    Attributes:
        names: of the rooms and open areas.
        grid: the cells.
        floor: index of the room of each cell of floor, else the number of rooms, shape
            (rows, columns).
        shares: seen share of the visible floor of each room, shape (n,).
    """

    def __init__(self, plan: FloorPlan, robot: RobotSpec, detector: PersonDetectorSettings) -> None:
        regions = (*plan.rooms, *plan.areas)
        self.names = tuple(region.name for region in regions)
        self.grid = floor_grid(plan)
        self._seen = np.zeros(self.grid.shape, np.uint8)
        places = self.grid.x, self.grid.y[:, None]
        self.floor = np.full(self.grid.shape, len(regions))
        for index, region in enumerate(regions):
            self.floor[shapely.contains_xy(region.polygon, *places)] = index
        for piece in plan.furniture.geometries:
            self.floor[shapely.contains_xy(piece, *places)] = len(regions)
        solid = [shapely.contains_xy(piece, *places) for piece in plan.furniture.geometries]
        self._bare = ~np.any(solid, axis=0) if solid else np.ones(self.grid.shape, np.bool_)
        self._can_be_seen = visible_floor(plan, robot, detector, self.grid)
        self._totals = self._counts(self._can_be_seen)
        self.shares = _shares(self._totals * 0.0, self._totals)

    def look(self, eye: Pose, rays: FloatArray, ranges: FloatArray, range_max: float) -> float:
        """Add a view of the detector; returns the area that was seen for the first time, m^2.

        Args:
            eye: true pose of the detector, world frame.
            rays: unit vectors, detector frame, shape (n, 2).
            ranges: lengths of the rays, metres, shape (n,).
            range_max: of the detector, metres.
        """
        before = self.shares
        mark_in_view(self._seen, *self.grid.frame, eye, rays, ranges, range_max)
        self.shares = _shares(self._counts(self._seen & self._can_be_seen), self._totals)
        return float((self.shares - before) @ self._totals) * CELL**2

    def shares_of(self, cells: Cells) -> FloatArray:
        """Seen share of some cells of each room, 1 for a room without such cells, shape (n,)."""
        return _shares(self._counts(self._seen & cells), self._counts(cells))

    def share_in(self, region: BaseGeometry) -> float:
        """Seen share of the visible floor of any region, 1 for one without such floor."""
        inside = shapely.contains_xy(region, self.grid.x, self.grid.y[:, None]) & self._bare
        there = inside & (self._can_be_seen > 0)
        return float(np.mean(self._seen[there] > 0)) if there.any() else 1.0

    @property
    def seen_cells(self) -> FloatArray:
        """The middles of the seen cells of rooms, world frame, shape (n, 2)."""
        seen = self._seen & self._can_be_seen & (self.floor < len(self.names))
        return self.grid.points(np.argwhere(seen))

    @property
    def floor_shares(self) -> FloatArray:
        """Seen share of the whole floor of each room, hidden floor included, shape (n,)."""
        return self.shares_of(np.ones_like(self._seen))

    def _counts(self, cells: Cells) -> FloatArray:
        """Number of some cells of floor in each room."""
        found = np.bincount(self.floor[cells > 0], minlength=len(self.names) + 1)
        return found[: len(self.names)].astype(np.float64)


def _shares(seen: FloatArray, there: FloatArray) -> FloatArray:
    """Seen share of cells, 1 where there are no cells."""
    return np.where(there > 0, seen / np.maximum(there, 1.0), 1.0)
