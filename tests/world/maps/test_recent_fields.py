"""Fields of distances that are kept: no more than allowed, and none that nobody can ask for."""

from __future__ import annotations

import gc
from concurrent.futures import ThreadPoolExecutor
from copy import copy

import numpy as np

from semnav_env.robots import robot_spec
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.geodesic import RECENT_FIELDS, Geodesic
from semnav_env.world.maps.recent_fields import RecentFields
from semnav_env.world.physics import World


class Owner:
    """Something that owns fields."""


def field() -> np.ndarray:
    return np.zeros(10)


def test_a_field_is_made_once():
    fields, owner = RecentFields(1000), Owner()
    number = fields.number(owner)
    assert fields.get(number, "a", field) is fields.get(number, "a", field)
    assert fields.kept_bytes == field().nbytes


def test_the_field_used_longest_ago_is_dropped():
    fields, owner = RecentFields(2 * field().nbytes), Owner()
    number = fields.number(owner)
    first, second = (fields.get(number, key, field) for key in "ab")
    fields.get(number, "a", field)
    fields.get(number, "c", field)
    assert fields.get(number, "a", field) is first
    assert fields.get(number, "b", field) is not second


def test_fields_of_an_owner_that_is_gone_are_dropped():
    fields, lasting = RecentFields(1000), Owner()
    kept = fields.get(fields.number(lasting), "a", field)
    for _ in range(5):
        owner = Owner()
        fields.get(fields.number(owner), "a", field)
        del owner
        gc.collect()
    assert fields.get(0, "a", field) is kept
    assert fields.kept_bytes == kept.nbytes


def test_threads_that_crowd_each_other_out_each_get_their_field():
    fields, owner = RecentFields(2 * field().nbytes), Owner()
    number = fields.number(owner)

    def work(thread: int) -> bool:
        keys = np.random.default_rng(thread).integers(6, size=2000).tolist()
        return all(fields.get(number, k, lambda k=k: np.full(10, k))[0] == k for k in keys)

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(work, range(4)))
    assert fields.kept_bytes == 2 * field().nbytes


def test_a_copy_has_fields_of_its_own():
    plan = load_floor_plan("heidelberg_hallway")
    geodesic = Geodesic(plan)
    goal = plan.corridors[0].polygon.centroid
    ways = geodesic.to((goal.x, goal.y)).distances
    assert copy(geodesic).to((goal.x, goal.y)).distances is not ways


def test_worlds_with_people_leave_no_fields_behind():
    """Each crowd used to have ways of its own, kept after its world: up to 250 MB in an hour."""
    plan, robot = load_floor_plan("office_cross"), robot_spec("wheelchair")
    start = (1.3, 9.1, 0.0)

    def kept() -> int:
        World(plan, robot, dynamics=Dynamics(pedestrians=3)).reset(start)
        gc.collect()
        return RECENT_FIELDS.kept_bytes

    first = kept()
    assert [kept() for _ in range(3)] == [first] * 3
