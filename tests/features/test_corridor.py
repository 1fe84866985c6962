"""A corridor's axis, sides and end, on scenes made by hand and on the bundled plans."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.world.maps import load_floor_plan
from semnav_features.corridor import corridor_at, doorway_at
from semnav_features.frames import Pose, compose, wrap_angle
from semnav_features.scene import Door, Scene, Wall
from tests.support.corridors import START, ways_on, with_walls
from tests.support.hand_made import L_LEFT, ROOM, SIDE_ARMS, T_JUNCTION, X_JUNCTION, corridor

# No probe shall meet the very end of a wall: the walls end at full tenths of a metre.
xs = st.floats(-1.0, 1.0).filter(lambda x: abs(10.0 * x - round(10.0 * x)) > 1e-6)
starts = st.tuples(xs, st.floats(-0.4, 0.4), st.floats(-0.5, 0.5))
frames = st.tuples(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0), st.floats(-math.pi, math.pi))
scenes = st.sampled_from(
    [corridor(left=(3, 6), right=(4,)), T_JUNCTION, L_LEFT, X_JUNCTION, SIDE_ARMS, ROOM]
)


def mirrored(scene: Scene) -> Scene:
    walls = tuple(Wall((w.start[0], -w.start[1]), (w.end[0], -w.end[1])) for w in scene.walls)
    doors = tuple(Door((d.start[0], -d.start[1]), (d.end[0], -d.end[1])) for d in scene.doors)
    return Scene(walls, doors)


@given(scene=scenes, start=starts, frame=frames)
def test_moving_scene_and_pose_moves_the_hallway(scene: Scene, start: Pose, frame: Pose) -> None:
    here, there = corridor_at(scene, start), corridor_at(scene.placed(frame), compose(frame, start))
    expected = compose(frame, here.frame)
    assert math.dist(expected[:2], there.frame[:2]) < 1e-6
    assert abs(wrap_angle(expected[2] - there.frame[2])) < 1e-6
    assert there.end == pytest.approx(here.end, abs=0.12)
    assert ways_on(here) == ways_on(there)


@given(scene=scenes, start=starts)
def test_mirroring_the_scene_swaps_left_and_right(scene: Scene, start: Pose) -> None:
    seen = corridor_at(scene, start)
    other = corridor_at(mirrored(scene), (start[0], -start[1], -start[2]))
    assert [(r, left, on) for left, r, on in ways_on(seen)] == ways_on(other)
    assert other.frame[1] == pytest.approx(-seen.frame[1], abs=1e-6)
    assert np.allclose(seen.left, other.right, atol=1e-6)


@given(
    scene=st.sampled_from([corridor(left=(3, 6), right=(4,)), ROOM]),
    start=starts,
    angle=st.floats(0.0, math.pi),
    place=st.tuples(st.floats(-8.0, 20.0), st.sampled_from([-7.0, -4.0, 4.0, 7.0])),
)
def test_walls_behind_other_walls_change_nothing(
    scene: Scene, start: Pose, angle: float, place: tuple[float, float]
) -> None:
    dx, dy = math.cos(angle), math.sin(angle)
    hidden = Wall((place[0] - dx, place[1] - dy), (place[0] + dx, place[1] + dy))
    seen, again = corridor_at(scene, start), corridor_at(with_walls(scene, hidden), start)
    assert seen.frame == pytest.approx(again.frame, abs=1e-9)
    assert seen.end == pytest.approx(again.end)
    assert seen.junctions == again.junctions
    assert np.allclose(seen.left, again.left)


@given(scene=scenes, start=starts)
def test_the_axis_lies_in_the_middle_whatever_the_start(scene: Scene, start: Pose) -> None:
    seen = corridor_at(scene, start)
    assert seen.frame[1] == pytest.approx(0.0, abs=0.05)
    assert seen.frame[2] == pytest.approx(0.0, abs=0.02)


@pytest.mark.parametrize("seed", [2000006, 1000022])
def test_the_wall_of_the_own_doorway_ends_no_corridor(seed: int) -> None:
    """Open leaves turn the axis a little, so that half of that wall lies ahead of x = 0."""
    plan = load_floor_plan(f"office:large:{seed}")
    for door in plan.doors:
        dx, dy = door.end[0] - door.start[0], door.end[1] - door.start[1]
        out = (*door.midpoint, math.atan2(dx, -dy))
        ends = [
            corridor_at(plan.scene, compose(out, (0.0, 0.0, turn))).end for turn in (0.0, math.pi)
        ]
        assert min(ends) > 0.3, door.name


def test_an_opening_is_not_unseen() -> None:
    seen = corridor_at(SIDE_ARMS, START)
    assert math.isinf(seen.unseen(True, 0.0, 13.0))
    assert math.isinf(seen.unseen(False, 0.0, 13.0))


def test_a_door_gap_that_is_not_known_as_a_door_is_unseen() -> None:
    scene = corridor(left=(3.0,), right=(5.0,))
    seen = corridor_at(Scene(scene.walls, scene.doors[1:]), START)
    assert seen.unseen(True, 0.0, 13.0) == pytest.approx(2.6, abs=0.1)
    assert seen.junctions == ()


@pytest.mark.parametrize(("length", "start"), [(14.0, 0.0), (9.0, 0.0), (14.0, 8.0)])
def test_the_end_is_the_wall_ahead(length: float, start: float) -> None:
    seen = corridor_at(corridor(length=length), (start, 0.2, 0.1))
    assert seen.place(seen.end)[0] == pytest.approx(length, abs=0.02)


def test_a_door_across_the_hallway_ends_it() -> None:
    assert corridor_at(corridor(end_door=True), START).end == pytest.approx(14.0)


def test_an_end_that_is_not_seen_is_infinite() -> None:
    walls = tuple(w for w in corridor().walls if w.start[0] != 14.0 or w.end[0] != 14.0)
    assert math.isinf(corridor_at(Scene(walls), START).end)


def test_a_misread_side_wall_does_not_end_the_hallway() -> None:
    slanted = Wall((3.0, -1.0), (12.0, 1.0))
    assert corridor_at(with_walls(corridor(), slanted), START).end == pytest.approx(14.0)


def test_nothing_seen_is_a_hallway_straight_ahead_without_end() -> None:
    pose = (3.0, -2.0, 2.5)
    seen = corridor_at(Scene(), pose)
    assert seen.frame == pytest.approx(pose)
    assert math.isinf(seen.end)
    assert seen.junctions == ()
    assert seen.unseen(True, 0.0, 5.0) == pytest.approx(0.0)


def test_one_stands_in_a_doorway_only_when_looking_through_it() -> None:
    scene = corridor(left=(3.0,))
    assert doorway_at(scene, (3.0, 0.9, math.pi / 2)) is scene.doors[0]
    assert doorway_at(scene, (3.0, 0.9, 0.0)) is None
    assert doorway_at(scene, (3.0, 0.2, math.pi / 2)) is None
    assert doorway_at(scene, (4.0, 0.9, math.pi / 2)) is None


@pytest.mark.parametrize("off", [-0.2, 0.0, 0.2])
def test_a_doorway_that_one_stands_in_does_not_block_the_way(off: float) -> None:
    outside = (4.0 + off, 0.1, math.pi)
    assert corridor_at(ROOM, outside).end == pytest.approx(6.0 + off, abs=0.02)
    assert corridor_at(ROOM, (5.0, 0.0, math.pi)).end == pytest.approx(1.0, abs=0.02)


def test_the_heidelberg_hallway_has_one_arm_to_the_left() -> None:
    scene = load_floor_plan("heidelberg_hallway").scene
    seen = corridor_at(scene, (-2.5, -0.3, 0.24))
    assert ways_on(seen) == [(True, False, True)]
    assert seen.frame[2] == pytest.approx(0.25, abs=0.03)
    assert seen.end == pytest.approx(11.5, abs=0.2)


@pytest.mark.parametrize(
    ("pose", "expected", "end"),
    [
        ((1.3, 9.1, 0.0), [(True, True, True)], 28.7),
        ((28.6, 9.1, math.pi), [(True, True, True)], 28.6),
        ((15.0, 1.0, math.pi / 2), [(True, True, True), (False, True, False)], 19.0),
        ((26.0, 19.1, math.pi), [(True, False, False)], 12.0),
    ],
)
def test_the_corridors_of_the_cross(
    pose: Pose, expected: list[tuple[bool, bool, bool]], end: float
) -> None:
    seen = corridor_at(load_floor_plan("office_cross").scene, pose)
    assert ways_on(seen) == expected
    assert seen.end == pytest.approx(end, abs=0.05)
