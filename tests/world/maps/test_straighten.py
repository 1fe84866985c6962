"""Traced outlines that are put back on straight, square walls."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation
from shapely import LineString, MultiLineString, box
from shapely.affinity import rotate, translate
from shapely.geometry.base import BaseGeometry

from semnav_env.world.maps import FloorPlan, Material, PlanDoor, Surface
from semnav_env.world.maps.importers import Tracing, import_map
from semnav_env.world.maps.importers.building_doors import with_walls
from semnav_env.world.maps.importers.directions import dominant_direction
from semnav_env.world.maps.importers.outlines import outlines
from semnav_env.world.maps.importers.redrawing import RedrawnOutline, clashing
from semnav_env.world.maps.importers.runs import PixelRun, Span
from semnav_env.world.maps.importers.straighten import straighten
from semnav_env.world.maps.rules import FloorPlanError
from semnav_features.frames import FloatArray
from semnav_scripts import main as cli
from tests.support.drawn_maps import narrowing, two_rooms, write_map
from tests.support.paths import DATA

SIZE = 300
BOUND = 1.5

degrees = st.floats(-45.0, 45.0)
shifts = st.tuples(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
seeds = st.integers(0, 2**32 - 1)


def raster(shape: BaseGeometry) -> NDArray[np.bool_]:
    """The pixels whose middle lies in a shape, x right and y down."""
    columns, rows = np.meshgrid(np.arange(SIZE) + 0.5, np.arange(SIZE) + 0.5)
    shapely.prepare(shape)
    return np.asarray(shapely.contains_xy(shape, columns, rows))


def rough(solid: NDArray[np.bool_], seed: int, share: float) -> NDArray[np.bool_]:
    """The pixels and a share of those beside them, as a robot maps walls."""
    beside = binary_dilation(solid) & ~solid
    return np.asarray(solid | (beside & (np.random.default_rng(seed).random(solid.shape) < share)))


def away_from_square(rings: list[FloatArray], direction: float) -> tuple[FloatArray, FloatArray]:
    """Of every segment its length and its angle to the nearest of two square directions."""
    steps = np.concatenate([np.diff(ring, axis=0) for ring in rings])
    turns = np.arctan2(steps[:, 1], steps[:, 0]) - direction
    quarter = np.pi / 2
    return np.linalg.norm(steps, axis=1), np.abs((turns + quarter / 2) % quarter - quarter / 2)


def square_share(rings: list[FloatArray], direction: float) -> float:
    """The share of the outlines that runs along one of two square directions."""
    lengths, away = away_from_square(rings, direction)
    return float(lengths[away < 1e-9].sum() / lengths.sum())


@st.composite
def rooms(draw: st.DrawFn) -> BaseGeometry:
    """A house of two rooms with walls 3 to 6 pixels thick, a doorway, and a cabinet."""
    t = draw(st.integers(3, 6))
    east, south = draw(st.integers(200, 240)), draw(st.integers(200, 240))
    middle, door = draw(st.integers(120, 160)), draw(st.integers(100, 160))
    walls = [
        box(70, 70, east, 70 + t),
        box(70, south - t, east, south),
        box(70, 70, 70 + t, south),
        box(east - t, 70, east, south),
        box(middle, 70, middle + t, door),
        box(middle, door + 18, middle + t, south),
        box(85, 90, 85 + draw(st.integers(8, 20)), 100),
    ]
    return shapely.union_all(walls)


def turned(shape: BaseGeometry, angle: float, shift: tuple[float, float]) -> BaseGeometry:
    return translate(rotate(shape, angle, origin=(SIZE / 2, SIZE / 2)), *shift)


@given(rooms(), degrees, shifts)
@settings(max_examples=6, deadline=None)
def test_a_square_house_turned_by_any_angle_comes_back_square(
    house: BaseGeometry, angle: float, shift: tuple[float, float]
) -> None:
    truth = turned(house, angle, shift)
    straight = straighten(outlines(raster(truth), 0.5), BOUND)
    off = (math.degrees(straight.direction) - angle + 45.0) % 90.0 - 45.0
    assert abs(off) < 0.4  # a pixel along the longest wall
    assert square_share(straight.rings, straight.direction) > 0.95
    assert MultiLineString(straight.rings).hausdorff_distance(truth.boundary) < 2.0


@given(rooms(), degrees, shifts, seeds)
@settings(max_examples=5, deadline=None)
def test_a_rough_house_comes_back_square(
    house: BaseGeometry, angle: float, shift: tuple[float, float], seed: int
) -> None:
    rings = outlines(rough(raster(turned(house, angle, shift)), seed, 0.15), 0.5)
    straight = straighten(rings, BOUND)
    assert square_share(straight.rings, straight.direction) > 0.75
    assert sum(map(len, straight.rings)) < 0.4 * sum(map(len, rings))


@given(rooms(), degrees, seeds, st.floats(0.0, 0.5), st.floats(0.2, 3.0))
@settings(max_examples=6, deadline=None)
def test_points_move_within_the_bound_and_outlines_stay_apart(
    house: BaseGeometry, angle: float, seed: int, share: float, bound: float
) -> None:
    """Outlines that were apart stay apart."""
    rings = outlines(rough(raster(turned(house, angle, (0.0, 0.0))), seed, share), 0.5)
    straight = straighten(rings, bound)
    assert len(straight.rings) == len(rings)
    assert straight.moved <= bound
    before, after = [[LineString(ring) for ring in each] for each in (rings, straight.rings)]
    for old, new in zip(before, after, strict=True):
        assert old.hausdorff_distance(new) <= bound + 1e-9
        assert new.is_simple >= old.is_simple
    apart = ~shapely.intersects(np.array(before)[:, None], np.array(before))
    meeting = shapely.intersects(np.array(after)[:, None], np.array(after))
    assert not (apart & meeting).any()


@given(st.floats(8.0, 82.0), st.integers(2, 8), seeds)
@settings(max_examples=6, deadline=None)
def test_an_oblique_wall_stays_as_traced_but_for_its_tips(
    angle: float, thick: int, seed: int
) -> None:
    house = rough(raster(box(20, 20, 280, 26) | box(20, 20, 26, 280)), seed, 0.1)
    wall = raster(rotate(box(80, 150, 250, 150 + thick), angle))
    rings = outlines(house | wall, 0.5)
    straight = straighten(rings, BOUND)
    assert straight.direction == 0.0
    kept = zip(rings, straight.rings, strict=True)
    ((before, after),) = [(old, new) for old, new in kept if old.min() > 60]
    middle = before[np.linalg.norm(before - (165.0, 150.0 + thick / 2), axis=1) < 65.0]
    assert {tuple(point) for point in middle.tolist()} <= {tuple(p) for p in after.tolist()}


@pytest.mark.parametrize("radius", [4.0, 8.0, 15.0, 40.0, 100.0])
def test_a_round_wall_stays_as_traced(radius: float) -> None:
    (ring,) = outlines(raster(shapely.Point(150.3, 149.8).buffer(radius)), 0.5)
    (straight,) = straighten([ring], BOUND).rings
    np.testing.assert_allclose(straight, ring, atol=1e-9)


@given(seeds)
@settings(max_examples=5, deadline=None)
def test_the_walls_on_both_sides_of_a_door_get_one_line(seed: int) -> None:
    walls = box(20, 100, 120, 106) | box(138, 100, 240, 106)
    west, east = straighten(outlines(rough(raster(walls), seed, 0.2), 0.5), BOUND).rings
    faces = [set(ring[1:, 1][np.diff(ring[:, 1]) == 0.0]) for ring in (west, east)]
    assert faces[0] & faces[1]
    assert all(min(abs(y - 100.0), abs(y - 106.0)) < 1.0 for face in faces for y in face)


@pytest.mark.parametrize("thick", [1, 2, 3])
@pytest.mark.parametrize("length", [6, 20, 100])
def test_the_ends_of_thin_walls_are_square(thick: int, length: int) -> None:
    wall = raster(box(100, 100, 100 + length, 100 + thick))
    (ring,) = straighten(outlines(wall, 0.5), BOUND).rings
    assert len(ring) == 5
    assert square_share([ring], 0.0) == 1.0


@given(st.integers(0, 1000), st.integers(1, 1000))
@settings(deadline=None)
def test_of_two_equal_runs_the_first_is_given_up(first: int, further: int) -> None:
    """Of two runs of pixels of one length that meet, one must give way."""
    runs = [PixelRun(k, Span(0, 1, 0, 4.0), -1, 1, 0, True, 0, 4) for k in (first, first + further)]
    square = np.array(((0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)))
    one, other = (
        RedrawnOutline(square + 2.0 * k, [frozenset((run,))] * 4, {run: 0.0}, turned=False)
        for k, run in enumerate(runs)
    )
    assert clashing([one, other]) == clashing([other, one]) == {runs[0]}


@pytest.mark.parametrize("solid", [np.ones((1, 1), bool), np.eye(4, dtype=bool)])
def test_specks_stay_as_they_are(solid: NDArray[np.bool_]) -> None:
    rings = outlines(solid, 0.5)
    straight = straighten(rings, BOUND)
    assert straight.lines == straight.segments == 0
    np.testing.assert_allclose(straight.rings[0], rings[0], atol=1e-9)


def test_a_single_pixel_has_the_direction_of_the_image() -> None:
    assert dominant_direction(outlines(np.ones((1, 1), bool), 0.5)) == pytest.approx(0.0)


def test_straightening_is_reported_and_can_be_switched_off(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    grey = np.where(rough(two_rooms() == 0, 1, 0.2), 0, 254)
    path, out = write_map(tmp_path, grey), tmp_path / "plan.geojson"
    words = ["map", "import", str(path), "--out", str(out)]
    assert cli.main(words) == 0
    assert "segments straightened into" in capsys.readouterr().out
    assert cli.main([*words, "--tracing.straighten", "0"]) == 0
    assert "straightened" not in capsys.readouterr().out
    assert cli.main([*words, "--tracing.straighten", "6"]) == 2
    assert "straighten is 6.0; it must be a number from 0 to 5 pixels" in capsys.readouterr().err


def test_walls_are_straight_however_the_map_is_turned(tmp_path: Path) -> None:
    grey = np.where(rough(two_rooms() == 0, 2, 0.2), 0, 254)
    path = write_map(tmp_path, grey, origin=[1.0, 2.0, 0.5])
    plan, report = import_map(path)
    steps = plan.segments[:, 2:] - plan.segments[:, :2]
    _, away = away_from_square([np.cumsum(steps, axis=0)], 0.5)
    assert np.median(away) < 1e-9
    first = math.degrees(0.5)
    assert f"along {first:.2f} and {first + 90.0:.2f} degrees" in str(report)


def test_jambs_follow_their_straightened_walls() -> None:
    def walls(gap: float, y: float = 0.0) -> FloorPlan:
        sides = Surface(((0.0, y), (2.0, y))), Surface(((2.0 + gap, y), (5.0, y)))
        return FloorPlan("walls", sides, (), (), (), (), box(-1, -1, 6, 1))

    doors = (PlanDoor("door", (2.0, 0.0), (2.9, 0.0)),)
    plan = FloorPlan("plan", walls(0.9).surfaces, doors, (), (), (), box(-1, -1, 6, 1))
    (door,) = with_walls(plan, walls(0.95, 0.03)).doors
    assert (door.start, door.end) == ((2.0, 0.03), (2.95, 0.03))
    with pytest.raises(FloorPlanError, match=r"leaves only 0\.40 m"):
        with_walls(plan, walls(0.4))


def test_closed_leaves_reach_from_wall_to_wall() -> None:
    """A closed door and an open one beside it share a pier, which straightening moves."""

    def plan(y: float, *more: Surface, doors: tuple[PlanDoor, ...] = ()) -> FloorPlan:
        walls = [((0.0, y), (1.0, y)), ((2.0, y), (2.0, 1.0)), ((2.9, y), (5.0, y))]
        surfaces = *(Surface(wall) for wall in walls), *more
        return FloorPlan("plan", surfaces, doors, (), (), (), box(-1, -1, 6, 2))

    closed = PlanDoor("closed", (1.0, 0.0), (2.0, 0.0), open=False)
    opened = PlanDoor("open", (2.0, 0.0), (2.9, 0.0))
    leaf = Surface((closed.start, closed.end), Material.LEAF)
    straight = with_walls(plan(0.0, leaf, doors=(closed, opened)), plan(0.06))
    moved = replace(closed, start=(1.0, 0.06), end=(2.0, 0.06))
    assert straight.doors == (moved, replace(opened, start=(2.0, 0.06), end=(2.9, 0.06)))
    assert straight.surfaces[-1] == Surface((moved.start, moved.end), Material.LEAF)
    assert len(straight.surfaces) == 4


def test_walls_stay_as_traced_rather_than_narrow_a_door(tmp_path: Path) -> None:
    path = narrowing(tmp_path)
    plan, report = import_map(path)
    assert plan == import_map(path, tracing=Tracing(straighten=0.0)).plan
    assert [door.name for door in plan.doors if door.open] == ["narrow"]
    assert any("walls are left as traced" in note for note in report.notes)


@pytest.mark.parametrize("floor", ["2", "3ne"])
def test_no_door_of_a_real_floor_opens_or_closes(floor: str) -> None:
    path = DATA / "gdc_floors" / floor / f"{floor}.yaml"
    if not path.exists():
        pytest.skip("the labelled floors are not here")
    straight = import_map(path).plan
    as_traced = import_map(path, tracing=Tracing(straighten=0.0)).plan
    bound = BOUND * 0.05 + 1e-9
    assert len(straight.segments) < 0.7 * len(as_traced.segments)
    assert [(d.name, d.open) for d in straight.doors] == [(d.name, d.open) for d in as_traced.doors]
    for door, before in zip(straight.doors, as_traced.doors, strict=True):
        assert math.dist(door.start, before.start) <= bound
        assert math.dist(door.end, before.end) <= bound
