"""Walls, doors and corridors in scans of rooms and corridors."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_features import CornerKind, Door, ExtractorSettings, Scan, Scene, Wall, extract
from semnav_features.frames import Point, to_local
from tests.support.raycaster import full_circle, heidelberg, polygon, polyline, scan_of
from tests.support.strategies import Opening, Room, openings, rooms

quick = settings(max_examples=60, deadline=None)
MILLIMETRE = 1e-3


def cross(a: Point, b: Point) -> float:
    return a[0] * b[1] - a[1] * b[0]


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
def test_a_noise_free_room_has_four_walls_and_corners(room: Room) -> None:
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


def test_one_sided_doors_can_be_turned_off() -> None:
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
