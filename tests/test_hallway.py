"""A hallway's axis, sides, end and junctions, on scenes made by hand and on the bundled plans."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.features.frames import Pose, compose, wrap_angle
from semnav_env.features.hallway import Hallway, doorway_at, hallway
from semnav_env.features.scene import Door, Scene, Wall
from semnav_env.maps import load_floor_plan
from tests.hand_made import (
    L_LEFT,
    L_RIGHT,
    ROOM,
    SIDE_ARMS,
    T_JUNCTION,
    X_JUNCTION,
    box,
    corridor,
    polyline,
)

START: Pose = (0.0, 0.0, 0.0)

# No probe shall meet the very end of a wall: the walls end at full tenths of a metre.
xs = st.floats(-1.0, 1.0).filter(lambda x: abs(10.0 * x - round(10.0 * x)) > 1e-6)
starts = st.tuples(xs, st.floats(-0.4, 0.4), st.floats(-0.5, 0.5))
frames = st.tuples(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0), st.floats(-math.pi, math.pi))
scenes = st.sampled_from(
    [corridor(left=(3, 6), right=(4,)), T_JUNCTION, L_LEFT, X_JUNCTION, SIDE_ARMS, ROOM]
)


def ways_on(seen: Hallway) -> list[tuple[bool, bool, bool]]:
    """For each junction: does it open left, right, and go on ahead?"""
    return [(j.left is not None, j.right is not None, j.ahead) for j in seen.junctions]


def with_walls(scene: Scene, *walls: Wall) -> Scene:
    return Scene(scene.walls + walls, scene.doors)


def mirrored(scene: Scene) -> Scene:
    walls = tuple(Wall((w.start[0], -w.start[1]), (w.end[0], -w.end[1])) for w in scene.walls)
    doors = tuple(Door((d.start[0], -d.start[1]), (d.end[0], -d.end[1])) for d in scene.doors)
    return Scene(walls, doors)


@given(scene=scenes, start=starts, frame=frames)
def test_moving_scene_and_pose_moves_the_hallway(scene: Scene, start: Pose, frame: Pose) -> None:
    here, there = hallway(scene, start), hallway(scene.placed(frame), compose(frame, start))
    expected = compose(frame, here.frame)
    assert math.dist(expected[:2], there.frame[:2]) < 1e-6
    assert abs(wrap_angle(expected[2] - there.frame[2])) < 1e-6
    assert there.end == pytest.approx(here.end, abs=0.12)
    assert ways_on(here) == ways_on(there)


@given(scene=scenes, start=starts)
def test_mirroring_the_scene_swaps_left_and_right(scene: Scene, start: Pose) -> None:
    seen = hallway(scene, start)
    other = hallway(mirrored(scene), (start[0], -start[1], -start[2]))
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
    seen, again = hallway(scene, start), hallway(with_walls(scene, hidden), start)
    assert seen.frame == pytest.approx(again.frame, abs=1e-9)
    assert seen.end == pytest.approx(again.end)
    assert seen.junctions == again.junctions
    assert np.allclose(seen.left, again.left)


@given(scene=scenes, start=starts)
def test_the_axis_lies_in_the_middle_whatever_the_start(scene: Scene, start: Pose) -> None:
    seen = hallway(scene, start)
    assert seen.frame[1] == pytest.approx(0.0, abs=0.05)
    assert seen.frame[2] == pytest.approx(0.0, abs=0.02)


@pytest.mark.parametrize(
    ("scene", "expected"),
    [
        (corridor(), []),
        (corridor(left=(3, 6), right=(3, 6)), []),
        (X_JUNCTION, [(True, True, True)]),
        (T_JUNCTION, [(True, True, False)]),
        (L_LEFT, [(True, False, False)]),
        (L_RIGHT, [(False, True, False)]),
        (SIDE_ARMS, [(True, False, True), (False, True, True)]),
        (ROOM, []),
    ],
    ids=["straight", "doors", "X", "T", "L left", "L right", "side arms", "room"],
)
def test_junctions_and_where_they_lead(
    scene: Scene, expected: list[tuple[bool, bool, bool]]
) -> None:
    assert ways_on(hallway(scene, START)) == expected


def test_only_a_bend_is_a_corner() -> None:
    corners = [hallway(s, START).junctions[0].is_corner for s in (L_LEFT, L_RIGHT, T_JUNCTION)]
    assert corners == [True, True, False]
    assert not hallway(X_JUNCTION, START).junctions[0].is_corner


def test_an_opening_is_found_to_within_one_probe() -> None:
    left, right = (junction.openings[0] for junction in hallway(SIDE_ARMS, START).junctions)
    assert (left.left, right.left) == (True, False)
    assert (left.near, left.far) == pytest.approx((3.0, 5.0), abs=0.06)
    assert (right.near, right.far) == pytest.approx((8.0, 10.0), abs=0.06)
    assert left.offset == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize(
    "extra",
    [
        box(4.0, 0.7, 4.4, 1.0),
        box(4.0, 0.5, 5.2, 1.0),
        box(4.0, -0.15, 4.3, 0.15),
        [Wall((5.0, 1.0), (5.6, 0.3))],
        [Wall((5.0, -1.0), (5.0, -0.2))],
    ],
    ids=["pillar", "cabinet", "pillar in the middle", "half-open leaf", "open leaf"],
)
def test_what_stands_in_a_hallway_neither_ends_nor_opens_it(extra: list[Wall]) -> None:
    seen = hallway(corridor(left=(8,), right=(9,), extra=extra, half=1.1), START)
    assert seen.junctions == ()
    assert seen.end == pytest.approx(14.0)
    assert seen.frame[1] == pytest.approx(0.0, abs=0.05)


def test_a_recess_belongs_to_the_side() -> None:
    scene = corridor(left_arms=[(4.0, 6.0)])
    recess = with_walls(scene, Wall((4.0, 2.0), (6.0, 2.0)))
    assert ways_on(hallway(scene, START)) == [(True, False, True)]
    seen = hallway(recess, START)
    assert seen.junctions == ()
    assert seen.side_at(True, 5.0) == pytest.approx(2.0)


def test_a_gap_that_no_wall_leads_out_of_is_unseen_and_no_opening() -> None:
    walls = tuple(w for w in X_JUNCTION.walls if not (6.0 <= w.start[0] == w.end[0] <= 8.0))
    seen = hallway(Scene(walls), START)
    assert seen.junctions == ()
    assert seen.unseen(True, 0.0, 10.0) == pytest.approx(6.0, abs=0.1)
    assert math.isinf(seen.unseen(True, 8.1, 12.0))


@pytest.mark.parametrize("tilt", [-0.03, 0.0, 0.03])
def test_a_long_wall_across_the_end_leads_out_though_it_is_a_little_askew(tilt: float) -> None:
    """Odometry drifts; and with doors close to both near corners only that wall tells of arms."""
    sides = polyline((-3.0, 1.0), (8.0, 1.0), (8.0, 1.3)) + polyline((-3.0, -1.0), (8.0, -1.0))
    across = Wall((10.0 - 20.0 * tilt, -20.0), (10.0 + 20.0 * tilt, 20.0))
    seen = hallway(Scene((*sides, across), ()), START)
    assert ways_on(seen) == [(True, True, False)]


@pytest.mark.parametrize(("offset", "leads"), [(0.3, True), (3.0, False)])
def test_a_door_close_to_the_corner_leads_out_as_the_wall_does(offset: float, leads: bool) -> None:
    sides = polyline((-3.0, 1.0), (6.0, 1.0), (6.0, 1.3))
    sides += polyline((8.0, 1.0), (14.0, 1.0), (14.0, -1.0), (-3.0, -1.0))
    door = Door((6.0, 1.0 + offset), (6.0, 2.0 + offset))
    seen = hallway(Scene(tuple(sides), (door,)), START)
    assert ways_on(seen) == ([(True, False, True)] if leads else [])


@pytest.mark.parametrize("edges", ["near", "far", "both"])
@pytest.mark.parametrize(("width", "narrow"), [(1.3, True), (1.55, False)])
def test_a_narrow_opening_needs_walls_that_lead_out_of_both_edges(
    width: float, narrow: bool, edges: str
) -> None:
    far = 6.05 + width
    sides = polyline((-3.0, 1.0), (6.05, 1.0))
    sides += polyline((far, 1.0), (14.0, 1.0), (14.0, -1.0), (-3.0, -1.0))
    out = {"near": (6.05,), "far": (far,), "both": (6.05, far)}[edges]
    walls = tuple(Wall((x, 1.0), (x, 5.0)) for x in out)
    seen = hallway(Scene((*sides, *walls)), START)
    assert ways_on(seen) == ([] if narrow and edges != "both" else [(True, False, True)])


@pytest.mark.parametrize("seed", [2000006, 1000022])
def test_the_wall_of_the_doorway_that_one_stands_in_does_not_end_the_way_out(seed: int) -> None:
    """Open leaves turn the axis a little, so that half of that wall lies ahead of x = 0."""
    plan = load_floor_plan(f"office:large:{seed}")
    for door in plan.doors:
        dx, dy = door.end[0] - door.start[0], door.end[1] - door.start[1]
        out = (*door.midpoint, math.atan2(dx, -dy))
        ends = [hallway(plan.scene, compose(out, (0.0, 0.0, turn))).end for turn in (0.0, math.pi)]
        assert min(ends) > 0.3, door.name


def test_an_opening_is_not_unseen() -> None:
    seen = hallway(SIDE_ARMS, START)
    assert math.isinf(seen.unseen(True, 0.0, 13.0))
    assert math.isinf(seen.unseen(False, 0.0, 13.0))


def test_a_door_gap_that_is_not_known_as_a_door_is_unseen() -> None:
    scene = corridor(left=(3.0,), right=(5.0,))
    seen = hallway(Scene(scene.walls, scene.doors[1:]), START)
    assert seen.unseen(True, 0.0, 13.0) == pytest.approx(2.6, abs=0.1)
    assert seen.junctions == ()


@pytest.mark.parametrize(("length", "start"), [(14.0, 0.0), (9.0, 0.0), (14.0, 8.0)])
def test_the_end_is_the_wall_ahead(length: float, start: float) -> None:
    seen = hallway(corridor(length=length), (start, 0.2, 0.1))
    assert seen.place(seen.end)[0] == pytest.approx(length, abs=0.02)


def test_a_door_across_the_hallway_ends_it() -> None:
    assert hallway(corridor(end_door=True), START).end == pytest.approx(14.0)


def test_an_end_that_is_not_seen_is_infinite() -> None:
    walls = tuple(w for w in corridor().walls if w.start[0] != 14.0 or w.end[0] != 14.0)
    assert math.isinf(hallway(Scene(walls), START).end)


def test_a_misread_side_wall_does_not_end_the_hallway() -> None:
    slanted = Wall((3.0, -1.0), (12.0, 1.0))
    assert hallway(with_walls(corridor(), slanted), START).end == pytest.approx(14.0)


def test_nothing_seen_is_a_hallway_straight_ahead_without_end() -> None:
    pose = (3.0, -2.0, 2.5)
    seen = hallway(Scene(), pose)
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
    assert hallway(ROOM, outside).end == pytest.approx(6.0 + off, abs=0.02)
    assert hallway(ROOM, (5.0, 0.0, math.pi)).end == pytest.approx(1.0, abs=0.02)


def test_the_heidelberg_hallway_has_one_arm_to_the_left() -> None:
    scene = load_floor_plan("heidelberg_hallway").scene
    seen = hallway(scene, (-2.5, -0.3, 0.24))
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
    seen = hallway(load_floor_plan("office_cross").scene, pose)
    assert ways_on(seen) == expected
    assert seen.end == pytest.approx(end, abs=0.05)


@pytest.mark.parametrize("x", [-0.9, 0.0, 0.9])
def test_a_robot_in_a_junction_looks_along_the_hallway_that_leads_on(x: float) -> None:
    walls = polyline((1.0, -6.0), (1.0, -0.5), (9.0, -0.5), (9.0, 0.5), (-1.0, 0.5), (-1.0, -6.0))
    seen = hallway(Scene((*walls, Wall((-1.0, -6.0), (1.0, -6.0)))), (x, 0.1, 0.0))
    assert seen.frame[1] == pytest.approx(0.0, abs=0.1)
    assert seen.place(seen.end)[0] == pytest.approx(9.0)


@pytest.mark.parametrize("slant", [-0.1, 0.0, 0.1])
def test_an_arm_that_leads_off_at_an_angle_is_an_opening(slant: float) -> None:
    half, deep = 1.0, 3.2
    walls = [
        Wall((-3.0, half), (5.0, half)),
        Wall((5.0, half), (5.0 + slant * (deep - half), deep)),
        Wall((7.0, half), (7.0 + slant * (deep - half), deep)),
        *polyline((7.0, half), (12.0, half), (12.0, -half), (-3.0, -half)),
    ]
    (junction,) = hallway(Scene(tuple(walls)), START).junctions
    assert junction.left is not None
    assert junction.left.offset == pytest.approx(half)
    assert (junction.left.near, junction.left.far) == pytest.approx((5.0, 7.0), abs=0.26)
