from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from semnav_env.features import CornerKind, Door, ExtractorSettings, Scan, Scene, Wall, extract
from semnav_env.features.frames import FloatArray, Point, Pose, to_local
from semnav_env.features.reference.corners import corner_kind
from tests.raycaster import heidelberg, polygon, polyline, scan_of
from tests.strategies import Opening, Room, awkward_scans, openings, rooms

quick = settings(max_examples=60, deadline=None)
MILLIMETRE = 1e-3


def cross(a: Point, b: Point) -> float:
    return a[0] * b[1] - a[1] * b[0]


def full_circle(segments: FloatArray, pose: Pose, beams: int = 1080) -> Scan:
    return scan_of(segments, pose, beams, 2.0 * math.pi * (beams - 1) / beams)


def is_on(wall: Wall, point: Point) -> bool:
    along = wall.end[0] - wall.start[0], wall.end[1] - wall.start[1]
    offset = cross(along, (point[0] - wall.start[0], point[1] - wall.start[1])) / wall.length
    return abs(offset) < MILLIMETRE


def has_door(scene: Scene, jambs: tuple[Point, Point], within: float = 0.25) -> bool:
    return any(is_door(door, jambs, within) for door in scene.doors)


def is_door(door: Door, jambs: tuple[Point, Point], within: float = 0.25) -> bool:
    return max(math.dist(door.start, jambs[0]), math.dist(door.end, jambs[1])) < within


@quick
@given(rooms())
def test_a_noise_free_room_has_its_four_walls_and_four_outer_corners(room: Room) -> None:
    corners = [to_local(room.pose, corner) for corner in room.corners]
    scene = extract(full_circle(room.segments, room.pose))
    assert len(scene.walls) == 4
    for start, end in pairwise([*corners, corners[0]]):
        side = [wall for wall in scene.walls if is_on(wall, start) and is_on(wall, end)]
        assert sum(wall.length for wall in side) > 0.9 * math.dist(start, end)
    assert all(wall.residual < MILLIMETRE for wall in scene.walls)
    assert len(scene.corners) == 4
    assert all(corner.kind is CornerKind.OUTER for corner in scene.corners)
    for corner in corners:
        assert min(math.dist(corner, found.point) for found in scene.corners) < MILLIMETRE
    assert scene.doors == ()


@quick
@given(openings(0.5, 2.5), st.integers(0, 2**32 - 1))
def test_the_scanner_is_on_the_left_of_every_wall_and_door(opening: Opening, seed: int) -> None:
    rng = np.random.default_rng(seed)
    scene = extract(scan_of(opening.segments, opening.pose, sigma=0.02, rng=rng))
    assert len(scene.walls) >= 3
    assert all(cross(wall.start, wall.end) > 0 for wall in scene.walls)
    assert all(cross(door.start, door.end) > 0 for door in scene.doors)


@quick
@given(openings(0.85, 1.15))
def test_an_opening_of_door_width_is_a_door_and_the_only_one(opening: Opening) -> None:
    scene = extract(scan_of(opening.segments, opening.pose)).placed(opening.pose)
    assert len(scene.doors) == 1
    assert is_door(scene.doors[0], opening.jambs, within=0.12)  # either edge of the wall


@quick
@given(openings(1.5, 2.5))
def test_the_mouth_of_a_corridor_is_no_door(opening: Opening) -> None:
    assert extract(scan_of(opening.segments, opening.pose)).doors == ()


@quick
@given(openings(0.85, 1.15), st.floats(0.02, 0.15))
def test_a_recess_of_door_width_is_no_door(opening: Opening, depth: float) -> None:
    right = -opening.corridor / 2
    front = polyline((0.0, right), (0.0, right - depth), (opening.width, right - depth))
    back = polyline((opening.width, right - depth), (opening.width, right))
    segments = np.concatenate((opening.segments, front, back))
    assert extract(scan_of(segments, opening.pose)).doors == ()


def test_a_pillar_beside_a_wall_makes_no_door() -> None:
    walls = polyline((-4.0, 1.2), (6.0, 1.2), (6.0, -1.2), (-4.0, -1.2))
    pillar = polygon((2.0, 0.1), (2.4, 0.1), (2.4, 0.5), (2.0, 0.5))
    assert extract(scan_of(np.concatenate((walls, pillar)), (0.0, -0.3, 0.0))).doors == ()


def test_a_door_needs_walls_on_both_sides_only_if_one_sided_doors_are_off() -> None:
    leaf = polyline((1.0, -1.0), (1.5, -0.1))  # open into the corridor, hiding the wall behind
    scan = scan_of(np.concatenate((polyline((-3.0, -1.0), (0.0, -1.0)), leaf)), (-1.0, 0.0, 0.0))
    assert has_door(extract(scan), ((1.0, -1.0), (2.0, -1.0)), within=0.1)
    assert extract(scan, ExtractorSettings(one_sided_doors=False)).doors == ()


@quick
@given(openings(0.5, 2.5), st.floats(-10.0, 10.0))
def test_rotating_the_scan_rotates_the_scene(opening: Opening, angle: float) -> None:
    rng = np.random.default_rng(7)
    scan = scan_of(opening.segments, opening.pose, sigma=0.02, rng=rng)
    turned = Scan(scan.ranges, scan.angle_min + angle, scan.angle_increment)
    expected = extract(scan).placed((0.0, 0.0, angle))
    assert_alike(extract(turned), expected)


@quick
@given(openings(0.5, 2.5), st.floats(1e-4, 1e-2))
def test_mirroring_the_scan_swaps_left_and_right(opening: Opening, roughness: float) -> None:
    rng = np.random.default_rng(11)
    scan = scan_of(opening.segments, opening.pose, sigma=roughness, rng=rng)
    mirrored = Scan(scan.ranges[::-1], scan.angle_min, scan.angle_increment)
    scene, other = extract(scan), extract(mirrored)
    assert len(other.walls) == len(scene.walls)
    for one, two in zip(other.walls, scene.walls[::-1], strict=True):
        assert (*one.start, *one.end) == pytest.approx(
            (*_flip(two.end), *_flip(two.start)), abs=1e-6
        )
        assert (one.start_break, one.end_break) == (two.end_break, two.start_break)
        assert (one.start_rupture, one.end_rupture) == (two.end_rupture, two.start_rupture)
    assert len(other.doors) == len(scene.doors)
    for door, twin in zip(other.doors, scene.doors[::-1], strict=True):
        assert (*door.start, *door.end) == pytest.approx(
            (*_flip(twin.end), *_flip(twin.start)), abs=1e-6
        )
    kinds = [corner.kind for corner in scene.corners[::-1]]
    assert [corner.kind for corner in other.corners] == kinds


def _flip(point: Point) -> Point:
    return point[0], -point[1]


def assert_alike(scene: Scene, expected: Scene) -> None:
    for kind in ("walls", "doors", "corridors"):
        found, other = getattr(scene, kind), getattr(expected, kind)
        assert len(found) == len(other)
        for one, two in zip(found, other, strict=True):
            assert one.start == pytest.approx(two.start, abs=1e-6)
            assert one.end == pytest.approx(two.end, abs=1e-6)
    assert [c.kind for c in scene.corners] == [c.kind for c in expected.corners]


@st.composite
def wedges(draw: st.DrawFn) -> tuple[Point, Point, Point]:
    """Far end, corner and far end of two walls of 1 m, both seen from the origin."""
    corner = draw(st.floats(2.0, 5.0)), 0.0
    right = math.radians(draw(st.floats(-160.0, -20.0)))
    left = math.radians(draw(st.floats(20.0, 160.0)))
    ends = [(corner[0] + math.cos(a), math.sin(a)) for a in (right, left)]
    return ends[0], corner, ends[1]


@quick
@given(wedges())
def test_a_corner_is_inner_if_it_points_at_the_scanner(
    wedge: tuple[Point, Point, Point],
) -> None:
    before, corner, after = wedge
    sides = [math.atan2(y - corner[1], x - corner[0]) for x, y in (before, after)]
    assume(abs(sides[1] - sides[0] - math.pi) > math.radians(55.0))  # flatter is no corner
    scene = extract(scan_of(polyline(*wedge), (0.0, 0.0, 0.0)))
    full = [found for found in scene.corners if found.kind is not CornerKind.POTENTIAL]
    assert len(full) == 1
    assert full[0].point == pytest.approx(corner, abs=1e-6)
    chord = before[0] + (after[0] - before[0]) * before[1] / (before[1] - after[1])
    assert full[0].kind is (CornerKind.INNER if chord > corner[0] else CornerKind.OUTER)


@given(wedges())
def test_formula_3_1_agrees_with_geometry_unless_an_inner_corner_is_obtuse(
    wedge: tuple[Point, Point, Point],
) -> None:
    before, corner, after = wedge
    chord = before[0] + (after[0] - before[0]) * before[1] / (before[1] - after[1])
    sides = [math.atan2(y - corner[1], x - corner[0]) for x, y in (before, after)]
    opening = sides[1] - sides[0]
    assume(abs(opening - math.pi) > 1e-3)
    if chord < corner[0]:
        assert corner_kind(*wedge) is CornerKind.OUTER
    elif opening <= math.pi / 2:
        assert corner_kind(*wedge) is CornerKind.INNER


def test_walls_that_stop_short_of_their_corner_are_extended_to_it() -> None:
    segments = np.concatenate(
        (polyline((2.0, -1.5), (2.0, 0.8)), polyline((1.8, 1.0), (-1.0, 1.0)))
    )
    corners = extract(scan_of(segments, (0.0, 0.0, 0.0))).corners
    outer = [corner for corner in corners if corner.kind is CornerKind.OUTER]
    assert len(outer) == 1
    assert outer[0].point == pytest.approx((2.0, 1.0), abs=1e-6)


def test_both_loose_ends_of_a_wall_are_potential_corners() -> None:
    scene = extract(scan_of(polyline((2.0, -1.0), (2.0, 1.0)), (0.0, 0.0, 0.0)))
    wall = scene.walls[0]
    assert wall.start_rupture
    assert wall.end_rupture
    assert [c.kind for c in scene.corners] == [CornerKind.POTENTIAL] * 2
    assert [c.point for c in scene.corners] == [wall.start, wall.end]


def test_a_jump_of_the_range_breaks_both_walls() -> None:
    segments = np.concatenate(
        (polyline((2.0, -2.0), (2.0, 0.0)), polyline((4.0, -0.5), (4.0, 3.0)))
    )
    near, far = extract(scan_of(segments, (0.0, 0.0, 0.0))).walls
    assert (near.start_rupture, near.end_break, near.end_rupture) == (True, True, False)
    assert (far.start_break, far.start_rupture, far.end_rupture) == (True, False, True)


def test_a_gap_that_one_could_pass_is_never_bridged() -> None:
    segments = np.concatenate((polyline((2.0, -2.0), (2.0, 0.0)), polyline((2.0, 0.6), (2.0, 3.0))))
    assert len(extract(scan_of(segments, (0.0, 0.0, 0.0))).walls) == 2


def test_a_few_missing_returns_do_not_end_a_wall() -> None:
    scan = scan_of(polyline((2.0, -3.0), (2.0, 3.0)), (0.0, 0.0, 0.0))
    ranges = scan.ranges.copy()
    ranges[[390, 400, 401, 420]] = math.nan
    assert len(extract(Scan(ranges, scan.angle_min, scan.angle_increment)).walls) == 1


def test_a_side_corridor_gives_a_midpoint_in_its_mouth() -> None:
    opening = Opening(corridor=2.0, width=2.0, pose=(-2.0, 0.0, 0.0), wider=0.0)
    scene = extract(scan_of(opening.segments, opening.pose)).placed(opening.pose)
    assert min(math.dist(c.midpoint, (1.0, -1.0)) for c in scene.corridors) < 0.1


def test_a_corridor_ends_at_the_nearest_wall_only() -> None:
    walls = polyline((-3.0, -1.0), (1.0, -1.0))
    screens = np.concatenate((polyline((3.0, 1.0), (-3.0, 1.0)), polyline((3.0, 1.4), (-3.0, 1.4))))
    scene = extract(scan_of(np.concatenate((walls, screens)), (-0.5, 0.0, 0.0)))
    assert len(scene.corridors) == 1
    assert scene.corridors[0].end == pytest.approx((1.5, 1.0), abs=0.05)


@settings(max_examples=200, deadline=None)
@given(awkward_scans())
def test_any_scan_gives_a_finite_scene(scan: Scan) -> None:
    assert_finite(extract(scan))


def assert_finite(scene: Scene) -> None:
    points = [p for w in scene.walls for p in (w.start, w.end)]
    points += [p for door in scene.doors for p in (door.start, door.end)]
    points += [corner.point for corner in scene.corners]
    points += [p for corridor in scene.corridors for p in (corridor.start, corridor.end)]
    assert np.isfinite(np.array(points, dtype=float)).all()
    assert all(math.isfinite(wall.residual) and wall.residual >= 0.0 for wall in scene.walls)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 0.0, -3.0, 1e-3, 10.0, 11.0])
@pytest.mark.parametrize("beams", [1, 2, 3, 811])
def test_a_scan_without_returns_gives_an_empty_scene(value: float, beams: int) -> None:
    assert extract(Scan(np.full(beams, value), -2.356, 0.0058)) == Scene()


@pytest.mark.parametrize("beams", [1, 2])
def test_one_or_two_returns_are_no_feature(beams: int) -> None:
    assert extract(Scan(np.ones(beams), 0.0, 0.01)) == Scene()


@pytest.mark.parametrize("beams", [180, 1080, 1081])
def test_the_number_of_beams_does_not_matter(beams: int) -> None:
    scan = scan_of(polyline((2.0, -3.0), (2.0, 3.0)), (0.0, 0.0, 0.0), beams)
    walls = extract(scan).walls
    assert len(walls) == 1
    assert walls[0].length == pytest.approx(6.0, abs=0.4)


def test_a_huge_scan_of_noise_gives_a_scene() -> None:
    rng = np.random.default_rng(5)
    assert_finite(extract(Scan(2.0 + 0.1 * rng.normal(size=200_000), -3.0, 3e-5)))


@pytest.mark.parametrize("increment", [5e-324, 1e-12, 0.1745329, 0.3, 1.0, 4.0])
def test_any_angle_increment_gives_a_scene(increment: float) -> None:
    beams = int(min(50.0, 4.0 * math.pi / increment))
    assert_finite(extract(Scan(np.linspace(1.0, 2.0, beams), 0.3, increment)))


@pytest.mark.parametrize("ranges", [[1.0, 2.0], np.ones(811), None, "scan"])
def test_bare_ranges_are_refused_with_the_way_to_a_scan(ranges: object) -> None:
    with pytest.raises(TypeError, match=r"Scan\(ranges, angle_min"):
        extract(ranges)  # type: ignore[arg-type]


def test_enormous_ranges_are_no_returns() -> None:
    farther, none = (
        Scan([2.0] * 60 + [far] * 40, 0.0, 0.01, range_max=1000.0) for far in (1e300, math.inf)
    )
    settings = ExtractorSettings(rupture_range=1000.0)
    assert extract(farther, settings) == extract(none, settings) != Scene()


def test_beams_beyond_a_full_turn_are_left_out() -> None:
    room = Room(4.0, 4.0, (2.0, 2.0, 0.3))
    once = full_circle(room.segments, room.pose, 720)
    ranges = np.concatenate((once.ranges, np.full(500, 1.0)))
    again = Scan(ranges, once.angle_min, once.angle_increment)
    assert extract(again) == extract(once)


def test_everything_in_a_scene_is_plain_python() -> None:
    opening = Opening(corridor=2.0, width=1.0, pose=(-2.0, 0.0, 0.0))
    scene = extract(scan_of(opening.segments, opening.pose))
    assert type(scene.walls[0].start[0]) is type(scene.doors[0].end[1]) is float
    assert type(scene.walls[0].beams) is int
    assert type(scene.walls[0].start_break) is bool
    assert type(scene.corners[0].kind) is CornerKind


def test_the_doors_of_a_real_hallway_are_seen_from_it() -> None:
    segments, doors = heidelberg()
    rng = np.random.default_rng(1)
    sightings = found = false = detections = 0
    for x in np.linspace(-2.5, 7.0, 60):
        pose = (float(x), 0.24 * float(x) + rng.uniform(0.2, 0.6), 0.24 + rng.uniform(-0.2, 0.2))
        scene = extract(scan_of(segments, pose, sigma=0.02, rng=rng)).placed(pose)
        true = {name: (tuple(ends[0]), tuple(ends[1])) for name, ends in doors.items()}
        for name in ("south_1", "south_2", "south_3"):
            ahead = [to_local(pose, jamb)[0] for jamb in true[name]]
            near = max(math.dist(pose[:2], jamb) for jamb in true[name]) < 5.0
            if near and min(ahead) > 0.0:
                sightings += 1
                found += has_door(scene, true[name])
        detections += len(scene.doors)
        false += sum(
            not any(is_door(d, ends) or is_door(d, ends[::-1]) for ends in true.values())
            for d in scene.doors
        )
    assert sightings > 50
    assert found >= 0.95 * sightings
    assert false <= 0.05 * detections


def test_settings_that_are_none_are_refused_with_what_they_must_be() -> None:
    with pytest.raises(TypeError, match="ExtractorSettings, not dict"):
        extract(Scan([1.0, 1.0], 0.0, 0.1), {"sigma": 0.02})  # type: ignore[arg-type]
