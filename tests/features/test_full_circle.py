"""Scans of a full circle: where the scanner begins its turn is nothing that the world knows."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_features import CornerKind, Scan, Scene, extract
from semnav_features.extraction import beam_directions, sensor_of
from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.chain import extract_arrays
from semnav_features.kernels.layout import WALLS
from semnav_features.kernels.scratch import allocate_features, allocate_scratch
from semnav_features.settings import ExtractorSettings
from tests.support.raycaster import cast, heidelberg, polyline, scan_of
from tests.support.strategies import Opening, Room, openings, rooms

quick = settings(max_examples=40, deadline=None)
BEAMS = 720
seeds = st.integers(0, 2**32 - 1)
seams = st.integers(0, BEAMS - 1)
angles = st.floats(-math.pi, math.pi)


def circle(segments: FloatArray, pose: Pose, seed: int | None = None, sigma: float = 0.02) -> Scan:
    """A full turn of `BEAMS` beams, without noise if there is no seed."""
    increment = math.tau / BEAMS
    ranges = cast(segments, pose, -math.pi + increment * np.arange(BEAMS))
    if seed is not None:
        ranges = ranges + np.random.default_rng(seed).normal(0.0, sigma, BEAMS)
    return Scan(ranges, -math.pi, increment)


def begun_at(scan: Scan, beam: int) -> Scan:
    """The same beams, the first of them another one."""
    start = scan.angle_min + beam * scan.angle_increment
    return Scan(np.roll(scan.ranges, -beam), math.remainder(start, math.tau), scan.angle_increment)


def places(scene: Scene) -> list[tuple[float, ...]]:
    """Everything in a scene as sorted rows, whatever its order."""
    rows = [(0.0, *wall.start, *wall.end, wall.beams) for wall in scene.walls]
    rows += [(1.0, *door.start, *door.end, 0.0) for door in scene.doors]
    rows += [(2.0, *corner.point, corner.kind, 0.0, 0.0) for corner in scene.corners]
    rows += [(3.0, *corridor.start, *corridor.end, 0.0) for corridor in scene.corridors]
    return sorted(tuple(round(value, 6) + 0.0 for value in row) for row in rows)


@quick
@given(openings(0.5, 2.5), seeds, seams)
def test_the_scene_does_not_depend_on_the_first_beam(
    opening: Opening, seed: int, seam: int
) -> None:
    scan = circle(opening.segments, opening.pose, seed)
    expected, found = places(extract(scan)), places(extract(begun_at(scan, seam)))
    assert len(found) == len(expected)
    np.testing.assert_allclose(np.array(found), np.array(expected), atol=1e-5)


@quick
@given(st.floats(0.0, 8.0), angles, seeds, seams)
def test_corridors_do_not_depend_on_the_first_beam(
    x: float, heading: float, seed: int, seam: int
) -> None:
    """In a hall with doors, where many corners show the same corridor."""
    scan = circle(heidelberg()[0], (x, 0.0, heading), seed)
    expected, found = places(extract(scan)), places(extract(begun_at(scan, seam)))
    assert len(found) == len(expected)
    np.testing.assert_allclose(np.array(found), np.array(expected), atol=1e-5)


@quick
@given(rooms(), seams)
def test_a_closed_room_is_the_same_wherever_the_scan_begins(room: Room, seam: int) -> None:
    scene = extract(begun_at(circle(room.segments, room.pose), seam))
    assert len(scene.walls) == 4
    assert [corner.kind for corner in scene.corners] == [CornerKind.OUTER] * 4
    sides = sorted(wall.length for wall in scene.walls)
    expected = sorted([room.width, room.width, room.height, room.height])
    assert sides == pytest.approx(expected, abs=0.4)  # beams just miss the corners


@quick
@given(rooms(), seeds, seams)
def test_a_noisy_room_keeps_its_four_corners(room: Room, seed: int, seam: int) -> None:
    scene = extract(begun_at(circle(room.segments, room.pose, seed, sigma=0.005), seam))
    assert [corner.kind for corner in scene.corners] == [CornerKind.OUTER] * 4


@quick
@given(openings(0.85, 1.15), st.floats(-0.6, 0.6))
def test_a_door_across_the_first_beam_is_found(opening: Opening, turn: float) -> None:
    start, end = opening.jambs
    x, y, _ = opening.pose
    to_door = math.atan2(start[1] - y, 0.5 * (start[0] + end[0]) - x)
    pose = (x, y, to_door + math.pi + turn)  # the door lies behind, where the scan begins
    doors = extract(circle(opening.segments, pose)).placed(pose).doors
    assert len(doors) == 1
    off = max(math.dist(doors[0].start, start), math.dist(doors[0].end, end))
    assert off < 0.12  # either edge of the wall


@quick
@given(openings(0.5, 2.5), seeds)
def test_repeating_the_first_direction_changes_nothing(opening: Opening, seed: int) -> None:
    scan = circle(opening.segments, opening.pose, seed)
    doubled = np.append(scan.ranges, scan.ranges[0])
    again = Scan(doubled, scan.angle_min, scan.angle_increment)
    assert places(extract(again)) == places(extract(scan))
    doubled[0] = math.nan
    stand_in = Scan(doubled, scan.angle_min, scan.angle_increment)
    assert places(extract(stand_in)) == places(extract(scan))


@pytest.mark.parametrize("missing", [1, 2])
def test_a_circle_that_lacks_a_beam_or_two_is_one(missing: int) -> None:
    wall = polyline((-2.0, -3.0), (-2.0, 3.0))
    scan = circle(wall, (0.0, 0.0, 0.0))
    walls = extract(Scan(scan.ranges[:-missing], scan.angle_min, scan.angle_increment)).walls
    assert len(walls) == 1
    assert walls[0].length == pytest.approx(6.0, abs=0.2)


def test_a_wall_ends_where_the_scanner_does_not_look() -> None:
    wall = polyline((-2.0, -3.0), (-2.0, 3.0))
    scan = circle(wall, (0.0, 0.0, 0.0))
    walls = extract(Scan(scan.ranges[:-20], scan.angle_min, scan.angle_increment)).walls
    assert len(walls) == 2


@pytest.mark.parametrize("seam", [0, 1, 100, 359, 719])
def test_walls_know_their_beams(seam: int) -> None:
    segments, _ = heidelberg()
    scan = begun_at(circle(segments, (1.0, 0.3, 0.24), seed=3), seam)
    features, settings = allocate_features(), ExtractorSettings()
    directions = beam_directions(BEAMS, scan.angle_min, scan.angle_increment)
    arrays = (settings.as_record()[0], allocate_scratch(BEAMS), features)
    extract_arrays(scan.ranges.copy(), directions, sensor_of(scan), *arrays, True)
    points = scan.ranges[:, None] * directions
    walls = features.walls[: features.counts[WALLS]]
    assert len(walls) > 5
    for wall in walls:
        for name, beam in (("start", wall["first"]), ("end", wall["last"])):
            end = np.array((wall[f"{name}_x"], wall[f"{name}_y"]))
            assert np.linalg.norm(points[beam] - end) < 0.1


def test_a_coarse_circle_gives_a_scene() -> None:
    for beams in range(1, 40):
        scan = Scan(np.full(beams, 2.0), 0.0, math.tau / beams)
        assert all(math.isfinite(wall.length) for wall in extract(scan).walls)


def test_a_circle_without_returns_is_empty() -> None:
    assert extract(Scan(np.full(BEAMS, math.nan), -math.pi, math.tau / BEAMS)) == Scene()


def test_part_of_a_circle_is_no_ring() -> None:
    scan = scan_of(polyline((2.0, -1.0), (2.0, 1.0)), (0.0, 0.0, 0.0))
    assert [c.kind for c in extract(scan).corners] == [CornerKind.POTENTIAL] * 2
