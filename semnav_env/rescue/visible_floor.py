"""The floor that the camera of a robot can see at all, from the poses that its body can reach."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from semnav_env.rescue.settings import PersonDetectorSettings
from semnav_env.robots import RobotSpec
from semnav_env.world.dynamics.victim_sight import ALL_AROUND
from semnav_env.world.grid.cells import Grid
from semnav_env.world.grid.poses import REACHED, Reach
from semnav_env.world.grid.rays import Cells, mark_in_view
from semnav_env.world.lidar.lidar import Lidar
from semnav_env.world.maps.cell_budget import spacing_within_budget
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.reach import reach

CELL = 0.1
"""Distance between the cells of the floor, metres."""

STANDPOINT = 0.2
"""Distance between the places from which it is asked what can be seen, metres."""

HEADINGS = 24
"""Number of headings of the body there, over a whole turn: its front sees, not its back."""

BORDER = 32
"""Cells around the plan, 1.6 m: the body may stand right inside the outer walls."""


def floor_grid(plan: FloorPlan) -> Grid:
    """The cells over the whole of a plan.

    Raises:
        FloorPlanError: the plan is too large.
    """
    west, south, east, north = plan.boundary.bounds
    spacing_within_budget(plan, CELL, CELL, "to tell which floor a robot sees")
    return Grid.over((west, south), (east, north), CELL)


def visible_floor(
    plan: FloorPlan, robot: RobotSpec, detector: PersonDetectorSettings, grid: Grid
) -> Cells:
    """The cells that the detector on its mount can see, shape (rows, columns).

    The body turns and drives from the middle of the largest corridor to wherever it fits, and at
    each pose the detector sees what is in its field of view. Places of the detector are tried
    0.2 m apart, headings 15 degrees; a pose stands for the one reached nearest to it, which is
    within half a cell of `reach`, 2.5 cm.

    Args:
        plan: with everything that stands and lies in it.
        robot: the body; the detector is on the mount of its lidar.
        detector: its range and field of view.
        grid: cells of the floor.
    """
    size = robot.length, robot.width
    area = reach(plan, *size, headings=HEADINGS, turn=math.tau, border=BORDER)
    around = Lidar(plan, replace(ALL_AROUND, range_max=detector.range_max))
    rays, seen = ALL_AROUND.directions, np.zeros(grid.shape, np.uint8)
    bearings = ALL_AROUND.angles
    looks = detector_headings(area, robot)
    off = bearings[None, :] - (area.angles + robot.lidar_mount[2])[:, None]
    in_view = np.abs(np.angle(np.exp(1j * off))) <= detector.field_of_view / 2 + 1e-9
    west, south, spacing = area.grid.frame
    step = round(STANDPOINT / spacing)
    for row, column in (step * np.argwhere(looks[::step, ::step].any(axis=2))).tolist():
        eye = west + spacing * column, south + spacing * row, 0.0
        ranges, shown = around.exact_ranges(eye), in_view[looks[row, column]].any(axis=0)
        mark_in_view(seen, *grid.frame, eye, rays[shown], ranges[shown], detector.range_max)
    return seen


def detector_headings(area: Reach, robot: RobotSpec) -> np.ndarray:
    """In which headings of the body its detector can be in a cell, shape (rows, columns, headings).

    Args:
        area: that the middle of the body reaches, with headings over a whole turn.
        robot: the body.
    """
    x, y, _ = robot.lidar_mount
    c, s = np.cos(area.angles), np.sin(area.angles)
    columns = np.rint((c * x - s * y) / area.grid.spacing).astype(int)
    rows = np.rint((s * x + c * y) / area.grid.spacing).astype(int)
    looks = np.zeros(area.states.shape, np.bool_)
    for k, (row, column) in enumerate(zip(rows.tolist(), columns.tolist(), strict=True)):
        looks[:, :, k] = np.roll(area.states[:, :, k] == REACHED, (row, column), axis=(0, 1))
    return looks
