from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from semnav_features import Arc, ExtractorSettings, Scan, extract
from semnav_features.frames import FloatArray, Point, Pose
from semnav_features.kernels.circles import NO_RAY, algebraic_circle, refine_circle
from tests.support.raycaster import polygon, polyline, scan_of
from tests.support.strategies import Room, rooms

HALL = polyline((-3.0, -5.0), (8.0, -5.0), (8.0, 5.0), (-3.0, 5.0), (-3.0, -5.0))
HERE: Pose = (0.0, 0.0, 0.0)
seeds = st.integers(0, 2**32 - 1)
radii = st.floats(0.2, 1.0)
bearings = st.floats(-2.0, 2.0)


def column(distance: float, bearing: float, radius: float) -> tuple[Point, float]:
    return (distance * math.cos(bearing), distance * math.sin(bearing)), radius


def seen(
    *circles: tuple[Point, float], segments: FloatArray = HALL, sigma: float = 0.0, seed: int = 0
) -> Scan:
    rng = np.random.default_rng(seed)
    return scan_of(segments, HERE, sigma=sigma, rng=rng, circles=circles)


def only(arcs: tuple[Arc, ...]) -> Arc:
    (arc,) = arcs
    return arc


@settings(max_examples=40, deadline=None)
@given(st.floats(1.5, 4.0), bearings, radii)
def test_noise_free_columns_are_exact_to_half_a_beam_spacing(
    distance: float, bearing: float, radius: float
) -> None:
    centre, _ = column(distance, bearing, radius)
    scan = seen((centre, radius))
    arc = only(extract(scan).arcs)
    spacing = distance * scan.angle_increment
    assert math.dist(arc.centre, centre) < 0.7 * spacing
    assert abs(arc.radius - radius) < 0.5 * spacing
    assert arc.convex
    assert math.dist(arc.start, arc.centre) == pytest.approx(arc.radius)
    assert math.dist(arc.end, arc.centre) == pytest.approx(arc.radius)


@pytest.mark.parametrize("diameter", [0.3, 0.4, 0.6, 1.0])
def test_radii_within_four_metres_are_right_to_three_percent(diameter: float) -> None:
    rng = np.random.default_rng(7)
    errors = []
    for seed in range(150):
        place = column(rng.uniform(0.5 + diameter, 4.0), rng.uniform(-2.0, 2.0), diameter / 2)
        found = extract(seen(place, sigma=0.02, seed=seed)).arcs
        errors += [
            abs(arc.radius / place[1] - 1.0)
            for arc in found
            if math.dist(arc.centre, place[0]) < place[1]
        ]
    assert len(errors) >= 100
    assert np.median(errors) < 0.03


def test_hardly_ever_a_wall_remains_on_a_column_that_is_an_arc() -> None:
    rng = np.random.default_rng(0)
    arcs = remains = 0
    for seed in range(200):
        centre, radius = column(
            rng.uniform(1.5, 3.0), rng.uniform(-2.0, 2.0), rng.uniform(0.2, 1.0)
        )
        scene = extract(seen((centre, radius), sigma=0.02, seed=seed))
        middles = [np.add(wall.start, wall.end) / 2 for wall in scene.walls]
        arcs += len(scene.arcs) == 1
        remains += len(scene.arcs) == 1 and any(
            math.dist(middle, centre) <= radius + 0.1 for middle in middles
        )
    assert arcs >= 150
    assert remains <= 0.02 * arcs


@settings(max_examples=30, deadline=None)
@given(st.floats(1.5, 6.0), st.floats(0.0, 0.6), bearings, seeds)
def test_a_round_room_is_one_hollow_arc_and_no_wall(
    radius: float, aside: float, bearing: float, seed: int
) -> None:
    centre, _ = column(aside * radius, bearing, radius)
    scene = extract(seen((centre, radius), segments=polygon((9, 9), (9.1, 9), (9, 9.1)), seed=seed))
    arc = only(scene.arcs)
    assert not arc.convex
    assert not scene.walls
    assert arc.radius == pytest.approx(radius, rel=0.01)
    assert arc.extent > math.radians(180.0)


@settings(max_examples=60, deadline=None)
@given(rooms(), st.floats(0.0, 0.01), seeds)
def test_flat_walls_are_no_arcs(room: Room, sigma: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    assert extract(scan_of(room.segments, room.pose, sigma=sigma, rng=rng)).arcs == ()


def test_noise_bends_flat_walls_in_under_one_percent_of_scans() -> None:
    rng = np.random.default_rng(3)
    walls = polyline((0.0, 0.0), (5.0, 0.0), (5.0, 4.0), (0.0, 4.0), (0.0, 0.0))
    poses = rng.uniform((0.5, 0.5, -3.0), (4.5, 3.5, 3.0), (300, 3))
    scans = [scan_of(walls, tuple(pose), sigma=0.02, rng=rng) for pose in poses]
    assert sum(len(extract(scan).arcs) for scan in scans) < 3


@settings(max_examples=40, deadline=None)
@given(st.floats(1.2, 4.0), bearings, st.floats(0.3, 1.0), st.floats(0.0, 1.5))
def test_a_square_pillar_is_no_arc(
    distance: float, bearing: float, side: float, turn: float
) -> None:
    (x, y), half = column(distance, bearing, side / math.sqrt(2.0))
    turns = turn + np.arange(4) * math.pi / 2
    corners = [(x + half * math.cos(t), y + half * math.sin(t)) for t in turns]
    assert extract(seen(segments=np.concatenate((HALL, polygon(*corners))))).arcs == ()


@settings(max_examples=30, deadline=None)
@given(st.floats(1.5, 4.0), bearings, radii, seeds)
def test_mirroring_the_scan_mirrors_its_arcs(
    distance: float, bearing: float, radius: float, seed: int
) -> None:
    scan = seen(column(distance, bearing, radius), sigma=0.02, seed=seed)
    mirrored = Scan(scan.ranges[::-1], scan.angle_min, scan.angle_increment)
    arcs, others = extract(scan).arcs, extract(mirrored).arcs[::-1]
    assume(len(arcs) == len(others))  # the end-point fit cuts from one side first
    for arc, other in zip(arcs, others, strict=True):
        if arc.beams == other.beams:
            assert other.centre == pytest.approx((arc.centre[0], -arc.centre[1]), abs=1e-6)
            assert other.radius == pytest.approx(arc.radius, abs=1e-6)
            assert other.start == pytest.approx((arc.end[0], -arc.end[1]), abs=1e-6)


@settings(max_examples=30, deadline=None)
@given(st.floats(1.5, 4.0), bearings, radii, st.floats(-3.0, 3.0), seeds)
def test_turning_the_scanner_turns_its_arcs(
    distance: float, bearing: float, radius: float, turn: float, seed: int
) -> None:
    scan = seen(column(distance, bearing, radius), sigma=0.02, seed=seed)
    turned = Scan(scan.ranges, scan.angle_min + turn, scan.angle_increment)
    arcs, others = extract(scan).arcs, extract(turned).arcs
    assert len(arcs) == len(others)
    for arc, other in zip(arcs, others, strict=True):
        assert other.radius == pytest.approx(arc.radius, abs=1e-9)
        x, y = arc.centre
        c, s = math.cos(turn), math.sin(turn)
        assert other.centre == pytest.approx((c * x - s * y, s * x + c * y), abs=1e-9)


def test_two_columns_beside_each_other_are_two_arcs() -> None:
    left, right = ((2.0, 0.5), 0.2), ((2.0, -0.5), 0.3)
    arcs = extract(seen(left, right, sigma=0.02)).arcs
    assert [round(arc.radius, 1) for arc in arcs] == [0.3, 0.2]


def test_without_arcs_a_column_is_walls_again() -> None:
    scan = seen(((2.5, 0.0), 0.5), sigma=0.02)
    without = extract(scan, ExtractorSettings(arcs=False))
    assert without.arcs == ()
    assert len(without.walls) > len(extract(scan).walls)


@pytest.mark.parametrize(
    "limit",
    [
        {"arc_radius_min": 0.6},
        {"arc_radius_max": 0.4},
        {"arc_sagitta_min": 0.6},
        {"arc_beams": 200},
        {"arc_extent_min": math.radians(175.0)},
        {"arc_residual": 0.001},
    ],
)
def test_every_limit_of_an_arc_is_kept(limit: dict[str, float]) -> None:
    scan = seen(((2.5, 0.0), 0.5), sigma=0.02)
    assert len(extract(scan).arcs) == 1
    assert extract(scan, ExtractorSettings(**limit)).arcs == ()  # type: ignore[arg-type]


def test_a_hidden_edge_does_not_constrain_the_width() -> None:
    screen = polyline((1.0, -0.6), (1.0, 0.0))
    whole, half = (
        only(extract(seen(((2.5, 0.0), 0.5), segments=segments)).arcs)
        for segments in (HALL, np.concatenate((HALL, screen)))
    )
    assert half.beams < 0.7 * whole.beams
    assert half.radius == pytest.approx(0.5, rel=0.01)


@given(st.floats(0.1, 10.0), st.floats(-math.pi, math.pi), st.floats(0.5, 6.0), st.floats(2.0, 20))
def test_fits_of_exact_points_are_exact(
    radius: float, start: float, extent: float, away: float
) -> None:
    turns = start + np.linspace(0.0, extent, 30)
    xs, ys = away + radius * np.cos(turns), 1.0 + radius * np.sin(turns)
    circle = algebraic_circle(xs, ys, 0, 29)
    assert circle == pytest.approx((away, 1.0, radius), rel=1e-4)
    refined = refine_circle(xs, ys, 0, 29, circle, NO_RAY, NO_RAY)
    assert refined == pytest.approx((away, 1.0, radius), rel=1e-6)


def test_points_on_a_line_have_no_circle_and_do_no_harm() -> None:
    xs, ys = np.linspace(-1.0, 1.0, 20), np.full(20, 2.0)
    assert not algebraic_circle(xs, ys, 0, 19)[2] < 1e6
