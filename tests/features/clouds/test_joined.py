"""Doors from two detectors."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_features.clouds import DetectedDoor, joined
from studies.clouds import detectors
from studies.clouds.detectors import judge
from studies.clouds.scenes import draw_scenes

SURE, UNSURE = 0.01**2 * np.eye(4), 0.04**2 * np.eye(4)
DOOR = DetectedDoor((2.0, 0.45), (2.0, -0.45), 0.9, SURE)
small = st.floats(-0.03, 0.03)


def moved(x, y, covariance=UNSURE, **seen):
    return DetectedDoor((2.0 + x, 0.45 + y), (2.0 + x, -0.45 + y), 0.5, covariance, **seen)


def test_one_detection_stays_as_it_is():
    assert joined(DOOR, None) is DOOR
    assert joined(None, DOOR) is DOOR
    assert joined(None, None) is None


@given(small, small)
def test_what_both_see_lies_between_and_is_surer(x, y):
    both = joined(DOOR, moved(x, y))
    share = 0.01**2 / (0.01**2 + 0.04**2)
    assert both.start == pytest.approx((2.0 + share * x, 0.45 + share * y))
    assert (np.diag(both.covariance) < np.diag(SURE)).all()
    assert both.confidence == 0.9


@given(small, st.booleans())
def test_a_jamb_that_one_alone_sees_is_taken_from_it(y, start):
    seen = {"start_seen": start, "end_seen": not start}
    half = DetectedDoor((2.0, 0.45), (2.0, -0.45), 0.9, SURE, **seen)
    both = joined(half, moved(0.0, y))
    assert both.is_whole
    missed = both.end if start else both.start
    assert missed[1] == pytest.approx((-0.45 if start else 0.45) + y)


@given(st.floats(0.3, 2.0))
def test_where_they_disagree_the_first_is_right(x):
    assert joined(DOOR, moved(x, 0.0)) is DOOR


def test_the_order_matters_only_where_they_disagree():
    one, other = joined(DOOR, moved(0.01, 0.02)), joined(moved(0.01, 0.02), DOOR)
    assert math.dist(one.start, other.start) < 1e-12


def test_beside_the_wall_the_lidar_sees_what_the_cameras_miss():
    """Category D of Mes 2021: one jamb lies in the blind spot."""
    scenes = list(draw_scenes("D", 15, 7))
    views = [detectors.spot(scene) for scene in scenes]
    cloud, both = (
        sum(all(judge(s, v, look).right) for s, v in zip(scenes, views, strict=True))
        for look in (detectors.finder, detectors.with_lidar)
    )
    assert cloud <= 5
    assert both >= 9
