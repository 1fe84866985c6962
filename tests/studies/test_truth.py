"""The truth twin against geometry that is known, the ray caster and the extractor."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from shapely import Point, union_all

from semnav_env.world.lidar.lidar import Lidar
from semnav_env.world.maps import Material, PlanDoor, Surface, bundled_names, load_floor_plan
from semnav_features import CornerKind, extract
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import TIM561
from studies.doors.door_sightings import Gate, View, matches
from studies.features.cases import draw_cases
from studies.features.overlap import Overlap
from studies.truth import TrueView, true_scene
from tests.support.small_plans import closed, empty_hall, plan_of

ALL_AROUND = LidarSpec("all_around", 720, -math.pi, math.tau / 720, range_max=20.0)
VIEWS = {name: TrueView(load_floor_plan(name)) for name in bundled_names()}
AROUND = {view: TrueView(load_floor_plan(name), ALL_AROUND) for name, view in VIEWS.items()}
SOLIDS = {name: union_all(load_floor_plan(name).solids.geometries) for name in VIEWS}


def circle(x, y, radius, edges=32):
    turns = math.tau * np.arange(edges) / edges
    return closed(*zip(x + radius * np.cos(turns), y + radius * np.sin(turns), strict=True))


@st.composite
def views(draw, names=tuple(VIEWS)):
    """A bundled plan and a pose at least 0.3 m from everything solid."""
    name = draw(st.sampled_from(names))
    west, south, east, north = load_floor_plan(name).boundary.bounds
    pose = (draw(st.floats(west, east)), draw(st.floats(south, north)), draw(st.floats(-3.1, 3.1)))
    assume(SOLIDS[name].distance(Point(pose[:2])) > 0.3)
    assume(load_floor_plan(name).boundary.contains(Point(pose[:2])))
    return VIEWS[name], pose


def test_a_room_has_its_four_walls_and_corners():
    scene = true_scene(empty_hall(8.0, 6.0), (3.0, 2.0, 0.4), ALL_AROUND)
    assert sorted(round(wall.length, 9) for wall in scene.walls) == [6.0, 6.0, 8.0, 8.0]
    assert [wall.visible for wall in scene.walls] == [1.0] * 4
    assert [corner.kind for corner in scene.corners] == [CornerKind.OUTER] * 4
    assert sum(wall.beams for wall in scene.walls) == ALL_AROUND.beams


def test_what_lies_behind_the_lidar_is_not_seen():
    spec = replace(ALL_AROUND, beams=181, angle_min=-math.pi / 2, angle_increment=math.pi / 180)
    scene = true_scene(empty_hall(8.0, 6.0), (3.0, 2.0, 0.0), spec)
    ahead, left, right = (wall for wall in sorted(scene.walls, key=lambda w: -w.length))
    assert (ahead.length, left.length, right.length) == pytest.approx((6.0, 5.0, 5.0))
    assert left.visible == pytest.approx(5.0 / 8.0)
    assert not any(w.start_break or w.start_rupture for w in (ahead, left, right))


def test_a_wall_ends_where_the_range_does():
    spec = replace(ALL_AROUND, range_max=5.0)
    scene = true_scene(empty_hall(20.0, 6.0), (10.0, 3.0, 0.0), spec)
    assert [wall.length for wall in scene.walls] == pytest.approx([8.0, 8.0])
    assert all(wall.start_rupture and wall.end_rupture for wall in scene.walls)
    assert all(wall.visible == pytest.approx(0.4) for wall in scene.walls)
    assert [corner.kind for corner in scene.corners] == [CornerKind.POTENTIAL] * 4


def test_what_stands_before_a_wall_makes_two_of_it():
    pillar = closed((4.8, 1.0), (5.2, 1.0), (5.2, 1.4), (4.8, 1.4))
    plan = plan_of(closed((0, 0), (10, 0), (10, 6), (0, 6)), pillar)
    scene = true_scene(plan, (5.0, 3.0, 0.0), ALL_AROUND)
    behind = [w for w in scene.walls if abs(w.start[1] + 3.0) < 1e-9 and abs(w.heading) < 1e-9]
    assert len(behind) == 2
    behind.sort(key=lambda wall: wall.start)
    shadow = 0.4 * 3.0 / 1.6
    assert sum(wall.visible for wall in behind) == pytest.approx(1.0 - shadow / 10.0)
    assert behind[0].end_break
    assert behind[1].start_break


def test_the_corners_of_a_pillar_are_inner_ones():
    pillar = closed((4.8, 1.0), (5.2, 1.0), (5.2, 1.4), (4.8, 1.4))
    plan = plan_of(closed((0, 0), (10, 0), (10, 6), (0, 6)), pillar)
    scene = true_scene(plan, (7.0, 3.0, 0.0), ALL_AROUND)
    inner = [c.point for c in scene.corners if c.kind is CornerKind.INNER]
    assert inner == [pytest.approx((-1.8, -1.6))]


def test_glass_is_not_seen():
    pane = Surface(((0, 4), (10, 4)), Material.GLASS)
    hall = empty_hall()
    seen = true_scene(replace(hall, surfaces=(*hall.surfaces, pane)), (5.0, 2.0, 0.3))
    assert seen == true_scene(hall, (5.0, 2.0, 0.3))


def test_a_round_column_is_an_arc():
    plan = plan_of(closed((0, 0), (10, 0), (10, 6), (0, 6)), circle(7.0, 3.0, 0.4))
    (arc,) = true_scene(plan, (4.0, 3.0, 0.0)).arcs
    assert arc.centre == pytest.approx((3.0, 0.0))
    assert arc.radius == pytest.approx(0.4)
    assert arc.convex
    assert arc.extent == pytest.approx(math.pi - 2 * math.asin(0.4 / 3.0), abs=0.2)
    assert arc.visible == pytest.approx(arc.extent / math.tau)


def test_a_curved_wall_is_hollow_from_within():
    turns = np.linspace(-0.8, 0.8, 17)
    wall = Surface(tuple(zip(3.0 * np.cos(turns), 3.0 * np.sin(turns), strict=True)))
    (arc,) = true_scene(plan_of(wall), (0.5, 0.2, 0.0)).arcs
    assert not arc.convex
    assert arc.extent == pytest.approx(1.6)
    assert arc.visible == pytest.approx(1.0)


def test_an_octagon_has_walls():
    plan = plan_of(closed((0, 0), (10, 0), (10, 6), (0, 6)), circle(7.0, 3.0, 0.4, edges=8))
    assert not true_scene(plan, (4.0, 3.0, 0.0)).arcs


def hall_with_a_door(is_open=True, *more):
    walls = [Surface(((0, 0), (4, 0))), Surface(((5, 0), (10, 0), (10, 5), (0, 5), (0, 0)))]
    room = Surface(((0, 0), (0, -4), (10, -4), (10, 0)))
    door = PlanDoor("door 1", (4.0, 0.0), (5.0, 0.0), is_open)
    return replace(plan_of(*walls, room, *more), doors=(door,))


@given(st.floats(0.5, 9.5), st.floats(0.5, 4.5), st.floats(-3.0, 3.0))
def test_an_unobstructed_door_is_seen_whole(x, y, heading):
    (door,) = true_scene(hall_with_a_door(), (x, y, heading), ALL_AROUND).doors
    assert door.name == "door 1"
    assert door.visible == pytest.approx(1.0)
    assert door.start[0] * door.end[1] - door.start[1] * door.end[0] > 0.0
    assert math.dist(door.start, door.end) == pytest.approx(1.0)


def test_a_door_shut_is_no_door():
    leaf = Surface(((4, 0), (5, 0)), Material.LEAF)
    assert not true_scene(hall_with_a_door(False, leaf), (4.5, 2.0, 0.0), ALL_AROUND).doors


def test_a_door_beyond_the_range_is_not_seen():
    far = replace(ALL_AROUND, range_max=2.0)
    near = replace(ALL_AROUND, range_max=2.01)
    assert not true_scene(hall_with_a_door(), (4.5, 2.0, 0.0), far).doors
    (door,) = true_scene(hall_with_a_door(), (4.5, 2.0, 0.0), near).doors
    assert door.visible == pytest.approx(2.0 * math.sqrt(2.01**2 - 2.0**2))


def test_a_door_half_hidden_is_half_visible():
    screen = Surface(((3.5, 1.0), (4.5, 1.0)), Material.FURNITURE)
    (door,) = true_scene(hall_with_a_door(True, screen), (4.5, 4.0, 0.0), ALL_AROUND).doors
    assert door.visible == pytest.approx(0.5)


@pytest.mark.parametrize("tip", [(4.0, 0.9), (4.6, -0.7), (4.0, -1.0)])
def test_a_leaf_is_told_by_its_hinge_and_angle(tip):
    leaf = Surface(((4.0, 0.0), tip), Material.LEAF)
    (door,) = true_scene(hall_with_a_door(True, leaf), (4.6, 2.0, 0.0), ALL_AROUND).doors
    assert door.leaf is not None
    assert door.start == pytest.approx((-0.6, -2.0))
    assert door.leaf.hinge_at_start
    assert door.leaf.angle == pytest.approx(-math.atan2(tip[1], tip[0] - 4.0))


@given(views())
@settings(max_examples=30, deadline=None)
def test_the_outline_is_what_the_ray_caster_measures(view):
    twin, pose = view
    outline, _ = twin._outline(pose)
    angles = twin.lidar.spec.angles
    clear = np.abs(angles[:, None] - outline.angles).min(axis=1) > 2e-7
    measured = twin.lidar.exact_ranges(pose)
    np.testing.assert_allclose(outline.ranges(angles)[clear], measured[clear], atol=1e-9)


@given(views())
@settings(max_examples=30, deadline=None)
def test_true_walls_have_the_lidar_on_their_left(view):
    twin, pose = view
    scene = twin.scene(pose)
    for wall in scene.walls:
        assert wall.start[0] * wall.end[1] - wall.start[1] * wall.end[0] > 0.0
        assert 0.0 < wall.visible <= 1.0
    seen = sum(wall.beams for wall in scene.walls) + sum(arc.beams for arc in scene.arcs)
    assert seen <= twin.lidar.spec.beams


@given(views())
@settings(max_examples=30, deadline=None)
def test_turning_the_robot_turns_the_truth(view):
    twin, (x, y, heading) = view
    around = AROUND[twin]
    first, second = around.scene((x, y, heading)), around.scene((x, y, heading + 0.7))
    turned = second.placed((0.0, 0.0, 0.7))

    def nearest(wall, walls):
        return min(math.dist((*wall.start, *wall.end), (*w.start, *w.end)) for w in walls)

    assert len(first.walls) == len(turned.walls)
    assert all(nearest(wall, turned.walls) < 1e-6 for wall in first.walls)


@given(views())
@settings(max_examples=40, deadline=None)
def test_a_noise_free_scan_returns_the_true_walls(view):
    """Those of 0.5 m and twenty beams that are met at 12 degrees or more, each in one piece."""
    twin, pose = view
    truth, found = twin.scene(pose).walls, extract(twin.scan(pose)).walls
    wanted = [w for w in truth if w.length >= 0.5 and w.beams >= 20 and incidence(w) >= 0.21]
    overlap = Overlap(wanted, found)
    assert (overlap.longest >= 0.9 * overlap.lengths - 0.05).all()
    back = Overlap([w for w in found if w.length >= 0.5 and w.beams >= 20], truth)
    assert (back.covered >= 0.9 * back.lengths - 0.05).all()


@given(views())
@settings(max_examples=60, deadline=None)
def test_a_noise_free_scan_returns_the_true_corners(view):
    """Those of walls of 0.5 m and twenty beams met at 12 degrees or more, to 1 % of the range."""
    twin, pose = view
    truth, found = twin.scene(pose), extract(twin.scan(pose))
    for corner in truth.corners:
        walls = [w for w in truth.walls if near(corner.point, w.start) or near(corner.point, w.end)]
        clear = all(w.length >= 0.5 and w.beams >= 20 and incidence(w) >= 0.21 for w in walls)
        if corner.kind is CornerKind.POTENTIAL or not clear:
            continue
        nearest = min(found.corners, key=lambda other: math.dist(other.point, corner.point))
        assert math.dist(nearest.point, corner.point) < 0.01 * math.hypot(*corner.point)
        assert nearest.kind is corner.kind


def near(point, other):
    return math.dist(point, other) < 1e-6


def incidence(wall):
    """The flattest angle at which a beam meets a wall."""
    (x1, y1), (x2, y2) = wall.start, wall.end
    distance = (x1 * y2 - y1 * x2) / wall.length
    return math.asin(distance / max(math.hypot(x1, y1), math.hypot(x2, y2)))


@pytest.mark.parametrize("name", sorted(VIEWS))
def test_noise_free_scans_return_nearly_all_doors_in_view(name):
    rng = np.random.default_rng(0)
    gate, doors, found = Gate(reach=5.0), 0, 0
    for case in draw_cases(load_floor_plan(name), 150, (0.0,), False, rng):
        scan = case.scans[0][1]
        seen = extract(scan).doors
        for door in case.truth.doors:
            if gate.view(scan, door.start, door.end) is View.GATED:
                doors += 1
                found += any(matches(other, door.start, door.end) for other in seen)
    assert doors > 50
    assert found >= 0.8 * doors


def test_a_mounted_lidar_sees_from_its_mount():
    plan = empty_hall()
    mounted = Lidar(plan, TIM561, (0.3, 0.0, 0.0))
    assert true_scene(plan, (5.0, 3.0, 0.0), mounted) == true_scene(plan, (5.3, 3.0, 0.0))
