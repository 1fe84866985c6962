"""Scenes joined over time: what counts, what is one thing, and how exact it gets."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.features.frames import FloatArray, Pose, to_local
from semnav_env.features.kernels.layout import CAPACITY, DOOR, DOORS, WALL, WALLS
from semnav_env.features.memory import MAX_DOORS, MAX_WALLS, SceneMemory

Ends = tuple[float, float, float, float]

HERE: Pose = (0.0, 0.0, 0.0)
ANGLES = (-math.pi, math.radians(1.0))
NOTHING = np.full(360, np.inf)

WALL_A: Ends = (0.0, 1.0, 3.0, 1.0)
DOOR_A: Ends = (3.0, 1.0, 4.0, 1.0)
DOOR_B: Ends = (6.0, 1.0, 7.0, 1.0)

poses = st.tuples(st.floats(-9, 9), st.floats(-9, 9), st.floats(-math.pi, math.pi))


def see(
    memory: SceneMemory,
    walls: Sequence[Ends] = (),
    doors: Sequence[Ends] = (),
    pose: Pose = HERE,
    ranges: FloatArray = NOTHING,
    confidence: float = 0.8,
) -> None:
    """Show the memory one scan, taken at `pose`, of things given in the memory's frame."""
    wall_array, door_array = np.zeros(CAPACITY["walls"], WALL), np.zeros(CAPACITY["doors"], DOOR)
    for array, items in ((wall_array, walls), (door_array, doors)):
        for entry, (x1, y1, x2, y2) in zip(array, items, strict=False):
            entry["start_x"], entry["start_y"] = to_local(pose, (x1, y1))
            entry["end_x"], entry["end_y"] = to_local(pose, (x2, y2))
    door_array["confidence"] = confidence
    counts = np.zeros(4, dtype=np.int64)
    counts[WALLS], counts[DOORS] = len(walls), len(doors)
    memory.update(wall_array, door_array, counts, ranges, ANGLES, pose)


def beams_that_end_at(y: float) -> FloatArray:
    """The ranges of a scan from the origin that meets the line at `y`."""
    angles = ANGLES[0] + ANGLES[1] * np.arange(360)
    with np.errstate(divide="ignore"):
        distances = y / np.sin(angles)
    return np.where(distances > 0, distances, np.inf)


def test_a_wall_counts_from_its_second_sighting() -> None:
    memory = SceneMemory()
    sizes = []
    for _ in range(3):
        see(memory, walls=[WALL_A])
        sizes.append(memory.size)
    assert sizes == [(0, 0), (1, 0), (1, 0)]


@pytest.mark.parametrize(("confidence", "sightings"), [(1.0, 2), (0.7, 2), (0.6, 4), (0.5, None)])
def test_a_door_counts_the_sooner_the_surer_its_sightings_are(
    confidence: float, sightings: int | None
) -> None:
    memory = SceneMemory()
    sizes = []
    for _ in range(10):
        see(memory, doors=[DOOR_A], confidence=confidence)
        sizes.append(memory.size[1])
    assert (sizes.index(1) + 1 if 1 in sizes else None) == sightings


def test_a_door_stays_when_it_is_out_of_view() -> None:
    memory = SceneMemory()
    for _ in range(3):
        see(memory, doors=[DOOR_A])
    for _ in range(50):
        see(memory)
    (door,) = memory.scene().doors
    assert door.sightings == 3
    assert 0.95 < door.confidence < 1.0


@given(views=st.lists(poses, min_size=3, max_size=6))
def test_what_is_seen_from_many_places_is_one_thing(views: list[Pose]) -> None:
    memory = SceneMemory()
    for pose in views:
        see(memory, [WALL_A], [DOOR_A], pose)
    scene = memory.scene()
    assert memory.size == (1, 1)
    assert scene.walls[0].start == pytest.approx(WALL_A[:2], abs=1e-9)
    assert scene.doors[0].end == pytest.approx(DOOR_A[2:], abs=1e-9)


@given(order=st.permutations(range(12)))
def test_the_order_of_the_scans_of_a_static_scene_does_not_matter(order: list[int]) -> None:
    rng = np.random.default_rng(5)
    shifts = rng.normal(0.0, 0.02, (12, 4))
    memory = SceneMemory()
    for k in order:
        part = (0.4 * (k % 6), 1.0, 1.2 + 0.4 * (k % 6), 1.0)
        doors = [DOOR_A, DOOR_B] if k % 2 else [DOOR_A]
        see(memory, [part], [tuple(np.add(door, shifts[k])) for door in doors])
    scene = memory.scene()
    assert [d.sightings for d in sorted(scene.doors, key=lambda d: d.start)] == [12, 6]
    for door, expected in zip(sorted(scene.doors, key=lambda d: d.start), (3.0, 6.0), strict=True):
        assert door.start[0] == pytest.approx(expected, abs=0.05)
    ends = [x for wall in scene.walls for x in (wall.start[0], wall.end[0])]
    assert (min(ends), max(ends)) == pytest.approx((0.0, 3.2), abs=1e-9)


def test_a_door_seen_from_both_sides_is_one_door() -> None:
    memory = SceneMemory()
    thickness = 0.2
    for k in range(6):
        x1, y1, x2, y2 = DOOR_A
        door = DOOR_A if k % 2 else (x2, y2 + thickness, x1, y1 + thickness)
        see(memory, doors=[door])
    (door,) = memory.scene().doors
    assert door.sightings == 6
    assert door.midpoint == pytest.approx((3.5, 1.1), abs=0.02)


def test_a_jamb_is_known_better_with_every_sighting() -> None:
    rng = np.random.default_rng(1)
    errors = np.zeros((60, 10))
    for trial in range(60):
        memory = SceneMemory()
        for k in range(2 + errors.shape[1]):
            see(memory, doors=[tuple(np.add(DOOR_A, rng.normal(0.0, 0.05, 4)))])
            if k >= 2:
                errors[trial, k - 2] = math.dist(memory.scene().doors[0].start, DOOR_A[:2])
    rms = np.sqrt((errors**2).mean(axis=0))
    assert rms[0] == pytest.approx(0.05 * math.sqrt(2 / 3), rel=0.3)
    assert rms[-3:].mean() < 0.65 * rms[0]


AHEAD: Ends = (-0.5, 2.0, 0.5, 2.0)


def test_a_door_whose_opening_is_found_filled_is_given_up_and_comes_back() -> None:
    memory = SceneMemory()
    for _ in range(20):
        see(memory, doors=[AHEAD])
    for _ in range(12):
        see(memory, ranges=beams_that_end_at(2.0))
    assert memory.size[1] == 0
    for _ in range(9):
        see(memory, doors=[AHEAD])
    assert memory.size[1] == 1


def test_an_open_gap_in_which_most_scans_find_no_door_is_none() -> None:
    memory = SceneMemory()
    for k in range(40):
        see(memory, doors=[AHEAD] if k % 8 == 0 else [], ranges=beams_that_end_at(4.0))
    assert memory.size[1] == 0


@pytest.mark.parametrize(
    "ranges",
    [beams_that_end_at(1.0), np.full(360, np.nan), np.full(360, -np.inf)],
    ids=["hidden", "nan", "too near"],
)
def test_a_scan_that_cannot_tell_says_nothing_of_a_door(ranges: FloatArray) -> None:
    memory = SceneMemory()
    for _ in range(4):
        see(memory, doors=[AHEAD])
    for _ in range(20):
        see(memory, ranges=ranges)
    assert memory.size[1] == 1


@pytest.mark.parametrize(
    "pose",
    [(0.0, -3.0, 0.0), (0.0, 1.8, 0.0), (6.0, 0.5, 0.0)],
    ids=["too far", "in the doorway", "too flat"],
)
def test_only_a_good_view_speaks_against_a_door(pose: Pose) -> None:
    memory = SceneMemory()
    for _ in range(4):
        see(memory, doors=[AHEAD])
    for _ in range(20):
        see(memory, pose=pose)
    assert memory.size[1] == 1


@pytest.mark.parametrize("hidden", [slice(0, 255), slice(286, 360)], ids=["right", "left"])
def test_a_scan_that_sees_the_wall_on_one_side_of_a_door_only_says_nothing_of_it(
    hidden: slice,
) -> None:
    """Beams of one degree: the opening spans 76 to 104 degrees, beams 256 to 284."""
    for ranges in (beams_that_end_at(4.0), beams_that_end_at(4.0)[:286]):
        memory = SceneMemory()
        for _ in range(4):
            see(memory, doors=[AHEAD])
        seen = ranges.copy()
        seen[hidden] = 0.5
        for _ in range(40):
            see(memory, ranges=seen)
        assert memory.size[1] == 1


WALL_AHEAD: Ends = (0.5, 2.0, -0.5, 2.0)


def test_a_wall_that_scans_pass_through_is_given_up_and_comes_back() -> None:
    memory = SceneMemory()
    for _ in range(200):
        see(memory, walls=[WALL_AHEAD])
    for _ in range(40):
        see(memory, ranges=beams_that_end_at(3.0))
    assert memory.size[0] == 0
    for _ in range(3):
        see(memory, walls=[WALL_AHEAD])
    assert memory.size[0] == 1


@pytest.mark.parametrize(
    "ranges",
    [beams_that_end_at(1.0), beams_that_end_at(2.3), NOTHING, np.full(360, np.nan)],
    ids=["hidden", "drifted", "no return", "nan"],
)
def test_a_scan_that_cannot_tell_says_nothing_of_a_wall(ranges: FloatArray) -> None:
    memory = SceneMemory()
    for _ in range(4):
        see(memory, walls=[WALL_AHEAD])
    for _ in range(80):
        see(memory, ranges=ranges)
    assert memory.size[0] == 1


def test_a_long_wall_is_given_up_by_those_who_pass_close_to_it() -> None:
    """Of a wall of 12 m they see but a quarter in good view."""
    memory = SceneMemory()
    for _ in range(3):
        see(memory, walls=[(6.0, 0.8, -6.0, 0.8)])
    for _ in range(40):
        see(memory, ranges=beams_that_end_at(2.0))
    assert memory.size == (0, 0)


def test_a_long_wall_is_not_given_up_for_the_view_through_a_doorway() -> None:
    memory = SceneMemory()
    for _ in range(3):
        see(memory, walls=[(6.0, 0.8, -6.0, 0.8)])
    at_wall, behind = beams_that_end_at(0.8), beams_that_end_at(5.0)
    angles = ANGLES[0] + ANGLES[1] * np.arange(360)
    through = np.abs(np.cos(angles)) * 0.8 < 0.5 * np.sin(angles)
    ranges = np.where(through, behind, at_wall)
    for _ in range(40):
        see(memory, ranges=ranges)
    assert memory.size == (1, 0)


def test_of_two_doors_in_one_place_the_one_seen_more_often_counts() -> None:
    wide = (2.55, 1.05, 4.0, 1.0)
    memory = SceneMemory()
    for k in range(9):
        see(memory, doors=[wide if k < 4 else DOOR_A])
    assert memory.scene().doors[0].start == pytest.approx(DOOR_A[:2])
    assert memory.size[1] == 1


def test_doors_beside_each_other_both_count() -> None:
    memory = SceneMemory()
    for _ in range(3):
        see(memory, doors=[DOOR_A, (4.1, 1.0, 5.1, 1.0), (3.0, 2.2, 4.0, 2.2)])
    assert memory.size[1] == 3


@pytest.mark.parametrize(
    ("other", "joined"),
    [
        ((3.2, 1.0, 5.0, 1.0), True),
        ((3.5, 1.0, 5.0, 1.0), False),
        ((2.0, 1.1, 5.0, 1.1), True),
        ((2.0, 1.25, 5.0, 1.25), False),
        ((3.0, 1.0, 0.0, 1.0), False),
        ((2.0, 1.0, 5.0, 1.6), False),
    ],
    ids=["small gap", "passable gap", "same line", "behind", "other face", "other direction"],
)
def test_which_walls_are_one(other: Ends, joined: bool) -> None:
    memory = SceneMemory()
    for _ in range(2):
        see(memory, walls=[WALL_A, other])
    assert memory.size[0] == (1 if joined else 2)


def test_a_wall_grows_with_what_is_seen_of_it() -> None:
    memory = SceneMemory()
    for k in range(5):
        see(memory, walls=[(float(k), 1.0, k + 1.5, 1.0)])
    (wall,) = memory.scene().walls
    assert (*wall.start, *wall.end) == pytest.approx((0.0, 1.0, 5.5, 1.0))


def test_a_full_memory_forgets_what_was_seen_least() -> None:
    memory = SceneMemory()
    for _ in range(5):
        see(memory, [WALL_A], [DOOR_A])
    for k in range(MAX_WALLS + 10):
        x = 10.0 + 5.0 * k
        see(memory, [(x, 0.0, x + 1.0, 0.0)], [(x, 3.0, x + 1.0, 3.0)])
    for _ in range(3):
        see(memory, [(-9.0, 0.0, -8.0, 0.0)], [DOOR_B])
    scene = memory.scene()
    assert memory.size == (2, 2)
    assert scene.doors[0].start == pytest.approx(DOOR_A[:2])
    assert memory.arrays[2][:2].tolist() == [MAX_WALLS, MAX_DOORS]


def test_a_cleared_memory_is_empty() -> None:
    memory = SceneMemory()
    for _ in range(3):
        see(memory, [WALL_A], [DOOR_A])
    memory.clear()
    assert memory.size == (0, 0)
    assert memory.scene().walls == ()
