"""Shortest ways go around what is solid."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.floor_plan import FloorPlan, Surface
from semnav_env.world.maps.geodesic import CLEARANCE, GRID_SPACING, Geodesic

PLAN = load_floor_plan("office_cross")
GEODESIC = Geodesic(PLAN)
CORRIDOR = st.tuples(st.floats(0.5, 29.5), st.floats(8.5, 9.5))


@given(CORRIDOR, CORRIDOR)
@settings(max_examples=30)
def test_geodesics_are_symmetric_and_no_shorter_than_lines(
    a: tuple[float, float], b: tuple[float, float]
) -> None:
    there, back = GEODESIC.to(b).length(a), GEODESIC.to(a).length(b)
    assert there >= math.dist(a, b) - 2 * GRID_SPACING
    assert there == pytest.approx(back, abs=4 * GRID_SPACING)


def test_the_way_into_a_room_leads_through_its_door() -> None:
    door = PLAN.door("west_south_2")
    way = shapely.LineString(GEODESIC.to((6.0, 6.0)).way((1.5, 9.0)))
    assert way.intersects(shapely.LineString([door.start, door.end]))


def test_ways_keep_their_distance_from_everything_solid() -> None:
    way = GEODESIC.to((25.0, 19.0)).way((1.5, 9.0))
    solid = shapely.multilinestrings(PLAN.segments.reshape(-1, 2, 2))
    assert shapely.distance(solid, shapely.points(way)).min() >= CLEARANCE - 1e-9
    steps = np.hypot(*np.diff(way, axis=0).T)
    assert steps.max() <= 2 * GRID_SPACING


def test_a_closed_door_is_no_way_in() -> None:
    assert GEODESIC.to((23.0, 6.0)).length((23.0, 9.0)) == math.inf


COORDINATE = st.integers(-2000, 2000).map(lambda millimetres: millimetres / 1000.0)


@given(st.lists(st.tuples(*[COORDINATE] * 4), min_size=1, max_size=6))
@settings(max_examples=50)
def test_a_cell_is_free_where_everything_solid_is_far_enough(
    ends: list[tuple[float, float, float, float]],
) -> None:
    walls = tuple(Surface(((a, b), (c, d))) for a, b, c, d in ends)
    plan = FloorPlan("walls", walls, (), (), (), (), shapely.box(-3.0, -3.0, 3.0, 3.0))
    solid = shapely.multilinestrings(plan.segments.reshape(-1, 2, 2))
    rows, columns = np.indices((61, 61))
    places = shapely.points(-3.0 + GRID_SPACING * columns, -3.0 + GRID_SPACING * rows)
    distance = shapely.distance(solid, places)
    inside = shapely.contains(plan.boundary, places)
    clear = np.abs(distance - CLEARANCE) > 1e-6
    assert (Geodesic(plan).free == (inside & (distance > CLEARANCE)))[clear].all()


def test_geodesics_of_one_plan_are_shared_and_their_fields_kept() -> None:
    shared = PLAN.derived(Geodesic)
    assert PLAN.derived(Geodesic) is shared
    assert shared.to((1.0, 9.0)).distances is shared.to((1.0, 9.0)).distances
    copied = pickle.loads(pickle.dumps(shared))
    assert np.array_equal(copied.to((1.0, 9.0)).distances, shared.to((1.0, 9.0)).distances)
    assert len(pickle.dumps(PLAN)) < 100_000


@given(x=st.floats(-3.0, 33.0), y=st.floats(-3.0, 27.0))
def test_the_nearest_free_cell_is_found(x: float, y: float) -> None:
    away = np.hypot(*(GEODESIC.grid.points(np.argwhere(GEODESIC.free)) - (x, y)).T)
    found = GEODESIC._cell((x, y))
    gap = math.dist((x, y), GEODESIC.grid.points(np.array([found]))[0])
    assert GEODESIC.free[found]
    assert gap == pytest.approx(away.min())
