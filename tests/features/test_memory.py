"""Scenes joined over time: what counts, what is one thing, and how exact it gets."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_features.frames import Pose
from semnav_features.memory import SceneMemory
from semnav_features.rules import DoorRules
from semnav_features.scene import ends_of
from tests.support.remembering import DOOR_A, DOOR_B, WALL_A, Ends, see

poses = st.tuples(st.floats(-9, 9), st.floats(-9, 9), st.floats(-math.pi, math.pi))


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


@pytest.mark.parametrize(
    ("width", "counts"), [(0.6, 0), (0.7, 1), (1.2, 1), (1.24, 1), (1.26, 0), (1.4, 0)]
)
def test_only_what_all_sightings_together_make_as_wide_as_a_door_counts(
    width: float, counts: int
) -> None:
    memory = SceneMemory()
    for error in (-0.04, 0.04) * 5:
        see(memory, doors=[(3.0, 1.0, 3.0 + width + error, 1.0)])
    assert memory.size[1] == len(memory.scene().doors) == counts


def test_how_wide_a_door_is_says_the_rule() -> None:
    memory = SceneMemory(DoorRules(width_max=1.5))
    see(memory, doors=[(3.0, 1.0, 4.4, 1.0)], scans=3)
    assert memory.size[1] == 1
    memory.clear()
    assert memory.size[1] == 0
    see(memory, doors=[(3.0, 1.0, 4.6, 1.0)], scans=3)
    assert memory.size[1] == 0


def test_a_gap_too_wide_for_a_door_hides_no_door() -> None:
    memory = SceneMemory()
    see(memory, doors=[(3.0, 1.0, 4.45, 1.0)], scans=9)
    see(memory, doors=[(3.0, 1.0, 4.0, 1.0)], scans=3)
    (door,) = memory.scene().doors
    assert door.end == pytest.approx((4.0, 1.0))


def test_a_door_stays_when_it_is_out_of_view() -> None:
    memory = SceneMemory()
    see(memory, doors=[DOOR_A], scans=3)
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
def test_the_order_of_static_scans_does_not_matter(order: list[int]) -> None:
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


def test_of_two_doors_in_one_place_the_more_seen_counts() -> None:
    wide = (2.55, 1.05, 4.0, 1.0)
    memory = SceneMemory()
    for k in range(9):
        see(memory, doors=[wide if k < 4 else DOOR_A])
    assert memory.scene().doors[0].start == pytest.approx(DOOR_A[:2])
    assert memory.size[1] == 1


def test_doors_beside_each_other_both_count() -> None:
    memory = SceneMemory()
    see(memory, doors=[DOOR_A, (4.1, 1.0, 5.1, 1.0), (3.0, 2.2, 4.0, 2.2)], scans=3)
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
    see(memory, walls=[WALL_A, other], scans=2)
    assert memory.size[0] == (1 if joined else 2)


def test_a_wall_grows_with_what_is_seen_of_it() -> None:
    memory = SceneMemory()
    for k in range(5):
        see(memory, walls=[(float(k), 1.0, k + 1.5, 1.0)])
    (wall,) = memory.scene().walls
    assert (*wall.start, *wall.end) == pytest.approx((0.0, 1.0, 5.5, 1.0))


def test_a_cleared_memory_is_empty() -> None:
    memory = SceneMemory()
    see(memory, [WALL_A], [DOOR_A], scans=3)
    memory.clear()
    assert memory.size == (0, 0)
    assert memory.scene().walls == ()


def test_a_remembered_door_is_one_object_however_it_is_asked_for() -> None:
    memory = SceneMemory()
    see(memory, doors=[DOOR_A, DOOR_B], scans=3)
    doors = memory.scene().doors
    assert doors[-1] is doors[1] is tuple(doors)[1] is doors[1:][0]
    assert doors == tuple(doors)
    assert hash(doors) == hash(tuple(doors))
    assert repr(doors) == repr(tuple(doors))
    np.testing.assert_array_equal(ends_of(doors), ends_of(tuple(doors)))
