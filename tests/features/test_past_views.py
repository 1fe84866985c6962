"""What moves is neither wall nor door: sightings are compared with earlier views."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_features.frames import FloatArray
from semnav_features.kernels.past_views import (
    FREE,
    HIDDEN,
    NO_RETURN,
    SOLID,
    STANDING_DISTANCE,
    UNSEEN,
    VIEW_PATIENCE,
    VIEW_PERIOD,
    VIEW_SPACING,
    VIEWS,
    look_back,
    mark_maybe_free,
)
from semnav_features.memory import SceneMemory
from tests.support.remembering import ANGLES, Ends, beams_that_end_at, see

SHORT: Ends = (0.3, 2.0, -0.3, 2.0)
LONG: Ends = (1.0, 2.0, -1.0, 2.0)
GAP: Ends = (0.5, 2.0, -0.5, 2.0)
IN_LINE: Ends = (1.0, 2.0, -2.0, 2.0)


def beams_in_a_circle(radius: float) -> FloatArray:
    """The ranges of a scan from the middle of a circle."""
    return np.full(360, radius)


def told(memory: SceneMemory, x: float, y: float) -> int:
    """What the views of a memory tell of a place."""
    _, _, state, views = memory.arrays
    return int(look_back(x, y, int(state["views"][0]), views[0]))


@pytest.mark.parametrize(
    ("radius", "expected"), [(4.0, FREE), (2.1, SOLID), (1.0, HIDDEN), (np.inf, NO_RETURN)]
)
@pytest.mark.parametrize("direction", [-3.1, -1.0, 0.0, 2.0, 3.1])
def test_a_view_tells_what_lies_before_at_and_behind_its_end(
    radius: float, expected: int, direction: float
) -> None:
    memory = SceneMemory()
    see(memory, ranges=beams_in_a_circle(radius))
    assert told(memory, 2.0 * math.cos(direction), 2.0 * math.sin(direction)) == expected


@given(st.integers(0, 2**31))
def test_the_quick_test_misses_no_free_place(seed: int) -> None:
    rng, memory = np.random.default_rng(seed), SceneMemory()
    for pose in rng.uniform(-1.0, 1.0, (3, 3)).tolist():
        see(memory, ranges=rng.choice([0.0, 0.7, 2.0, 5.0, np.inf], 360), pose=tuple(pose))
    _, _, state, views = memory.arrays
    count = int(state["views"][0])
    places, maybe = rng.uniform(-6.0, 6.0, (200, 2)), np.empty(200, np.bool_)
    mark_maybe_free(places[:, 0].copy(), places[:, 1].copy(), count, views[0], maybe)
    free = [told(memory, x, y) == FREE for x, y in places.tolist()]
    assert maybe[free].all()
    assert not maybe.all()


def test_the_quick_test_passes_no_place_that_is_not_finite() -> None:
    memory = SceneMemory()
    see(memory, ranges=beams_in_a_circle(4.0))
    _, _, state, views = memory.arrays
    nowhere, maybe = np.array([np.nan, np.inf, -np.inf]), np.empty(3, np.bool_)
    mark_maybe_free(nowhere, nowhere, int(state["views"][0]), views[0], maybe)
    assert not maybe.any()


def test_a_view_tells_nothing_where_no_beam_went() -> None:
    memory = SceneMemory()
    see(memory, ranges=beams_in_a_circle(4.0)[:180])
    assert told(memory, 0.0, 2.0) == UNSEEN
    assert told(memory, 0.0, -2.0) == FREE


def test_what_stands_where_a_view_passed_is_no_wall_unless_it_is_long() -> None:
    memory = SceneMemory()
    see(memory, ranges=beams_that_end_at(4.0))
    see(memory, walls=[SHORT], ranges=beams_that_end_at(2.0), scans=5)
    assert memory.size[0] == 0
    see(memory, walls=[LONG], ranges=beams_that_end_at(2.0), scans=5)
    assert memory.size[0] == 1


def test_what_comes_out_from_behind_something_is_no_wall_before_a_view_has_shown_it() -> None:
    memory = SceneMemory()
    see(memory, ranges=beams_that_end_at(1.0))
    see(memory, walls=[SHORT], ranges=beams_that_end_at(2.0), scans=3)
    assert memory.size[0] == 0
    see(memory, walls=[SHORT], ranges=beams_that_end_at(2.0), scans=8)
    assert memory.size[0] == 1


def a_wall_with_an_open_end() -> FloatArray:
    """The ranges of a scan that meets `IN_LINE` left of x = 0.5, and sees far right of it."""
    ranges = beams_that_end_at(2.0)
    ranges[180 : 180 + round(math.degrees(math.atan2(2.0, 0.5)))] = 6.0
    return ranges


@pytest.mark.parametrize("before", [True, False])
def test_whoever_stood_in_line_with_a_long_wall_is_no_part_of_it(before: bool) -> None:
    memory = SceneMemory()
    if before:
        see(memory, ranges=a_wall_with_an_open_end())
        see(memory, walls=[IN_LINE], ranges=beams_that_end_at(2.0), scans=3)
    else:
        see(memory, walls=[IN_LINE], ranges=beams_that_end_at(2.0), scans=3)
        assert widest(memory) == pytest.approx(1.0)
        see(memory, ranges=a_wall_with_an_open_end(), scans=VIEW_PERIOD)
    assert 0.4 < widest(memory) < 0.75


def test_a_long_wall_is_cut_where_views_pass_although_its_end_touches_another() -> None:
    memory = SceneMemory()
    touching = 180 + round(math.degrees(math.atan2(2.0, 0.85)))
    ranges = beams_that_end_at(2.0)
    ranges[touching:276] = 6.0
    see(memory, walls=[(1.0, 2.0, -3.0, 2.0)], ranges=beams_that_end_at(2.0), scans=3)
    see(memory, ranges=ranges, scans=VIEW_PERIOD)
    assert widest(memory) < 0.5


def test_a_robot_that_stands_beside_its_newest_view_sees_that_somebody_has_gone() -> None:
    memory = SceneMemory()
    see(memory, doors=[GAP], ranges=beams_that_end_at(2.0), scans=3)
    beside = 0.0, 3.0 * STANDING_DISTANCE, 0.0
    see(memory, ranges=beams_that_end_at(4.0), pose=beside, scans=VIEW_PATIENCE + VIEW_PERIOD)
    assert memory.size[1] == 0


def widest(memory: SceneMemory) -> float:
    """The largest x that a wall of the memory reaches."""
    return max(max(wall.start[0], wall.end[0]) for wall in memory.scene().walls)


def test_a_gap_beside_what_stands_where_a_view_passed_is_no_door() -> None:
    memory = SceneMemory()
    see(memory, ranges=beams_that_end_at(4.0))
    see(memory, doors=[GAP], ranges=beams_that_end_at(4.0), scans=9)
    assert memory.size[1] == 0


def test_a_door_is_forgotten_when_its_jamb_is_gone() -> None:
    memory = SceneMemory()
    see(memory, doors=[GAP], ranges=beams_that_end_at(2.0), scans=3)
    assert memory.size[1] == 1
    see(memory, ranges=beams_that_end_at(4.0), scans=8)
    assert memory.size[1] == 0


def test_a_door_that_is_filled_where_a_view_passed_stays_a_door() -> None:
    memory = SceneMemory()
    looks = beams_that_end_at(2.0)
    looks[256:285] = beams_that_end_at(4.0)[256:285]
    see(memory, doors=[GAP], ranges=looks, scans=9)
    see(memory, ranges=beams_that_end_at(2.0), scans=200)
    assert memory.size[1] == 1


def test_views_are_forgotten_after_a_few_metres() -> None:
    memory = SceneMemory()
    see(memory, ranges=beams_that_end_at(4.0))
    for k in range(1, VIEWS + 1):
        assert told(memory, 0.0, 2.0) == FREE
        see(memory, pose=(1.01 * k * VIEW_SPACING, 0.0, 0.0))
    assert told(memory, 0.0, 2.0) == UNSEEN


def test_a_view_from_a_turned_robot_is_the_same_view() -> None:
    turned, straight = SceneMemory(), SceneMemory()
    see(straight, ranges=beams_in_a_circle(4.0)[:270])
    see(turned, ranges=np.roll(beams_in_a_circle(4.0)[:270], 0), pose=(0.0, 0.0, 1.0))
    angle = ANGLES[0] + 0.1
    assert told(straight, math.cos(angle), math.sin(angle)) == FREE
    assert told(turned, math.cos(angle + 1.0), math.sin(angle + 1.0)) == FREE
    assert told(turned, math.cos(angle), math.sin(angle)) == UNSEEN
