"""A floor plan raised to its ceiling."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.world.depth import Closet, FaceKind, PlanWindow, RaiseSettings, raise_plan, rig_hits
from semnav_env.world.maps import bundled_names, load_floor_plan
from semnav_env.world.maps.floor_plan import Material, PlanDoor, Surface
from tests.support.raised_plans import DOOR, exact_rig, walled_door

HERE = (0.0, 0.0, 0.0)


def seen(raised, pose=HERE, **camera):
    return rig_hits(exact_rig(**camera), raised, pose, np.random.default_rng(0))


def ahead(raised, y, z):
    """How far it is straight ahead, from a camera at a place across and a height, metres."""
    camera = {"position": (0.0, y, z), "across": 0.02, "up": 0.02, "columns": 1, "rows": 1}
    points = seen(raised, **camera).cloud.points_robot
    return float(points[0, 0]) if len(points) else np.inf


def test_one_sees_through_a_door_below_its_lintel_only():
    raised = raise_plan(walled_door())
    assert ahead(raised, 0.0, 1.9) == pytest.approx(4.5)
    assert ahead(raised, 0.0, 2.05) == pytest.approx(1.94)  # the head of the frame
    assert ahead(raised, 0.0, 2.3) == pytest.approx(2.0)  # the wall above it


@given(st.floats(-0.449, 0.449), st.floats(0.01, 1.99))
def test_the_frame_leaves_the_whole_opening_free(y, z):
    assert ahead(raise_plan(walled_door()), y, z) == pytest.approx(4.5)


@given(st.floats(0.451, 0.549), st.floats(0.01, 1.99), st.sampled_from((-1.0, 1.0)))
def test_the_jambs_stand_proud_of_the_wall(y, z, side):
    assert ahead(raise_plan(walled_door()), side * y, z) == pytest.approx(1.94)


def test_points_know_their_jamb():
    hits = seen(raise_plan(walled_door()))
    for jamb, side in ((0, -1.0), (1, 1.0)):
        y = hits.cloud.points_robot[hits.jambs == jamb, 1]
        assert len(y) > 10
        assert ((side * y > 0.449) & (side * y < 0.551)).all()


def test_a_leaf_is_as_high_as_the_lintel():
    leaf = Surface((DOOR.start, DOOR.end), Material.LEAF)
    raised = raise_plan(walled_door(leaf))
    assert ahead(raised, 0.0, 1.9) == pytest.approx(2.0)
    assert FaceKind.LEAF in raised.kinds


def test_one_sees_through_a_window_between_sill_and_head():
    raised = raise_plan(walled_door(), windows=(PlanWindow((2.0, 1.0), (2.0, 2.0), sill=0.8),))
    assert ahead(raised, 1.5, 0.7) == pytest.approx(2.0)
    assert ahead(raised, 1.5, 0.9) == pytest.approx(4.5)
    assert ahead(raised, 1.5, 2.1) == pytest.approx(2.0)
    assert ahead(raised, 0.9, 1.5) == pytest.approx(2.0)


def test_one_looks_over_furniture_that_is_lower():
    desk = Surface(((1.0, 1.0), (1.5, 1.0), (1.5, 2.0), (1.0, 2.0), (1.0, 1.0)), Material.FURNITURE)
    closet = Closet(((1.0, -2.0), (1.5, -2.0), (1.5, -1.0), (1.0, -1.0)), height=1.8)
    raised = raise_plan(walled_door(desk), closets=(closet,))
    assert ahead(raised, 1.5, 0.7) == pytest.approx(1.0)
    assert ahead(raised, 1.5, 0.8) == pytest.approx(2.0)
    assert ahead(raised, -1.5, 1.7) == pytest.approx(1.0)


def test_people_on_the_floor_are_seen_and_looked_over():
    body = Surface(((1.0, 1.0), (1.5, 1.0), (1.5, 2.0), (1.0, 2.0), (1.0, 1.0)), Material.PERSON)
    raised = raise_plan(walled_door(body))
    assert ahead(raised, 1.5, 0.25) == pytest.approx(1.0)
    assert ahead(raised, 1.5, 0.35) == pytest.approx(2.0)
    assert FaceKind.PERSON in seen(raised).kinds


@pytest.mark.parametrize("material", [m for m in Material if m is not Material.GLASS])
def test_what_the_lidar_sees_depth_cameras_see(material):
    thing = Surface(((1.0, 1.0), (1.0, 2.0)), material)
    assert ahead(raise_plan(walled_door(thing)), 1.5, 0.2) == pytest.approx(1.0)


def test_an_opening_that_is_wider_than_doors_has_no_frame():
    wide = PlanDoor("gap", (2.0, -1.0), (2.0, 1.0))
    raised = raise_plan(walled_door(door=wide))
    assert FaceKind.FRAME not in raised.kinds
    assert ahead(raised, 0.0, 2.3) == pytest.approx(4.5)


def test_floor_and_ceiling_are_where_they_belong():
    points = seen(raise_plan(walled_door()), up=2.0).cloud.points_robot
    assert points[:, 2].min() == pytest.approx(0.0, abs=1e-9)
    assert points[:, 2].max() == pytest.approx(2.5)


@pytest.mark.parametrize("name", bundled_names())
def test_every_bundled_plan_is_raised(name):
    plan = load_floor_plan(name)
    raised = raise_plan(plan)
    assert np.isfinite(raised.corners).all()
    jambs = {2 * i + k for i, door in enumerate(plan.doors) if door.width <= 1.25 for k in (0, 1)}
    assert jambs <= set(raised.jambs.tolist())


def test_what_cannot_be_built_is_named():
    with pytest.raises(ValueError, match="lies on no straight wall of small"):
        raise_plan(walled_door(), windows=(PlanWindow((0.0, 1.0), (0.0, 2.0)),))
    with pytest.raises(ValueError, match="less than the ceiling"):
        RaiseSettings(lintel=2.6)
