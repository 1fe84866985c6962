"""How much of each room has been looked at, as only the floor plan tells."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import shapely

from semnav_env.features.frames import FloatArray, Pose
from semnav_env.features.lidar_spec import LidarSpec
from semnav_env.lidar.lidar import Lidar
from semnav_env.maps.floor_plan import FloorPlan
from semnav_env.maps.reach import reach
from semnav_env.rescue.field_of_view import mark_in_view
from semnav_env.robots import RobotSpec

CELL = 0.1
"""Distance between the cells of the floor, metres."""

STANDPOINT = 0.2
"""Distance between the places from which it is asked what can be seen, metres."""

ALL_AROUND = LidarSpec("all around", 720, -math.pi, math.radians(0.5), range_min=0.0)
"""Rays of a look all around."""


class RoomCoverage:
    """The floor of the rooms and open areas of a plan, cell by cell.

    A cell is floor if its middle lies in a room and in no piece of furniture and no person. Of the
    floor only what the robot can see at all counts: from some place where it can come to stand,
    looking all around. A pocket behind a desk that no look reaches is not held against it.

    Args:
        plan: the truth.
        robot: the body.
        range_max: of the detector, metres.

    Attributes:
        names: of the rooms and open areas.
        shares: of the floor of each that can be seen, the share that has been, shape (n,).
        west: x of the middle of the first column, metres.
        south: y of the middle of the first row, metres.
    """

    def __init__(self, plan: FloorPlan, robot: RobotSpec, range_max: float) -> None:
        regions = (*plan.rooms, *plan.areas)
        self.names = tuple(region.name for region in regions)
        self.west, self.south, east, north = plan.boundary.bounds
        columns = math.ceil((east - self.west) / CELL) + 1
        rows = math.ceil((north - self.south) / CELL) + 1
        self._seen = np.zeros((rows, columns), np.uint8)
        x = self.west + CELL * np.arange(columns)
        y = self.south + CELL * np.arange(rows)
        grid = np.meshgrid(x, y)
        self._room = np.full((rows, columns), len(regions))
        for index, region in enumerate(regions):
            self._room[shapely.contains_xy(region.polygon, *grid)] = index
        for piece in plan.furniture.geometries:
            self._room[shapely.contains_xy(piece, *grid)] = len(regions)
        self._floor = self._counts(np.ones_like(self._seen))
        can_see = self._visible(plan, robot, range_max)
        self._room[can_see == 0] = len(regions)
        self._totals = self._counts(can_see)
        self.shares: FloatArray = np.zeros(len(regions))

    def look(self, eye: Pose, rays: FloatArray, ranges: FloatArray, range_max: float) -> float:
        """Take a look into account; returns the area that was seen for the first time, m^2.

        Args:
            eye: true pose of the detector, world frame.
            rays: unit vectors, detector frame, shape (n, 2).
            ranges: where they end, metres, shape (n,).
            range_max: of the detector, metres.
        """
        before = self.shares
        grid = self.west, self.south, CELL
        mark_in_view(self._seen, *grid, eye, rays, ranges, range_max)
        self.shares = self._counts(self._seen) / np.maximum(self._totals, 1)
        return float((self.shares - before) @ self._totals) * CELL**2

    @property
    def seen_cells(self) -> FloatArray:
        """The middles of the cells of rooms that were looked at, world frame, shape (n, 2)."""
        row, column = np.nonzero(self._seen & (self._room < len(self.names)))
        places = np.stack((self.west + CELL * column, self.south + CELL * row), axis=1)
        return places.astype(np.float64)

    @property
    def floor_shares(self) -> FloatArray:
        """Of all floor of each room, hidden or not, the share that has been seen, shape (n,)."""
        shares = self._counts(self._seen) / np.maximum(self._floor, 1.0)
        return shares.astype(np.float64)

    def _visible(self, plan: FloorPlan, robot: RobotSpec, range_max: float) -> np.ndarray:
        """The cells that can be seen from where the robot can come to stand."""
        cells, area = np.zeros_like(self._seen), reach(plan, robot.length, robot.width)
        around = Lidar(plan, replace(ALL_AROUND, range_max=range_max))
        step = round(STANDPOINT / area.spacing)
        for row, column in (step * np.argwhere(area.cells[::step, ::step])).tolist():
            x, y = area.origin[0] + area.spacing * column, area.origin[1] + area.spacing * row
            eye = x, y, 0.0
            ranges, rays = around.exact_ranges(eye), ALL_AROUND.directions
            mark_in_view(cells, self.west, self.south, CELL, eye, rays, ranges, range_max)
        return cells

    def _counts(self, cells: np.ndarray) -> FloatArray:
        """How many of some cells lie in each room."""
        found = np.bincount(self._room[cells > 0], minlength=len(self.names) + 1)
        return found[: len(self.names)].astype(np.float64)
