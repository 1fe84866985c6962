"""Furniture that is not where the plan has it."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from shapely import Polygon

from semnav_env.robots import SPOT, WHEELCHAIR
from semnav_env.world.dynamics import Dynamics, PlanSource
from semnav_env.world.dynamics.furniture import FurnitureMover, free_ways
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.floor_plan import FloorPlan, Material
from semnav_env.world.maps.geodesic import Geodesic
from semnav_env.world.maps.rules import check_plan

MUCH = Dynamics(moved_furniture=1.0, added_boxes=15)
seeds = pytest.mark.parametrize("seed", range(3))


def rearranged(seed: int, pose: tuple[float, float, float] | None = None) -> FloorPlan:
    stage = PlanSource("office_cross", MUCH, WHEELCHAIR)
    return stage.plan(pose=pose, rng=np.random.default_rng(seed))


def pieces(plan: FloorPlan) -> list[Polygon]:
    return [Polygon(s.points) for s in plan.surfaces if s.material is Material.FURNITURE]


@seeds
def test_a_rearranged_plan_is_valid_and_keeps_walls_and_doors(seed: int) -> None:
    plan, drawn = rearranged(seed), load_floor_plan("office_cross")
    check_plan(plan)
    assert plan.doors == drawn.doors
    for material in (Material.WALL, Material.GLASS, Material.LEAF):
        assert [s for s in plan.surfaces if s.material is material] == [
            s for s in drawn.surfaces if s.material is material
        ]


@seeds
def test_pieces_move_and_come_but_never_overlap(seed: int) -> None:
    before, after = pieces(load_floor_plan("office_cross")), pieces(rearranged(seed))
    assert len(before) < len(after) <= len(before) + MUCH.added_boxes
    assert any(not old.equals(new) for old, new in zip(before, after, strict=False))
    for i, one in enumerate(after):
        assert not any(one.intersects(other) for other in after[:i])


@seeds
def test_every_door_that_could_be_reached_still_can(seed: int) -> None:
    drawn, plan = load_floor_plan("office_cross"), rearranged(seed)
    half = WHEELCHAIR.width / 2
    hall = (15.0, 9.1)
    before, after = (Geodesic(p, clearance=half).to(hall) for p in (drawn, plan))
    for door in drawn.doors:
        if math.isfinite(before.length(door.midpoint)):
            assert math.isfinite(after.length(door.midpoint)), door.name


def test_nothing_is_put_where_the_robot_is_asked_to_start() -> None:
    for seed in range(5):
        plan = rearranged(seed, (15.0, 9.1, 0.0))
        assert all(
            piece.distance(Polygon([(15, 9), (15, 9.2), (15.1, 9.1)])) > 1.0
            for piece in pieces(plan)
        )


def test_furniture_of_a_seed_is_the_same_and_stays_without_one() -> None:
    assert rearranged(1).surfaces == rearranged(1).surfaces != rearranged(2).surfaces
    drawn = load_floor_plan("office_cross")
    assert PlanSource(drawn, MUCH, SPOT).plan() is drawn


def test_ways_around_furniture_are_those_of_the_whole_plan() -> None:
    """What cannot move is worked out once, and the pieces are cut out of it."""
    plan = load_floor_plan("office:small:3")
    mover = FurnitureMover(plan, WHEELCHAIR, None)
    for half, ways in zip(mover._half_lanes, mover._ways_of(plan), strict=True):
        whole = shapely.union_all(free_ways(plan, half))
        assert shapely.union_all(ways).symmetric_difference(whole).area < 1e-6
        assert len(ways) == len(free_ways(plan, half))
