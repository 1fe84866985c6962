"""What floor the detector on its mount can see at all, from poses that the body reaches."""

from __future__ import annotations

import math

import numpy as np
import shapely

from semnav_env.rescue import PersonDetectorSettings
from semnav_env.rescue.person_detector import view_spec
from semnav_env.rescue.room_coverage import RoomCoverage
from semnav_env.rescue.visible_floor import floor_grid, visible_floor
from semnav_env.robots import SPOT
from semnav_env.world.grid.cells import Grid
from semnav_env.world.grid.poses import REACHED
from semnav_env.world.grid.rays import Cells, mark_in_view
from semnav_env.world.lidar.lidar import Lidar
from semnav_env.world.maps import FloorPlan, PlanDoor, Region, Surface, generate_office
from semnav_env.world.maps.reach import reach
from semnav_features.frames import compose
from studies.search.all_around import seen_all_around

DETECTOR = PersonDetectorSettings()


def line(*points: tuple[float, float]) -> Surface:
    return Surface(points)


def passage_with_a_slit() -> FloorPlan:
    """A passage of 8 m by 0.8 m, in which SPOT cannot turn, and a slit 0.2 m wide beside it."""
    west, east, deep = 3.9, 4.1, 3.0
    outline = shapely.box(0.0, 0.0, 8.0, 0.8).union(shapely.box(west, 0.8, east, deep))
    walls = line(*outline.exterior.coords)
    corridor = Region("passage", shapely.box(0.0, 0.0, 8.0, 0.8))
    return FloorPlan("slit", (walls,), (), (), (corridor,), (), shapely.box(-2.0, -2.0, 10.0, 5.0))


def flag(cells: Cells, grid: Grid, x: float, y: float) -> bool:
    return bool(cells[grid.cell((x, y))])


def test_what_only_a_look_to_the_side_shows_cannot_be_seen_where_the_body_cannot_turn() -> None:
    plan = passage_with_a_slit()
    grid = floor_grid(plan)
    seen = visible_floor(plan, SPOT, DETECTOR, grid)
    around = seen_all_around(plan, SPOT, DETECTOR, grid)
    assert flag(seen, grid, 7.5, 0.4)
    assert flag(seen, grid, 0.5, 0.4)
    assert flag(around, grid, 4.0, 2.8)
    assert not flag(seen, grid, 4.0, 2.8)


def test_what_is_seen_from_a_pose_that_is_reached_counts() -> None:
    """From poses between those that are tried, all but rims and slivers."""
    plan = generate_office(3, "house")
    grid = floor_grid(plan)
    seen, rng = visible_floor(plan, SPOT, DETECTOR, grid), np.random.default_rng(0)
    area = reach(plan, SPOT.length, SPOT.width, headings=36, turn=math.tau)
    poses = np.argwhere(area.states == REACHED)
    spec = view_spec(DETECTOR)
    camera, looked = Lidar(plan, spec, SPOT.lidar_mount), np.zeros(grid.shape, np.uint8)
    for row, column, k in poses[rng.integers(len(poses), size=300)].tolist():
        pose = area.grid.x[column], area.grid.y[row], float(area.angles[k])
        eye, ranges = compose(pose, SPOT.lidar_mount), camera.exact_ranges(pose)
        mark_in_view(looked, *grid.frame, eye, spec.directions, ranges, DETECTOR.range_max)
    assert looked.sum() > 5000
    assert np.count_nonzero(looked & ~seen & 1) < 0.02 * looked.sum()


def test_a_room_that_no_look_reaches_asks_for_none() -> None:
    outline = shapely.box(0.0, 0.0, 8.0, 6.0)
    walls = line(*outline.exterior.coords), line((0.0, 3.0), (8.0, 3.0))
    rooms = Region("open", shapely.box(0, 0, 8, 3)), Region("shut", shapely.box(0, 3, 8, 6))
    door = PlanDoor("door", (3.0, 3.0), (4.0, 3.0), open=False)
    corridor = (Region("hall", shapely.box(0, 0, 8, 3)),)
    plan = FloorPlan("shut", walls, (door,), rooms, corridor, (), outline)
    coverage = RoomCoverage(plan, SPOT, DETECTOR)
    assert coverage.shares.tolist() == [0.0, 1.0]
    assert coverage.floor_shares.tolist() == [0.0, 0.0]
