"""Routes through floor plans, and the commands that describe them."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.judge import plan_goals
from semnav_env.judge.routes.choices import words_of
from semnav_env.judge.routes.describe import UndescribableError, describe
from semnav_env.judge.routes.follow import follows
from semnav_env.judge.routes.route import HEADING_STEP, POSE_SPACING, Route, RouteError
from semnav_env.judge.routes.route_to import comfortable, route_to
from semnav_env.language import Approach, Command, DoorReference, parse, sample_clause
from semnav_env.language.command import reference_of
from semnav_env.mind.grounding import GroundingError, PassGoal
from semnav_env.mind.grounding.goal import door_of
from semnav_env.robots import WHEELCHAIR
from semnav_env.world.maps import FloorPlan, bundled_names, load_floor_plan
from semnav_env.world.maps.generator import DISTRIBUTIONS, generate_office
from semnav_env.world.maps.placement import sample_pose
from semnav_features.frames import Pose

PLANS = {name: load_floor_plan(name) for name in bundled_names()}
GEODESICS = {name: comfortable(plan) for name, plan in PLANS.items()}
OFFICE = PLANS["office_cross"]
WEST: Pose = (1.3, 9.1, 0.0)
DESCRIBED = 0.95
"""Least share of the routes from random poses that are described."""


def to(goal: str | tuple[float, float], start: Pose = WEST, through: bool = True) -> Route:
    approach = Approach.THROUGH if through else Approach.TO
    return route_to(OFFICE, start, goal, approach, GEODESICS["office_cross"])


def random_route(plan: FloorPlan, rng: np.random.Generator) -> tuple[Route, str, Approach]:
    """To any open door, mostly through it, from any place and heading in a corridor."""
    names = [door.name for door in plan.doors if door.open]
    door = names[int(rng.integers(len(names)))]
    approach = Approach.THROUGH if rng.random() < 0.8 else Approach.TO
    start = sample_pose(plan, WHEELCHAIR, rng)
    return route_to(plan, start, door, approach, GEODESICS[plan.name]), door, approach


def check(plan: FloorPlan, route: Route, door: str) -> bool:
    """Whether a route is described; if so, that this leads along it to that very door."""
    try:
        command = describe(plan, route)
    except (UndescribableError, RouteError):
        return False
    for language in ("en", "de"):
        assert parse(command.say(language), language) == command
    assert follows(plan, command, route)
    goal = plan_goals(plan, command, route.start)[-1]
    if (named := door_of(goal)) is not None:
        assert named.name == door
    return True


@pytest.mark.parametrize(
    ("goal", "start", "text"),
    [
        ("west_south_2", WEST, "go through the second door on the right"),
        ("west_south_1", WEST, "go through the first door on the right"),
        (
            "south_east",
            WEST,
            "turn right at the first intersection and go through the first door",
        ),
        ("bend_north_3", (26.0, 19.1, math.pi), "go through the first door on the right"),
        ("west_north_1", (28.6, 9.1, math.pi), "go through the last door"),
        (
            "west_south_2",
            (1.3, 9.1, math.pi),
            "turn around and go through the second door on the right",
        ),
    ],
)
def test_the_shortest_command_of_a_route(goal: str, start: Pose, text: str) -> None:
    assert str(describe(OFFICE, to(goal, start))) == text


@pytest.mark.parametrize("name", PLANS)
def test_a_description_leads_along_its_route_to_its_door(name: str) -> None:
    rng = np.random.default_rng(11)
    routes = [random_route(PLANS[name], rng) for _ in range(25)]
    told = [check(PLANS[name], route, door) for route, door, _ in routes]
    assert np.mean(told) >= DESCRIBED


def thousand_routes(name: str) -> Iterator[tuple[FloorPlan, Route, str]]:
    """Through a bundled plan, or through 40 generated offices."""
    rng = np.random.default_rng(12)
    offices = [generate_office(seed, name) for seed in range(40)] if name in DISTRIBUTIONS else ()
    for plan in offices or (PLANS[name],):
        GEODESICS.setdefault(plan.name, comfortable(plan))
        for _ in range(1000 // len(offices or (plan,))):
            route, door, _ = random_route(plan, rng)
            yield plan, route, door
        if plan.name not in PLANS:
            del GEODESICS[plan.name]


@pytest.mark.slow
@pytest.mark.parametrize("name", [*PLANS, *DISTRIBUTIONS])
def test_a_thousand_descriptions_lead_along_their_routes(name: str) -> None:
    told, seconds = [], []
    for plan, route, door in thousand_routes(name):
        began = time.perf_counter()
        told.append(check(plan, route, door))
        seconds.append(time.perf_counter() - began)
    median, most = 1e3 * np.quantile(seconds, (0.5, 0.95))
    print(f"{name}: {np.mean(told):.1%} described; median {median:.0f} ms, 95 % below {most:.0f}")
    assert np.mean(told) >= DESCRIBED


def test_up_to_a_door_one_faces_it() -> None:
    route = to("west_south_2", through=False)
    assert str(describe(OFFICE, route)) == "go to the second door on the right"
    assert route.poses[-1, 2] == pytest.approx(-math.pi / 2)


@pytest.mark.parametrize(
    ("goal", "text"),
    [
        (
            "room_bend_north_1",
            "turn left at the first intersection, turn right at the first corner "
            "and go through the first door",
        ),
        ((29.0, 9.0), "go down the hallway"),
        ((15.0, 15.0), "turn left at the first intersection and go down the hallway for 5 metres"),
    ],
)
def test_rooms_and_places_are_described_as_well(goal: str | tuple[float, float], text: str) -> None:
    assert str(describe(OFFICE, to(goal))) == text


def leaves_open(command: Command) -> bool:
    """Whether a listener could count doors on one side or on both, and come to another one."""
    named = [reference_of(clause) for clause in command.clauses]
    doors = [reference for reference in named if isinstance(reference, DoorReference)]
    return any(door.side is None and door.ordinal not in (1, -1) for door in doors)


def length(command: Command) -> tuple[int, int]:
    return len(command.clauses), sum(map(words_of, command.clauses))


@pytest.mark.parametrize("name", PLANS)
def test_no_random_command_that_leads_there_is_shorter(name: str) -> None:
    """What `describe` weighs is not all that can be said; this looks for what it might miss."""
    plan, rng = PLANS[name], np.random.default_rng(13)
    for _ in range(8):
        route, _, _ = random_route(plan, rng)
        told = describe(plan, route)
        end = plan_goals(plan, told, route.start)[-1]
        for _ in range(300):
            number = int(rng.integers(1, len(told.clauses) + 1))
            clauses = tuple(sample_clause(rng, max_ordinal=4) for _ in range(number))
            other = Command((*clauses[:-1], told.clauses[-1]) if rng.random() < 0.5 else clauses)
            if length(other) >= length(told) or leaves_open(other):
                continue
            try:
                goal = plan_goals(plan, other, route.start)[-1]
            except GroundingError:
                continue
            same = (type(goal), door_of(goal)) == (type(end), door_of(end))
            assert not (same and follows(plan, other, route)), (str(other), str(told))


headings = st.floats(-math.pi, math.pi)


@given(
    points=st.lists(st.tuples(st.floats(-9, 9), st.floats(-9, 9)), min_size=2, max_size=6),
    heading=headings,
    facing=st.none() | headings,
)
@settings(max_examples=50)
def test_the_poses_of_a_route_are_dense_from_end_to_end(
    points: list[tuple[float, float]], heading: float, facing: float | None
) -> None:
    route = Route((*points[0], heading), np.array(points), facing)
    steps = np.diff(route.poses[:, :2], axis=0)
    turns = np.diff(route.poses[:, 2])
    assert np.isfinite(route.poses).all()
    assert np.hypot(*steps.T).max() <= POSE_SPACING + 1e-9
    assert np.abs(np.arctan2(np.sin(turns), np.cos(turns))).max() <= HEADING_STEP + 1e-9
    assert route.poses[0] == pytest.approx((*points[0], heading))
    assert route.poses[-1, :2] == pytest.approx(points[-1])
    if facing is not None:
        assert math.cos(route.poses[-1, 2] - facing) == pytest.approx(1.0)


def test_the_heading_at_the_end_of_a_route_is_finite() -> None:
    with pytest.raises(RouteError, match="finite numbers"):
        Route((0.0, 0.0, 0.0), np.array([(0.0, 0.0), (1.0, 0.0)]), math.nan)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([(0.0, 0.0)], "at least two points"),
        ([(0.0, 0.0), (math.nan, 1.0)], "finite numbers"),
        (
            [(3.0, 0.0), (4.0, 0.0)],
            r"starts at \(0.00, 0.00\), but its first point is \(3.00, 0.00\)",
        ),
    ],
)
def test_a_wrong_route_is_refused(points: list[tuple[float, float]], message: str) -> None:
    with pytest.raises(RouteError, match=message):
        Route((0.0, 0.0, 0.0), np.array(points))


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([(1.3, 9.1), (1.3, 2.0)], "something solid at"),
        ([(1.3, 9.1), (1.35, 9.1)], "nothing to describe"),
        ([(22.9, 9.1), (22.9, 7.0)], "through door east_south_2, which is closed"),
    ],
)
def test_a_route_that_no_robot_can_follow_is_not_described(
    points: list[tuple[float, float]], message: str
) -> None:
    with pytest.raises(RouteError, match=message):
        describe(OFFICE, Route((*points[0], 0.0), np.array(points)))


def test_a_circular_route_is_undescribable() -> None:
    """The error says how far the route can be told."""
    turns = np.linspace(0.0, 24.0 * math.pi, 800)
    points = np.stack((1.0 + 0.7 * np.sin(turns), 1.5 - 0.7 * np.cos(turns)), axis=1)
    route = Route((1.0, 0.8, 0.0), points)
    with pytest.raises(UndescribableError, match="it can be told as far as"):
        describe(PLANS["villa_hall"], route)


def test_a_route_leads_around_what_stands_behind_a_door() -> None:
    plan, door = generate_office(5, "small"), "1.01 - 1.02"
    start: Pose = (5.73, 0.09, -2.05)
    route = route_to(plan, start, door)
    goal = plan_goals(plan, describe(plan, route), start)[-1]
    assert isinstance(goal, PassGoal)
    assert goal.door.name == door


@pytest.mark.parametrize(
    ("goal", "message"),
    [
        ("kitchen", "office_cross has no door, room or place 'kitchen'; there are: west_"),
        ("east_south_2", "door east_south_2 is closed"),
    ],
)
def test_where_there_is_no_way_is_said(goal: str, message: str) -> None:
    with pytest.raises(RouteError, match=message):
        to(goal)
