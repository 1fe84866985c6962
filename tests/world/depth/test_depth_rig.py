"""Depth cameras: what is missing, how they err, what is hidden."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.robots import DepthRig
from semnav_env.world.depth import FaceKind, raise_plan, rig_hits
from semnav_env.world.maps import load_floor_plan
from semnav_features.frames import compose
from tests.support.raised_plans import exact_camera, exact_rig, walled_door
from tests.support.small_plans import empty_hall

HALL = raise_plan(empty_hall())


def wall_ahead(distance, **camera):
    """Depths measured of a wall that many metres ahead."""
    hits = rig_hits(
        exact_rig(up=0.2, **camera), HALL, (10.0 - distance, 3.0, 0.0), np.random.default_rng(1)
    )
    return hits.cloud.points_robot[hits.kinds == FaceKind.WALL, 0]


def test_the_same_generator_gives_the_same_cloud():
    plan, pose = raise_plan(load_floor_plan("villa_hall")), (1.2, 2.0, -1.0)
    first, again = (
        rig_hits(DepthRig.spot(), plan, pose, np.random.default_rng(4)).cloud.points_robot
        for _ in range(2)
    )
    assert np.array_equal(first, again)


def test_the_error_of_depth_grows_with_its_square():
    near, far = (np.std(wall_ahead(d, inverse_sigma=0.01, across=0.6)) for d in (1.0, 3.0))
    assert near == pytest.approx(0.01, rel=0.1)
    assert far == pytest.approx(0.09, rel=0.15)


def test_nothing_is_matched_nearer_than_the_least_range():
    assert len(wall_ahead(0.2, range_min=0.25)) == 0
    assert len(wall_ahead(0.3, range_min=0.25)) > 100


@given(st.floats(0.0, 1.0))
def test_as_many_pixels_are_missing_as_is_said(share):
    """Half of them pixel by pixel, and half in patches: 1 - (1 - share / 2) ** 2."""
    count = len(wall_ahead(1.0, missing=(share,) * 6, columns=120, rows=120))
    expected = (1.0 - 0.5 * share) ** 2
    assert count / 120**2 == pytest.approx(expected, abs=0.12)


def test_a_pair_sees_only_what_both_eyes_see():
    """Beside the jamb of a door the second eye does not see all of what lies behind."""
    raised, rng = raise_plan(walled_door()), np.random.default_rng(0)
    one, two = (
        rig_hits(exact_rig(baseline=b, columns=200), raised, (0.0, 0.0, 0.0), rng)
        for b in (0.0, 0.2)
    )
    behind = [hits.cloud.points_robot[hits.cloud.points_robot[:, 0] > 4.4] for hits in (one, two)]
    assert 0 < len(behind[1]) < 0.95 * len(behind[0])


@given(st.floats(-math.pi, math.pi), st.floats(-2.0, 2.0), st.floats(-1.0, 1.0))
def test_a_cloud_lies_on_the_walls_from_any_pose(heading, x, y):
    pose = (5.0 + x, 3.0 + y, heading)
    hits = rig_hits(exact_rig(), HALL, pose, np.random.default_rng(0))
    points = hits.cloud.points_robot[hits.kinds == FaceKind.WALL, :2]
    places = np.array([compose(pose, (*point, 0.0))[:2] for point in points.tolist()])
    gaps = np.abs(
        np.column_stack((places[:, 0], places[:, 0] - 10, places[:, 1], places[:, 1] - 6))
    )
    assert (gaps.min(axis=1) < 1e-6).all()


def test_people_and_moving_leaves_are_seen():
    moving = np.array([[6.0, 3.0, 0.3]]), np.array([[7.0, 1.0, 7.0, 2.0]])
    hits = rig_hits(exact_rig(), HALL, (5.0, 3.0, 0.0), np.random.default_rng(0), moving)
    assert {FaceKind.PERSON, FaceKind.LEAF} <= set(hits.kinds.tolist())
    person = hits.cloud.points_robot[hits.kinds == FaceKind.PERSON]
    assert person[:, 0].min() == pytest.approx(0.7, abs=0.05)


def test_spot_sees_all_around_but_little_above_a_metre():
    cloud = rig_hits(
        DepthRig.spot(), HALL, (5.0, 3.0, 0.0), np.random.default_rng(0)
    ).cloud.points_robot
    near = cloud[np.hypot(cloud[:, 0], cloud[:, 1]) < 1.5]
    assert np.quantile(near[:, 2], 0.999) < 1.2
    directions = np.histogram(np.arctan2(cloud[:, 1], cloud[:, 0]), 24, (-math.pi, math.pi))[0]
    assert (directions > 0).all()


def test_bad_poses_and_cameras_are_named():
    with pytest.raises(ValueError, match="must be finite"):
        rig_hits(DepthRig.spot(), HALL, (math.nan, 0.0, 0.0), np.random.default_rng(0))
    for change, named in (
        ({"columns": 0}, "columns and rows"),
        ({"across": 4.0}, "views"),
        ({"range_min": 30.0}, "range_min"),
        ({"missing": (0.5,)}, "6 shares"),
        ({"mismatch": 2.0}, "shares"),
    ):
        with pytest.raises(ValueError, match=named):
            exact_camera(**change)
