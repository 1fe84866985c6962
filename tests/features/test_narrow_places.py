"""A corridor that narrows to the width of a door goes on; one with a door across it ends there."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.mind.grounding.counted_doors import doors_along
from semnav_features.corridor import corridor_at
from semnav_features.frames import points_to_parent
from semnav_features.kernels.narrowings import is_narrowing
from semnav_features.scene import Door, PlainWalls, Scene

OPENING = np.array([0.0, 0.6, 0.0, -0.6])


def passage(left_before=0.0, right_before=0.0, left_behind=0.0, right_behind=0.0, length=4.0):
    """Walls along x beside an opening of 1.2 m at x = 0, so far outside its jambs."""
    return np.array(
        [
            (-length, 0.6 + left_before, 0.0, 0.6 + left_before),
            (-length, -0.6 - right_before, 0.0, -0.6 - right_before),
            (0.0, 0.6 + left_behind, length, 0.6 + left_behind),
            (0.0, -0.6 - right_behind, length, -0.6 - right_behind),
            (0.0, 0.6 + max(left_before, left_behind), 0.0, 0.6),
            (0.0, -0.6 - max(right_before, right_behind), 0.0, -0.6),
        ]
    )


STEP = st.floats(0.0, 0.15)


@given(STEP, STEP, STEP, STEP, st.floats(-math.pi, math.pi), st.floats(-5.0, 5.0))
def test_a_pilaster_makes_no_door_whatever_the_frame(a, b, c, d, turn, away):
    ends = np.vstack((passage(a, b, c, d), OPENING)).reshape(-1, 2)
    placed = points_to_parent((away, -away, turn), ends).reshape(-1, 4)
    assert is_narrowing(placed[-1], placed)
    assert is_narrowing(placed[-1][[2, 3, 0, 1]], placed)


ASIDE = st.floats(0.0, 0.6)


@given(ASIDE, ASIDE, ASIDE, ASIDE)
def test_a_corridor_whose_sides_go_on_goes_on(a, b, c, d):
    assert is_narrowing(OPENING, passage(a, b, c, d, length=3.0))


@given(st.floats(0.3, 0.6), st.integers(0, 3))
def test_an_unseen_side_ends_a_corridor_at_the_door(aside, missing):
    sides = passage(aside, aside, aside, aside, length=3.0)
    sides[missing, [0, 2]] = np.clip(sides[missing, [0, 2]], -2.4, 2.4)
    assert not is_narrowing(OPENING, sides)


@pytest.mark.parametrize(
    "steps",
    [(0.3, 0.3, 1.0, 1.0), (0.25, 0.25, 1.0, 0.25), (0.7, 0.7, 0.1, 0.1), (0.0, 0.0, 2.0, 2.0)],
    ids=["a door into a room", "a room flush with it", "a narrow arm", "a room at its end"],
)
def test_an_opening_narrower_than_its_corridor_is_a_door(steps):
    assert not is_narrowing(OPENING, passage(*steps))


def test_a_corridor_with_one_through_side_ends_where_it_widens():
    lobby = passage(0.1, 0.1, 0.1, 3.0)
    assert is_narrowing(OPENING, lobby)
    assert is_narrowing(OPENING, lobby * [-1.0, 1.0, -1.0, 1.0])
    leaf = np.array([(0.0, 0.6, 1.2, 0.6)])
    assert not is_narrowing(OPENING, np.vstack((passage(0.1, 0.1, 3.0, 3.0), leaf)))


def test_a_door_at_the_end_behind_a_crossing_is_a_door():
    """Its leaf is open on one side; a wall of the room behind lies close to the other jamb."""
    sides = np.array(
        [
            (-4.0, 0.6, -2.0, 0.6),  # the left side ends before the arm of the crossing
            (-4.0, -1.0, 0.0, -1.0),
            (0.0, 0.6, 1.1, 0.6),  # the leaf
            (0.0, -1.0, 3.0, -1.0),
            (0.0, 0.6, 0.0, 4.0),
        ]
    )
    assert not is_narrowing(OPENING, sides)
    sides[0, 2] = 0.0
    assert is_narrowing(OPENING, sides)


def test_sides_that_are_not_seen_to_run_on_leave_a_door_a_door():
    assert not is_narrowing(OPENING, passage()[:2])
    assert not is_narrowing(OPENING, passage(length=0.9))
    assert is_narrowing(OPENING, np.vstack((passage(length=0.9)[:2], passage()[2:])))
    assert not is_narrowing(np.zeros(4), passage())


@pytest.mark.parametrize(
    ("steps", "end"), [((0.0, 0.1, 0.3, 0.1), 8.0), ((0.4, 0.4, 1.0, 1.0), 4.0)]
)
def test_a_corridor_ends_at_a_door_not_at_a_narrowing(steps, end):
    walls = np.vstack((passage(*steps), (4.0, 2.0, 4.0, -2.0)))
    across = Door((0.0, 0.6), (0.0, -0.6))
    on_the_left = Door((2.0, 0.6 + steps[2]), (3.0, 0.6 + steps[2]))
    scene = Scene(PlainWalls(walls), (across, on_the_left))
    seen = corridor_at(scene, (-4.0, 0.0, 0.0))
    assert seen.end == pytest.approx(end, abs=0.05)
    assert [door.door for door in doors_along(scene, seen)] == [
        on_the_left if end > 4.0 else across
    ]


def test_a_door_of_the_floor_plan_is_a_door_wherever_it_is():
    walls = np.vstack((passage(), (4.0, 2.0, 4.0, -2.0)))
    for name, end in (("1.01", 4.0), (None, 8.0)):
        scene = Scene(PlainWalls(walls), (Door((0.0, 0.6), (0.0, -0.6), name),))
        assert corridor_at(scene, (-4.0, 0.0, 0.0)).end == pytest.approx(end, abs=0.05)
