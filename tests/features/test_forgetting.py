"""What a memory of scenes gives up, and what it keeps for want of proof."""

from __future__ import annotations

import numpy as np
import pytest

from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.past_views import VIEWS
from semnav_features.memory import MAX_DOORS, MAX_WALLS, SceneMemory
from semnav_features.scan import Scan
from semnav_features.scene import Scene
from tests.support.remembering import (
    ANGLES,
    DOOR_A,
    DOOR_B,
    NOTHING,
    WALL_A,
    Ends,
    beams_that_end_at,
    see,
)

AHEAD: Ends = (-0.5, 2.0, 0.5, 2.0)


def test_a_filled_door_is_forgotten_and_comes_back() -> None:
    memory = SceneMemory()
    see(memory, doors=[AHEAD], scans=20)
    see(memory, ranges=beams_that_end_at(2.0), scans=12)
    assert memory.size[1] == 0
    see(memory, doors=[AHEAD], scans=9)
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
def test_a_scan_without_a_view_is_no_evidence_on_a_door(ranges: FloatArray) -> None:
    memory = SceneMemory()
    see(memory, doors=[AHEAD], scans=4)
    see(memory, ranges=ranges, scans=20)
    assert memory.size[1] == 1


@pytest.mark.parametrize(
    "pose",
    [(0.0, -3.0, 0.0), (0.0, 1.8, 0.0), (6.0, 0.5, 0.0)],
    ids=["too far", "in the doorway", "too flat"],
)
def test_only_a_good_view_speaks_against_a_door(pose: Pose) -> None:
    memory = SceneMemory()
    see(memory, doors=[AHEAD], scans=4)
    see(memory, pose=pose, scans=20)
    assert memory.size[1] == 1


@pytest.mark.parametrize(
    ("pose", "kept"),
    [((0.0, 0.0, 0.0), 0), ((0.0, 1.7, 0.0), 1), ((3.5, 1.2, 0.0), 1), ((3.5, 0.0, 0.0), 0)],
    ids=["square", "in the doorway", "along the wall", "at an angle"],
)
def test_a_view_along_its_wall_keeps_a_door_whose_jambs_it_passes(pose: Pose, kept: int) -> None:
    memory = SceneMemory()
    see(memory, doors=[AHEAD], scans=4)
    see(memory, ranges=np.full(360, 9.0), pose=pose)
    assert memory.size[1] == kept


@pytest.mark.parametrize("hidden", [slice(0, 255), slice(286, 360)], ids=["right", "left"])
def test_a_view_of_one_side_is_no_evidence_on_a_door(
    hidden: slice,
) -> None:
    """Beams of one degree: the opening spans 76 to 104 degrees, beams 256 to 284."""
    looks = beams_that_end_at(2.0)
    looks[256:285] = beams_that_end_at(4.0)[256:285]
    for ranges in (looks, looks[:286]):
        memory = SceneMemory()
        see(memory, doors=[AHEAD], scans=4)
        seen = ranges.copy()
        seen[hidden] = 0.5
        see(memory, ranges=seen, scans=40)
        assert memory.size[1] == 1


WALL_AHEAD: Ends = (0.5, 2.0, -0.5, 2.0)


def test_a_wall_seen_through_is_forgotten_and_comes_back_when_the_robot_has_driven_on() -> None:
    memory = SceneMemory()
    see(memory, walls=[WALL_AHEAD], scans=200)
    see(memory, ranges=beams_that_end_at(3.0), scans=40)
    assert memory.size[0] == 0
    for k in range(VIEWS + 1):
        see(memory, walls=[WALL_AHEAD], pose=(1.0 * k, 0.0, 0.0), scans=3)
        assert memory.size[0] == (k >= VIEWS)


@pytest.mark.parametrize(
    "ranges",
    [beams_that_end_at(1.0), beams_that_end_at(2.3), NOTHING, np.full(360, np.nan)],
    ids=["hidden", "drifted", "no return", "nan"],
)
def test_a_scan_without_a_view_is_no_evidence_on_a_wall(ranges: FloatArray) -> None:
    memory = SceneMemory()
    see(memory, walls=[WALL_AHEAD], scans=4)
    see(memory, ranges=ranges, scans=80)
    assert memory.size[0] == 1


def test_a_long_wall_is_given_up_by_those_who_pass_close_to_it() -> None:
    """Of a wall of 12 m they see but a quarter in good view."""
    memory = SceneMemory()
    see(memory, walls=[(6.0, 0.8, -6.0, 0.8)], scans=3)
    see(memory, ranges=beams_that_end_at(2.0), scans=40)
    assert memory.size == (0, 0)


def test_a_view_through_a_doorway_keeps_a_long_wall() -> None:
    memory = SceneMemory()
    see(memory, walls=[(6.0, 0.8, -6.0, 0.8)], scans=3)
    at_wall, behind = beams_that_end_at(0.8), beams_that_end_at(5.0)
    angles = ANGLES[0] + ANGLES[1] * np.arange(360)
    through = np.abs(np.cos(angles)) * 0.8 < 0.5 * np.sin(angles)
    ranges = np.where(through, behind, at_wall)
    see(memory, ranges=ranges, scans=40)
    assert memory.size == (1, 0)


def test_a_full_memory_forgets_what_was_seen_least() -> None:
    memory = SceneMemory()
    see(memory, [WALL_A], [DOOR_A], scans=5)
    for k in range(MAX_WALLS + 10):
        x = 10.0 + 5.0 * k
        see(memory, [(x, 0.0, x + 1.0, 0.0)], [(x, 3.0, x + 1.0, 3.0)])
    see(memory, [(-9.0, 0.0, -8.0, 0.0)], [DOOR_B], scans=3)
    scene = memory.scene()
    assert memory.size == (2, 2)
    assert scene.doors[0].start == pytest.approx(DOOR_A[:2])
    used = memory.arrays[2][0]
    assert (used["walls"], used["doors"]) == (MAX_WALLS, MAX_DOORS)


CODES = [np.nan, np.inf, 0.0, -1.0, 10.0, 81.83]
"""What drivers write for a beam without a return."""


def scan_of(ranges: FloatArray, code: float) -> Scan:
    """One degree a beam, with a code for what is no return."""
    return Scan(np.where(np.isfinite(ranges), ranges, code), *ANGLES, range_max=10.0)


@pytest.mark.parametrize("code", CODES)
def test_beams_without_return_never_speak_against_a_wall(code: float) -> None:
    memory = SceneMemory()
    see(memory, walls=[WALL_AHEAD], scans=4)
    for _ in range(80):
        memory.see(Scene(), scan_of(NOTHING, code), (0.0, 0.0, 0.0))
    assert memory.size[0] == 1


@pytest.mark.parametrize("code", CODES)
def test_a_door_through_which_beams_find_nothing_is_given_up(code: float) -> None:
    beyond = beams_that_end_at(2.0)
    beyond[256:285] = np.inf
    memory = SceneMemory()
    see(memory, doors=[AHEAD], scans=4)
    for _ in range(40):
        memory.see(Scene(), scan_of(beyond, code), (0.0, 0.0, 0.0))
    assert memory.size[1] == 0
