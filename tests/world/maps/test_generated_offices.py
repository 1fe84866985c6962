"""Generated offices: valid, and fit to drive in, whatever the seed."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import replace

import gymnasium as gym
import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from shapely import LineString, Point

from semnav_env.judge import Judge
from semnav_env.judge.tasks import EpisodeRequest, MissionMaker
from semnav_env.language import parse
from semnav_env.mind.grounding import ReachGoal
from semnav_env.robots import ROBOTS, WHEELCHAIR
from semnav_env.world.maps import (
    DISTRIBUTIONS,
    FloorPlan,
    Material,
    generate_office,
    load_floor_plan,
)
from semnav_env.world.maps.check import check
from semnav_env.world.maps.doorways import DoorState, clear_width, door_state
from semnav_env.world.maps.geodesic import Geodesic
from semnav_env.world.maps.rules import check_plan
from tests.support.offices import every_distribution, names, seeds


def floor(plan: FloorPlan) -> shapely.Polygon:
    return shapely.union_all([region.polygon for region in plan.regions])


@every_distribution
@pytest.mark.parametrize("seed", range(3))
def test_nothing_is_wrong_with_a_generated_office(name: str, seed: int) -> None:
    assert check(generate_office(seed, name)) == []


@pytest.mark.slow
@every_distribution
@pytest.mark.parametrize("robot", ROBOTS.values(), ids=list(ROBOTS))
def test_nothing_is_wrong_with_25_offices_of_each_distribution(name: str, robot) -> None:
    for seed in range(100, 125):
        assert check(generate_office(seed, name), robot) == [], seed


@pytest.mark.parametrize("name", ["office:large:530", "office:hard:535"])
def test_furniture_blocks_no_door_between_rooms(name: str) -> None:
    """In these two a cabinet did, close to the tip of the door's leaf."""
    assert check(load_floor_plan(name)) == []


@given(seeds)
@settings(max_examples=5, deadline=None)
def test_nothing_is_wrong_with_an_office_of_any_seed(seed: int) -> None:
    assert check(generate_office(seed, "small")) == []


@given(seeds, names)
@settings(max_examples=15, deadline=None)
def test_regions_fill_the_building_without_overlap(seed: int, name: str) -> None:
    plan = generate_office(seed, name)
    corridors = shapely.union_all([region.polygon for region in plan.corridors])
    apart = [corridors, *(region.polygon for region in (*plan.rooms, *plan.areas))]
    assert floor(plan).symmetric_difference(plan.boundary).area < 1e-6
    assert sum(part.area for part in apart) == pytest.approx(plan.boundary.area)


@given(seeds, names)
@settings(max_examples=15, deadline=None)
def test_every_office_keeps_to_the_ranges_of_its_distribution(seed: int, name: str) -> None:
    plan, ranges = generate_office(seed, name), DISTRIBUTIONS[name]
    check_plan(plan)
    assert ranges.rooms[0] <= len(plan.rooms) <= ranges.rooms[1]
    for door in plan.doors:
        assert ranges.door_width[0] - 1e-9 <= door.width <= ranges.door_width[1] + 1e-9
    for corridor in plan.corridors:
        west, south, east, north = corridor.polygon.bounds
        width = min(east - west, north - south)
        assert ranges.corridor_width[0] <= width + 1e-9
        assert width <= ranges.corridor_width[1] + 1e-9


@given(seeds, names)
@settings(max_examples=15, deadline=None)
def test_every_room_has_a_door_to_a_corridor(seed: int, name: str) -> None:
    """A door is directed so that its corridor lies to its left."""
    plan = generate_office(seed, name)
    entered = set()
    for door in plan.doors:
        (x1, y1), (x2, y2) = door.start, door.end
        right = (y2 - y1) / door.width, (x1 - x2) / door.width
        ahead, behind = (
            Point(*(m + 0.1 * sign * r for m, r in zip(door.midpoint, right, strict=True)))
            for sign in (1, -1)
        )
        room = next(room.name for room in plan.rooms if room.polygon.contains(ahead))
        before = plan.rooms if " - " in door.name else plan.corridors
        assert any(region.polygon.contains(behind) for region in before)
        if " - " not in door.name:
            assert door.name.removesuffix(" b") == room
            entered.add(room)
    assert entered == set(plan.room_names)


@given(seeds, names)
@settings(max_examples=15, deadline=None)
def test_a_wheelchair_fits_through_every_door_that_is_not_closed(seed: int, name: str) -> None:
    plan = generate_office(seed, name)
    for door in plan.doors:
        if door.open:
            assert clear_width(door, plan) > WHEELCHAIR.width + 0.1
        else:
            assert door_state(door, plan) is DoorState.CLOSED


def test_every_distribution_has_all_junctions_and_materials() -> None:
    """Each kind of door state occurs, too."""
    for name in DISTRIBUTIONS:
        plans = [generate_office(seed, name) for seed in range(40)]
        kinds = {region.name.split()[0] for plan in plans for region in plan.intersections}
        states = {door_state(door, plan) for plan in plans for door in plan.doors}
        materials = {surface.material for plan in plans for surface in plan.surfaces}
        assert kinds == {"corner", "T-junction", "crossing"}
        assert states == set(DoorState)
        assert materials == set(Material) - {Material.PERSON}
        assert any(plan.areas for plan in plans)
        assert any(" - " in door.name for plan in plans for door in plan.doors)


def test_some_corridors_end_blindly_and_some_close_a_loop() -> None:
    blind = loops = 0
    for seed in range(12):
        plan = generate_office(seed)
        corridors = shapely.union_all([region.polygon for region in plan.corridors])
        loops += len(corridors.interiors) > 0
        for region in plan.corridors:
            ends = LineString(region.polygon.minimum_rotated_rectangle.exterior.coords)
            crossed = sum(c.polygon.intersects(region.polygon) for c in plan.intersections)
            blind += crossed < 2 and ends.length > 0
    assert blind > 0
    assert loops > 0


def test_a_large_distribution_has_offices_of_60_rooms() -> None:
    rooms = Counter(len(generate_office(seed, "large").rooms) for seed in range(12))
    assert max(rooms) >= 60


@given(seeds, names)
@settings(max_examples=10, deadline=None)
def test_a_command_may_name_every_room(seed: int, name: str) -> None:
    plan = generate_office(seed, name)
    for room in plan.room_names:
        assert parse(f"go to {room}", rooms=plan.room_names).clauses[-1].name == room


@every_distribution
def test_an_environment_runs_in_a_generated_office(name: str) -> None:
    env = gym.make("semnav_env:SemNav-v0", floor_plan=f"office:{name}:3")
    observation, _ = env.reset(seed=0)
    assert env.observation_space.contains(observation)
    for _ in range(5):
        observation, reward, *_ = env.step(env.action_space.sample())
        assert env.observation_space.contains(observation)
        assert math.isfinite(reward)
    env.close()


@every_distribution
def test_random_commands_are_found_and_their_ways_are_finite(name: str) -> None:
    for seed in range(3):
        plan = generate_office(seed, name)
        missions = MissionMaker(plan, WHEELCHAIR)
        for episode in range(2):
            mission = missions.make(EpisodeRequest(), np.random.default_rng(episode))
            assert math.isfinite(mission.route_length)
            assert math.isfinite(Judge(mission).remaining)
            for goal in mission.goals:
                at_desk = len(plan.furniture.query(Point(goal.pose[:2]), "covered_by"))
                assert not (isinstance(goal, ReachGoal) and at_desk)


def test_no_way_ends_inside_a_desk() -> None:
    plan = generate_office(1, "hard")
    desk = max(plan.furniture.geometries, key=lambda piece: piece.area)
    ways = Geodesic(plan).to((desk.centroid.x, desk.centroid.y))
    assert math.isfinite(ways.length(plan.corridors[0].polygon.centroid.coords[0]))


@given(seeds, names)
@settings(max_examples=8)
def test_no_robot_takes_a_framed_window_for_a_way(seed: int, name: str) -> None:
    plan = generate_office(seed, replace(DISTRIBUTIONS[name], glass=0.6, frameless=0.0))
    panes = [LineString(s.points) for s in plan.surfaces if s.material is Material.GLASS]
    narrowest = min(robot.width for robot in ROBOTS.values())
    assert panes
    assert all(pane.length < narrowest for pane in panes)
    doors = [LineString((door.start, door.end)) for door in plan.scene.doors]
    for pane in panes:
        near = [other for other in (*panes, *doors) if other is not pane]
        assert all(pane.distance(other) > 0.29 for other in near)


def test_a_frameless_front_is_one_pane_up_to_its_door() -> None:
    widest = 0.0
    for seed in range(3):
        plan = generate_office(seed, replace(DISTRIBUTIONS["small"], glass=1.0, frameless=1.0))
        panes = [LineString(s.points) for s in plan.surfaces if s.material is Material.GLASS]
        widest = max(widest, *(pane.length for pane in panes))
    assert widest > 1.5
