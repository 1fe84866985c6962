"""The study of detectors in point clouds: its scenes, and how it judges."""

import math

import numpy as np
import pytest

from semnav_features.clouds import DetectedDoor, find_shut_door
from semnav_features.clouds.detected_door import frame_of
from semnav_features.elements import Door
from semnav_features.frames import points_to_local
from studies.clouds import detectors
from studies.clouds.detectors import SIGMA, judge
from studies.clouds.scenes import POSES, SHUT, draw_scenes


@pytest.mark.parametrize("category", POSES)
def test_scenes_are_drawn_again_alike_about_the_poses_of_the_thesis(category):
    first, again = (list(draw_scenes(category, 4, 5)) for _ in range(2))
    for k, (one, other) in enumerate(zip(first, again, strict=True)):
        assert (one.pose, one.believed, one.seed) == (other.pose, other.believed, other.seed)
        name, planned = POSES[category][k % len(POSES[category])]
        assert one.door.name == name
        assert math.dist(one.pose[:2], planned[:2]) < 0.25


def test_jambs_are_right_within_ten_centimetres_only():
    scene = next(draw_scenes("A", 1, 5))
    view, truth = detectors.spot(scene), scene.truth
    for shift, right in ((0.09, True), (0.11, False)):
        start = truth.start[0] + shift, truth.start[1]
        result = judge(scene, view, lambda *_, at=start: DetectedDoor(at, truth.end))
        assert result.right == (right, True)
        assert result.wrong == (not right, False)


def test_a_jamb_that_was_not_seen_is_neither_right_nor_wrong():
    scene = next(draw_scenes("A", 1, 5))
    door = DetectedDoor(scene.truth.start, (9.0, 9.0), end_seen=False)
    result = judge(scene, detectors.spot(scene), lambda *_: door)
    assert (result.right, result.wrong) == ((True, False), (False, False))
    assert len(result.errors) == 1


def test_before_the_door_the_finder_finds_both_jambs():
    found = [judge(s, detectors.spot(s), detectors.finder) for s in draw_scenes("A", 6, 5)]
    assert sum(sum(result.right) for result in found) >= 11


def test_cameras_see_through_a_shut_door_of_glass_and_not_of_wood():
    """Behind the wall line is what lies in the room."""
    behind = {}
    for kind in SHUT:
        scene = next(draw_scenes(kind, 1, 5))
        frame = frame_of(scene.truth)
        points = points_to_local(frame, scene.hits.cloud.points_robot[:, :2])
        inside = np.abs(points[:, 0]) < scene.door.width / 2 - 0.2
        side = math.copysign(1.0, points_to_local(frame, np.zeros((1, 2)))[0, 1])
        behind[kind] = np.count_nonzero(inside & (-side * points[:, 1] > 0.3))
    assert behind["glass"] > 5 * (behind["wood"] + 1)


def test_a_shut_door_is_found_by_its_frame_and_none_on_the_wall_beside():
    """The leaf lies 6 cm behind the front of the frame."""
    found = beside = 0
    for scene in draw_scenes("wood", 8, 5):
        cloud, (x1, y1), (x2, y2) = scene.hits.cloud, scene.truth.start, scene.truth.end
        door = find_shut_door(cloud, scene.truth, SIGMA)
        if door is not None:
            ends = math.dist(door.start, (x1, y1)), math.dist(door.end, (x2, y2))
            found += max(ends) <= 0.1
        dx, dy = 1.6 * (x2 - x1), 1.6 * (y2 - y1)
        wall = Door((x1 + dx, y1 + dy), (x2 + dx, y2 + dy))
        beside += find_shut_door(cloud, wall, 0.05) is not None
    assert found >= 3
    assert beside == 0
