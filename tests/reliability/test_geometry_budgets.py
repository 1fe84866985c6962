"""Geometry budgets: no small file makes a grid or a table of gigabytes, whatever it draws.

Each use of each plan runs in a child process that may take a gigabyte of memory more, and no more.
"""

from __future__ import annotations

import resource
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from semnav_env.robots import WHEELCHAIR
from semnav_env.world.grid.occupancy import clear_near
from semnav_env.world.lidar import Lidar
from semnav_env.world.lidar.culling import CELL_SIZE, Culling
from semnav_env.world.maps import (
    FloorPlan,
    Surface,
    bundled_names,
    load_floor_plan,
    save_floor_plan,
)
from semnav_env.world.maps.cell_budget import MAX_CELLS
from semnav_env.world.maps.geodesic import COARSEST_SPACING, GRID_SPACING, Geodesic
from semnav_env.world.maps.reach import REACH_SPACING, reach
from semnav_features.frames import FloatArray
from tests.reliability.children import MEMORY, Outcome, in_child
from tests.reliability.vast_plans import FAR, PLANS, USES, crossed, large, search, vast

SECONDS = 60.0
"""Processor time for one use of one plan, against a hang."""


def limited(work: Callable[[], Any]) -> Outcome:
    """How something ends that may take a gigabyte of memory more than is taken already."""

    def within_limit() -> None:
        pages = int(Path("/proc/self/statm").read_text().split()[0])
        most = pages * resource.getpagesize() + MEMORY
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
        work()

    return in_child(within_limit, seconds=SECONDS)


@pytest.mark.slow
@pytest.mark.parametrize(
    "use", [use for use in USES if use is not search], ids=lambda use: use.__name__
)
@pytest.mark.parametrize("make", PLANS, ids=lambda make: make.__name__)
def test_no_plan_takes_a_gigabyte(
    tmp_path: Path,
    make: Callable[[], FloorPlan],
    use: Callable[[FloorPlan, Path], Any],
) -> None:
    """But a search, which takes minutes to find out what can be seen in a large plan."""
    plan = make()
    outcome = limited(lambda: use(plan, tmp_path))
    assert not outcome.fault, outcome


@pytest.mark.parametrize("use", USES, ids=lambda use: use.__name__)
def test_a_kilobyte_of_plan_takes_no_gigabyte(
    tmp_path: Path, use: Callable[[FloorPlan, Path], Any]
) -> None:
    save_floor_plan(vast(), tmp_path / "vast.geojson")
    assert (tmp_path / "vast.geojson").stat().st_size < 2500
    plan = load_floor_plan(tmp_path / "vast.geojson")
    outcome = limited(lambda: use(plan, tmp_path))
    assert not outcome.fault, outcome


def test_a_refusal_names_the_extent_and_what_would_be_right() -> None:
    with pytest.raises(ValueError, match=r"vast spans 2,000 m x 2,000 m.*at most 240,000 m2"):
        Geodesic(vast())
    with pytest.raises(ValueError, match=r"vast spans 2,000 m x 2,000 m.*at most 60,000 m2"):
        reach(vast(), WHEELCHAIR.length, WHEELCHAIR.width)


@pytest.mark.parametrize("name", [*bundled_names(), "office:large:3"])
def test_ordinary_plans_keep_their_grids(name: str) -> None:
    plan = load_floor_plan(name)
    assert Geodesic(plan).grid.spacing == GRID_SPACING
    assert reach(plan, WHEELCHAIR.length, WHEELCHAIR.width).grid.spacing == REACH_SPACING


def test_a_coarser_grid_still_leads_through_doors() -> None:
    geodesic = Geodesic(large())
    assert GRID_SPACING < geodesic.grid.spacing < COARSEST_SPACING
    assert geodesic.free.size < 1.01 * MAX_CELLS
    fine = Geodesic(crossed(20.0, 20.0, "small")).to((2.5, -3.0)).length((0.0, 0.0))
    assert geodesic.to((2.5, -3.0)).length((0.0, 0.0)) == pytest.approx(fine, abs=0.4)


def test_a_grid_of_any_spacing_within_the_budget_gives_nearly_the_same_ways(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    plan = crossed(20.0, 20.0, "small")
    fine = Geodesic(plan).to((2.5, -3.0)).length((-9.0, 0.0))
    monkeypatch.setattr("semnav_env.world.maps.cell_budget.MAX_CELLS", 50_000)
    coarse = Geodesic(plan)
    assert coarse.grid.spacing > 1.7 * GRID_SPACING
    assert coarse.to((2.5, -3.0)).length((-9.0, 0.0)) == pytest.approx(fine, abs=0.5)


def test_larger_cells_of_shorter_lists_change_no_range(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(5)
    ends = rng.uniform(-40.0, 40.0, (800, 2))
    segments = np.hstack((ends, ends + rng.normal(0.0, 2.0, (800, 2))))
    plan = replace(crossed(50.0, 50.0, "crowd"), surfaces=surfaces_of(segments))
    poses = [(*place, 0.3) for place in rng.uniform(-45.0, 45.0, (40, 2)).tolist()]
    before = [Lidar(plan, FAR).exact_ranges(pose) for pose in poses]
    monkeypatch.setattr("semnav_env.world.lidar.culling.MAX_CELLS", 20_000)
    shorter = Culling.of(plan.segments, FAR.range_max)
    assert shorter.ends.shape[1] <= 20_000
    assert shorter.grid["cell"][0] > CELL_SIZE
    same = replace(plan, name="the same")
    after = [Lidar(same, FAR).exact_ranges(pose) for pose in poses]
    assert np.array_equal(before, after)


def test_the_lists_of_a_far_lidar_stay_within_the_budget() -> None:
    rng = np.random.default_rng(1)
    ends = rng.uniform(0.0, 100.0, (10_000, 2))
    culling = Culling.of(np.hstack((ends, ends + 1.0)), 1000.0)
    assert 20_000 < culling.ends.shape[1] <= MAX_CELLS


def test_cells_near_a_slanted_wall_are_those_that_geometry_tells() -> None:
    rng = np.random.default_rng(2)
    segments = rng.uniform(-1.0, 9.0, (60, 4))
    segments[:5, 2:] = segments[:5, :2]  # of no length
    segments[5:15, 3] = segments[5:15, 1]  # level
    for segment in segments:
        free = np.ones((81, 81), bool)
        clear_near(free, segment[None, :], 0.0, 0.0, 0.1, 0.25)
        x, y = np.meshgrid(0.1 * np.arange(81), 0.1 * np.arange(81))
        line = shapely.linestrings(segment.reshape(2, 2))
        away = shapely.distance(line, shapely.points(x, y))
        assert (free == (away >= 0.25))[abs(away - 0.25) > 1e-9].all()


def surfaces_of(segments: FloatArray) -> tuple[Surface, ...]:
    """Walls that are these segments."""
    return tuple(Surface(((a, b), (c, d))) for a, b, c, d in segments.round(3).tolist())
