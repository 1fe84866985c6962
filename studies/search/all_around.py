"""What counted as floor that can be seen before the mount and the field of view were asked for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from semnav_env.rescue.settings import PersonDetectorSettings
from semnav_env.rescue.visible_floor import STANDPOINT
from semnav_env.robots import RobotSpec
from semnav_env.world.dynamics.victim_sight import ALL_AROUND
from semnav_env.world.grid.cells import Grid
from semnav_env.world.grid.rays import Cells, mark_in_view
from semnav_env.world.lidar.lidar import Lidar
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.reach import reach


def seen_all_around(
    plan: FloorPlan, robot: RobotSpec, detector: PersonDetectorSettings, grid: Grid
) -> Cells:
    """The cells that a detector in the middle of the body could see, looking all around.

    The arguments are those of `visible_floor`. A detector that is not in the middle cannot see
    all of them, and sees some others.
    """
    area = reach(plan, robot.length, robot.width)
    seen = np.zeros(grid.shape, np.uint8)
    around = Lidar(plan, replace(ALL_AROUND, range_max=detector.range_max))
    west, south, spacing = area.grid.frame
    step, rays = round(STANDPOINT / spacing), ALL_AROUND.directions
    for row, column in (step * np.argwhere(area.cells[::step, ::step])).tolist():
        eye = west + spacing * column, south + spacing * row, 0.0
        ranges = around.exact_ranges(eye)
        mark_in_view(seen, *grid.frame, eye, rays, ranges, detector.range_max)
    return seen
