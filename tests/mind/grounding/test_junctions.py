"""A corridor's junctions: which openings of its sides count, and where they lead."""

from __future__ import annotations

import math

import pytest

from semnav_env.mind.grounding.counted_doors import doors_along
from semnav_features.corridor import corridor_at
from semnav_features.scene import Door, Scene, Wall
from tests.support.corridors import START, ways_on, with_walls
from tests.support.hand_made import (
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
    assert ways_on(corridor_at(scene, START)) == expected


def test_only_a_bend_is_a_corner() -> None:
    corners = [corridor_at(s, START).junctions[0].is_corner for s in (L_LEFT, L_RIGHT, T_JUNCTION)]
    assert corners == [True, True, False]
    assert not corridor_at(X_JUNCTION, START).junctions[0].is_corner


def test_an_opening_is_found_to_within_one_probe() -> None:
    left, right = (junction.openings[0] for junction in corridor_at(SIDE_ARMS, START).junctions)
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
def test_furniture_neither_ends_nor_opens_a_corridor(extra: list[Wall]) -> None:
    seen = corridor_at(corridor(left=(8,), right=(9,), extra=extra, half=1.1), START)
    assert seen.junctions == ()
    assert seen.end == pytest.approx(14.0)
    assert seen.frame[1] == pytest.approx(0.0, abs=0.05)


def test_a_recess_belongs_to_the_side() -> None:
    scene = corridor(left_arms=[(4.0, 6.0)])
    recess = with_walls(scene, Wall((4.0, 2.0), (6.0, 2.0)))
    assert ways_on(corridor_at(scene, START)) == [(True, False, True)]
    seen = corridor_at(recess, START)
    assert seen.junctions == ()
    assert seen.side_at(True, 5.0) == pytest.approx(2.0)


def test_a_gap_without_walls_leading_out_is_no_opening() -> None:
    walls = tuple(w for w in X_JUNCTION.walls if not (6.0 <= w.start[0] == w.end[0] <= 8.0))
    seen = corridor_at(Scene(walls), START)
    assert seen.junctions == ()
    assert seen.unseen(True, 0.0, 10.0) == pytest.approx(6.0, abs=0.1)
    assert math.isinf(seen.unseen(True, 8.1, 12.0))


@pytest.mark.parametrize("tilt", [-0.03, 0.0, 0.03])
def test_a_slightly_oblique_end_wall_leads_out(tilt: float) -> None:
    """Odometry drifts; and with doors close to both near corners only that wall tells of arms."""
    sides = polyline((-3.0, 1.0), (8.0, 1.0), (8.0, 1.3)) + polyline((-3.0, -1.0), (8.0, -1.0))
    across = Wall((10.0 - 20.0 * tilt, -20.0), (10.0 + 20.0 * tilt, 20.0))
    seen = corridor_at(Scene((*sides, across), ()), START)
    assert ways_on(seen) == [(True, True, False)]


@pytest.mark.parametrize(("offset", "leads"), [(0.3, True), (3.0, False)])
def test_a_door_close_to_the_corner_leads_out_as_the_wall_does(offset: float, leads: bool) -> None:
    sides = polyline((-3.0, 1.0), (6.0, 1.0), (6.0, 1.3))
    sides += polyline((8.0, 1.0), (14.0, 1.0), (14.0, -1.0), (-3.0, -1.0))
    door = Door((6.0, 1.0 + offset), (6.0, 2.0 + offset))
    seen = corridor_at(Scene(tuple(sides), (door,)), START)
    assert ways_on(seen) == ([(True, False, True)] if leads else [])


@pytest.mark.parametrize("edges", ["near", "far", "both"])
@pytest.mark.parametrize(("width", "narrow"), [(1.3, True), (1.55, False)])
def test_a_narrow_opening_needs_walls_at_both_edges(width: float, narrow: bool, edges: str) -> None:
    far = 6.05 + width
    sides = polyline((-3.0, 1.0), (6.05, 1.0))
    sides += polyline((far, 1.0), (14.0, 1.0), (14.0, -1.0), (-3.0, -1.0))
    out = {"near": (6.05,), "far": (far,), "both": (6.05, far)}[edges]
    walls = tuple(Wall((x, 1.0), (x, 5.0)) for x in out)
    seen = corridor_at(Scene((*sides, *walls)), START)
    assert ways_on(seen) == ([] if narrow and edges != "both" else [(True, False, True)])


def side_arm(width: float, depth: float, setback: float = 0.0) -> Scene:
    """A hall along x, 2 m wide, with a gap in its left side from x = 6 and what lies behind it.

    Args:
        width: of the gap, metres.
        depth: of the walls that lead away from it, metres.
        setback: how far outside its edges these walls lie, metres.
    """
    far = 6.0 + width
    sides = polyline((-3.0, 1.0), (6.0, 1.0)) + polyline((far, 1.0), (14.0, 1.0), (14.0, -1.0))
    walls = [Wall((x, 1.0), (x, 1.0 + depth)) for x in (6.0 - setback, far + setback)]
    return Scene((*sides, *walls, Wall((14.0, -1.0), (-3.0, -1.0))))


@pytest.mark.parametrize("width", [0.9, 1.0, 1.1, 1.2])
def test_an_arm_may_be_as_narrow_as_a_door_also_where_one_was_seen(width: float) -> None:
    """A hall that leads away between both edges is no room: the door in its mouth is none."""
    arm = side_arm(width, 3.0)
    door = Door((6.0, 1.0), (6.0 + width, 1.0), confidence=0.9)
    for scene in (arm, Scene(arm.walls, (door,))):
        assert ways_on(corridor_at(scene, START)) == [(True, False, True)]
        assert not doors_along(scene, corridor_at(scene, START))


@pytest.mark.parametrize(("depth", "setback"), [(1.5, 0.0), (3.0, 0.3)], ids=["niche", "room"])
def test_a_niche_and_a_room_wider_than_its_door_are_no_arms(depth: float, setback: float) -> None:
    behind = side_arm(1.0, depth, setback)
    door = Door((6.0, 1.0), (7.0, 1.0), confidence=0.9)
    for scene in (behind, Scene(behind.walls, (door,))):
        assert corridor_at(scene, START).junctions == ()
    assert [each.door for each in doors_along(scene, corridor_at(scene, START))] == [door]


def test_a_door_of_a_floor_plan_stays_one_before_an_arm() -> None:
    door = Door((6.0, 1.0), (7.0, 1.0), name="of the plan")
    scene = Scene(side_arm(1.0, 3.0).walls, (door,))
    assert corridor_at(scene, START).junctions == ()


@pytest.mark.parametrize(("width", "bends"), [(0.7, False), (0.9, True), (1.1, True), (1.3, True)])
@pytest.mark.parametrize("sees_near_edge", [True, False])
def test_a_hall_may_bend_into_one_as_narrow_as_a_door(
    width: float, bends: bool, sees_near_edge: bool
) -> None:
    """The wall across is enough: from before the mouth one does not see along its nearer edge."""
    sides = polyline((-3.0, 1.0), (8.0, 1.0)) + polyline((8.0 + width, -1.0), (-3.0, -1.0))
    walls = [Wall((8.0, 1.0), (8.0, 6.0))] if sees_near_edge else []
    across = Wall((8.0 + width, 6.0), (8.0 + width, -1.0))
    seen = corridor_at(Scene((*sides, *walls, across)), START)
    assert ways_on(seen) == ([(True, False, False)] if bends else [])
    assert all(junction.is_corner for junction in seen.junctions)


def test_a_gap_as_narrow_as_a_door_is_a_bend_only_at_the_very_end() -> None:
    """Before it, or where the wall across ends at the side, it may be a door that was missed."""
    sides = polyline((-3.0, 1.0), (7.5, 1.0)) + polyline((9.0, -1.0), (-3.0, -1.0))
    beyond, across = Wall((8.6, 1.0), (9.0, 1.0)), Wall((9.0, 6.0), (9.0, -1.0))
    assert ways_on(corridor_at(Scene((*sides, beyond, across)), START)) == []
    short = Wall((8.6, 1.0), (8.6, -1.0))
    assert ways_on(corridor_at(Scene((*sides, short)), START)) == []


@pytest.mark.parametrize("x", [-0.9, 0.0, 0.9])
def test_in_a_junction_the_corridor_is_the_one_that_leads_on(x: float) -> None:
    """A robot that starts there looks along the corridor that leads on."""
    walls = polyline((1.0, -6.0), (1.0, -0.5), (9.0, -0.5), (9.0, 0.5), (-1.0, 0.5), (-1.0, -6.0))
    seen = corridor_at(Scene((*walls, Wall((-1.0, -6.0), (1.0, -6.0)))), (x, 0.1, 0.0))
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
    (junction,) = corridor_at(Scene(tuple(walls)), START).junctions
    assert junction.left is not None
    assert junction.left.offset == pytest.approx(half)
    assert (junction.left.near, junction.left.far) == pytest.approx((5.0, 7.0), abs=0.26)
