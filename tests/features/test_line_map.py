"""Maps of lines: what stays in them, what proves false, and odometry by scans."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import LineString, box

from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import FloorPlan, Surface, load_floor_plan
from semnav_features import Scene, extract
from semnav_features.frames import compose
from semnav_features.mapping import KeyframeRule, LineMap, MapSettings, ScanOdometry

metres = st.floats(-5.0, 5.0)
poses = st.tuples(metres, metres, st.floats(-math.pi, math.pi))
OFFICE = load_floor_plan("office_cross")


def plan_of(*walls):
    surfaces = tuple(Surface(points) for points in walls)
    return FloorPlan("made", surfaces, (), (), (), (), box(-100.0, -100.0, 100.0, 100.0))


def mapped(plan, views, every=1, rounds=3, sigma=0.01, line_map=None):
    """A map of scans from each view in turn, `rounds` times, moved a little each time."""
    lidar = Lidar(plan, replace(Lidar(plan).spec, sigma=sigma, dropout=0.0))
    line_map = line_map or LineMap()
    for k in range(rounds):
        for i, view in enumerate(views):
            pose = compose(view, (0.0, 0.0, 0.1 * (k - 1)))
            scan = lidar.scan(pose, key=(2, k, i))
            line_map.add(extract(scan), scan, pose)
    return line_map


# Maps


def test_an_empty_map_is_empty():
    assert LineMap().scene == Scene()


def test_a_room_is_four_walls_however_many_scans_saw_it():
    room = plan_of(((-3.0, -2.0), (3.0, -2.0), (3.0, 2.0), (-3.0, 2.0), (-3.0, -2.0)))
    views = [(x, y, h) for x in (-1.5, 0.0, 1.5) for y in (-0.5, 0.5) for h in (0.0, 2.0)]
    walls = mapped(room, views).walls
    assert len(walls) == 4
    assert sum(wall.length for wall in walls) == pytest.approx(20.0, abs=0.5)


CORRIDOR = plan_of(
    ((-1.66, -2.0), (-1.66, 1.67), (-1.42, 1.67), (-1.42, 2.16), (-1.06, 2.16), (-1.06, 12.0)),
    ((1.5, -2.0), (1.5, 2.16), (0.92, 2.16), (0.92, 2.7), (0.95, 2.7), (0.95, 4.0)),
    ((1.95, 4.0), (1.95, 3.4), (3.0, 3.4)),
    ((1.03, 5.1), (1.03, 7.1)),
)
"""After the corners of Weerakoon et al., table II: a corridor with pillars and a side opening."""

THREE_POSES = ((0.0, 0.0, math.pi / 2), (0.0, 2.0, math.pi / 2), (-0.5, 4.0, 0.0))


def test_three_scans_of_a_corridor_merge_to_nine_walls():
    """Weerakoon et al., section III: from 15 segments to 9."""
    one = MapSettings(wall_hits=1)
    lidar = Lidar(CORRIDOR, replace(Lidar(CORRIDOR).spec, sigma=0.01, dropout=0.0))
    line_map, seen = LineMap(one), []
    for step, pose in enumerate(THREE_POSES):
        scan = lidar.scan(pose, key=(1, 0, step))
        scene = extract(scan)
        line_map.add(scene, scan, pose)
        seen += scene.placed(pose).walls
    merged = line_map.walls
    assert len(seen) >= 15
    assert len(merged) <= 9
    for wall in seen:  # nothing that a scan saw is lost
        near = [LineString((m.start, m.end)).buffer(0.12) for m in merged]
        line = LineString((wall.start, wall.end))
        covered = max(line.intersection(area).length for area in near)
        assert covered > 0.6 * line.length


def test_a_wall_never_crosses_an_open_door():
    gaps = plan_of(
        ((-8.0, 1.0), (-1.0, 1.0)),
        ((0.0, 1.0), (8.0, 1.0)),
        ((8.0, -1.0), (-8.0, -1.0)),
        ((-1.2, 3.0), (0.3, 3.0)),
    )
    views = [(x, 0.0, 0.3) for x in np.linspace(-4.0, 4.0, 9)]
    line_map = mapped(gaps, views)
    opening = LineString(((-0.85, 1.0), (-0.15, 1.0))).buffer(0.1)
    assert not any(opening.intersects(LineString((w.start, w.end))) for w in line_map.walls)
    assert len(line_map.doors) == 1
    assert line_map.doors[0].midpoint == pytest.approx((-0.5, 1.0), abs=0.05)
    assert line_map.doors[0].width == pytest.approx(1.0, abs=0.06)


def test_a_wall_seen_through_later_is_removed():
    walls = ((-5.0, 2.0), (5.0, 2.0)), ((5.0, -2.0), (-5.0, -2.0))
    crate = (-0.5, 1.0), (0.5, 1.0)
    views = [(x, 0.0, 1.2) for x in np.linspace(-1.0, 1.0, 5)]
    line_map = mapped(plan_of(*walls, crate), views, rounds=2)
    beside = LineString(crate).buffer(0.1)

    def there():
        return any(beside.intersects(LineString((w.start, w.end))) for w in line_map.walls)

    assert there()
    mapped(plan_of(*walls), views, rounds=4, line_map=line_map)
    assert not there()


def test_a_door_that_is_closed_later_goes():
    wall = ((-8.0, 1.0), (-1.0, 1.0)), ((0.0, 1.0), (8.0, 1.0)), ((-3.0, 4.0), (3.0, 4.0))
    views = [(x, 0.0, 0.9) for x in np.linspace(-2.0, 2.0, 9)]
    line_map = mapped(plan_of(*wall), views, rounds=2)
    assert len(line_map.doors) == 1
    mapped(plan_of(*wall, ((-1.0, 1.0), (0.0, 1.0))), views, rounds=6, line_map=line_map)
    assert not line_map.doors


def test_scans_from_one_place_count_once():
    lidar = Lidar(OFFICE)
    line_map = LineMap()
    for step in range(10):
        scan = lidar.scan((15.0, 9.1, 0.3), key=(0, 0, step))
        line_map.add(extract(scan), scan, (15.0, 9.1, 0.3))
    assert line_map.scans == 1


@settings(max_examples=10)
@given(poses)
def test_a_map_moves_with_its_frame(frame):
    lidar = Lidar(OFFICE)
    still, moved = LineMap(), LineMap()
    for step, x in enumerate(np.linspace(12.0, 18.0, 6)):
        scan = lidar.scan((x, 9.1, 0.3), key=(0, 0, step))
        scene = extract(scan)
        still.add(scene, scan, (x, 9.1, 0.3))
        moved.add(scene, scan, compose(frame, (x, 9.1, 0.3)))
    placed = still.scene.placed(frame).walls
    assert sum(w.length for w in moved.walls) == pytest.approx(
        sum(w.length for w in placed), rel=0.05
    )


def test_limits_of_a_map_are_checked():
    with pytest.raises(ValueError, match="gap is -1"):
        MapSettings(gap=-1.0)


# Odometry


def test_odometry_without_wheels_follows_a_drive():
    lidar = Lidar(OFFICE)
    odometry = ScanOdometry()
    start = (6.0, 9.1, 0.0)
    for step in range(60):
        pose = (6.0 + 0.15 * step, 9.1 + 0.3 * math.sin(0.2 * step), 0.3 * math.sin(0.1 * step))
        found = compose(start, odometry.update(lidar.scan(pose, key=(0, 0, step))))
    assert odometry.lost == 0
    assert found == pytest.approx(pose, abs=0.06)


def test_a_scan_that_shows_nothing_is_lost_and_no_more():
    lidar = Lidar(OFFICE)
    odometry = ScanOdometry()
    blind = Lidar(plan_of(((50.0, 50.0), (51.0, 50.0))))
    for step in range(10):
        pose = (10.0 + 0.1 * step, 9.1, 0.0)
        odometry.update((blind if step == 5 else lidar).scan(pose, key=(0, 0, step)))
    assert odometry.lost == 1
    assert odometry.pose == pytest.approx((0.9, 0.0, 0.0), abs=0.06)


def test_a_scan_of_another_place_is_not_believed():
    """It shows something, and some of it fits; the next ones go on as the wheels said."""
    lidar, odometry = Lidar(OFFICE), ScanOdometry()
    for step in range(10):
        seen_from = (17.0, 12.0, 1.0) if step == 5 else (8.0 + 0.1 * step, 9.1, 0.0)
        odometry.update(lidar.scan(seen_from, key=(0, 0, step)), (0.1, 0.0, 0.0) if step else None)
    assert odometry.lost == 1
    assert odometry.pose == pytest.approx((0.9, 0.0, 0.0), abs=0.06)


def test_through_a_door_the_scan_before_becomes_the_keyframe():
    """The room shows little of what the corridor did, and the other way round."""
    lidar = Lidar(OFFICE)
    poses = [(11.2, 9.1 + 0.1 * step, 0.5 * math.pi) for step in range(30)]
    odometry = ScanOdometry(rule=KeyframeRule(distance=100.0))
    for step, pose in enumerate(poses):
        found = compose(poses[0], odometry.update(lidar.scan(pose, key=(0, 0, step))))
    assert odometry.lost == 0
    assert 1 < odometry.keyframes < 20
    assert found == pytest.approx(poses[-1], abs=0.05)
