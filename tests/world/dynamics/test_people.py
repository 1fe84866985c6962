"""People: how they walk, and that nobody walks into anything."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.robots import WHEELCHAIR
from semnav_env.world.dynamics import Dynamics, Walking
from semnav_env.world.dynamics.nearby import culled_walls
from semnav_env.world.dynamics.orca import nearest_allowed, orca
from semnav_env.world.dynamics.settings import MAX_SPEED_FACTOR
from semnav_env.world.dynamics.social_force import RELAXATION_TIME, social_force
from semnav_env.world.physics import World
from tests.support.moving_worlds import drive_about, world_of
from tests.support.small_plans import empty_hall

NO_LEAVES = np.zeros((0, 4))
FAR_ROBOT = np.array([1e3, 1e3, 0.0, 0.5, 0.3, 0.0, 0.0, 0.0])
DT = 1.0 / 15.0
models = pytest.mark.parametrize("model", ["social_force", "orca"])
KERNELS = {"social_force": social_force, "orca": orca}


def next_velocities(
    model: str,
    places: list[list[float]],
    wishes: list[list[float]],
    velocities: list[list[float]] | None = None,
    walls: list[list[float]] = [],  # noqa: B006
    body: np.ndarray = FAR_ROBOT,
    sees_robot: bool = True,
) -> np.ndarray:
    out = np.zeros((len(places), 2))
    now = np.array(velocities or wishes, dtype=np.float64)
    lines = culled_walls(np.array(walls, dtype=np.float64).reshape(-1, 4))
    people = np.array(places, dtype=np.float64), now, np.array(wishes, dtype=np.float64)
    KERNELS[model](*people, 0.25, lines, NO_LEAVES, body, sees_robot, DT, out)
    return out


@models
def test_somebody_alone_walks_as_wished(model: str) -> None:
    assert next_velocities(model, [[0, 0]], [[1.2, 0.5]])[0] == pytest.approx((1.2, 0.5))


def test_social_force_relaxes_to_the_wish_within_tau() -> None:
    after = next_velocities("social_force", [[0, 0]], [[1.0, 0.0]], [[0.0, 0.0]])
    assert after[0] == pytest.approx((DT / RELAXATION_TIME, 0.0))


@models
def test_two_who_meet_head_on_and_a_little_aside_pass_each_other(model: str) -> None:
    places, wishes = np.array([[0, 0], [5, 0.1]]), [[1.3, 0.0], [-1.3, 0.0]]
    now, least = np.array(wishes), math.inf
    for _ in range(80):
        now = next_velocities(model, places.tolist(), wishes, now.tolist())
        places = places + DT * now
        least = min(least, math.dist(*places))
    assert places[0, 0] > 4.0
    assert places[1, 0] < 1.0
    assert least > 0.45


@models
def test_mirroring_everything_mirrors_the_velocities(model: str) -> None:
    rng = np.random.default_rng(4)
    places, wishes = rng.uniform(-2, 2, (5, 2)), rng.uniform(-1, 1, (5, 2))
    walls, body = [[-3, -3, 3, -2.5]], np.array([0.3, 2.0, 0.4, 0.5, 0.3, 0.5, 0.2, 0.1])
    flip, turned = np.array([1, -1]), body * [1, -1, -1, 1, 1, 1, -1, -1]
    straight = next_velocities(model, places.tolist(), wishes.tolist(), walls=walls, body=body)
    mirrored = next_velocities(
        model,
        (places * flip).tolist(),
        (wishes * flip).tolist(),
        walls=[[-3, 3, 3, 2.5]],
        body=turned,
    )
    np.testing.assert_allclose(mirrored, straight * flip, atol=1e-4)


@models
def test_people_keep_off_the_robot_only_if_they_see_it(model: str) -> None:
    robot = np.array([1.2, 0.05, 0.0, 0.5, 0.3, 0.0, 0.0, 0.0])
    seeing = next_velocities(model, [[0, 0]], [[1.2, 0.0]], body=robot)
    blind = next_velocities(model, [[0, 0]], [[1.2, 0.0]], body=robot, sees_robot=False)
    assert seeing[0, 0] < 1.19
    assert blind[0] == pytest.approx((1.2, 0.0))


@models
def test_nobody_wants_to_go_faster_than_the_models_allow(model: str) -> None:
    rng = np.random.default_rng(2)
    places, wishes = rng.uniform(-1, 1, (12, 2)), rng.uniform(-1.5, 1.5, (12, 2))
    fast = np.hypot(*next_velocities(model, places.tolist(), wishes.tolist()).T)
    assert (fast <= MAX_SPEED_FACTOR * np.hypot(*wishes.T) + 1e-9).all()


def test_orca_lets_two_who_take_half_each_miss_by_both_radii() -> None:
    """The new relative velocity lies outside the velocity obstacle (section 4)."""
    rng = np.random.default_rng(11)
    for _ in range(200):
        between = rng.uniform(-3, 3, 2)
        if math.hypot(*between) < 0.6:
            continue
        wishes = rng.uniform(-1.3, 1.3, (2, 2))
        one, other = next_velocities("orca", [[0, 0], between.tolist()], wishes.tolist())
        times = np.linspace(0.0, 2.5, 200)[:, None]
        assert np.hypot(*(between - times * (one - other)).T).min() > 0.5 - 1e-3


planes = st.lists(
    st.tuples(st.floats(-math.pi, math.pi), st.floats(-1.0, 0.3)), min_size=0, max_size=8
)


@given(planes, st.floats(-1.5, 1.5), st.floats(-1.5, 1.5))
@settings(max_examples=150, deadline=None)
def test_the_allowed_velocity_is_the_nearest_one_of_a_fine_grid(
    drawn: list[tuple[float, float]], x: float, y: float
) -> None:
    rows = np.array([(math.cos(a), math.sin(a), o) for a, o in drawn]).reshape(-1, 3)
    out, wish, limit = np.zeros(2), np.array([x, y]), 1.2
    found = nearest_allowed(rows, 0, 0.0, wish, limit, out)
    axis = np.linspace(-limit, limit, 61)
    grid = np.stack(np.meshgrid(axis, axis), axis=-1).reshape(-1, 2)
    grid = grid[np.hypot(*grid.T) <= limit]
    allowed = grid[(grid @ rows[:, :2].T >= rows[:, 2]).all(axis=1)]
    if not found:
        assert len(allowed) == 0
        return
    assert (rows[:, :2] @ out >= rows[:, 2] - 1e-6).all()
    assert math.hypot(*out) <= limit + 1e-9
    if len(allowed):
        assert math.dist(out, wish) <= np.hypot(*(allowed - wish).T).min() + 1e-9


@models
@pytest.mark.parametrize(
    ("plan", "robot"), [("office_cross", "wheelchair"), ("villa_hall", "spot")]
)
def test_bodies_overlap_by_at_most_a_centimetre(model: str, plan: str, robot: str) -> None:
    world = world_of(plan, robot, Dynamics(6, model, changing_doors=1.0))
    deepest, touched = drive_about(world, 300, seed=3)
    assert deepest < 0.01
    assert touched > 5


@pytest.mark.slow
@models
@pytest.mark.parametrize(
    ("plan", "robot"),
    [("office_cross", "wheelchair"), ("heidelberg_hallway", "spot"), ("villa_hall", "wheelchair")],
)
def test_the_same_holds_for_ten_thousand_steps(model: str, plan: str, robot: str) -> None:
    people = Dynamics(8, model, changing_doors=1.0, walking=Walking(see_robot=robot == "spot"))
    deepest, _ = drive_about(world_of(plan, robot, people), 10_000, seed=5)
    assert deepest < 0.01


@models
def test_people_get_about_through_doors(model: str) -> None:
    world = world_of("office_cross", "wheelchair", Dynamics(5, model))
    world.reset((3.0, 9.1, 0.0), np.random.default_rng(1))
    assert world.moving is not None
    walked, before = np.zeros(5), world.moving.crowd.places.copy()
    for _ in range(450):
        world.step((0.0, 0.0, 0.0))
        walked += np.hypot(*(world.moving.crowd.places - before).T)
        before = world.moving.crowd.places.copy()
    assert (walked > 10.0).all()
    assert (walked < 30.0 * 2.5).all()


def test_a_robot_is_stopped_by_people_and_pushes_nobody() -> None:
    world = World(empty_hall(12.0, 8.0), WHEELCHAIR, dynamics=Dynamics(1))
    touched = False
    for seed in range(20):
        world.reset((6.0, 4.0, 0.0), np.random.default_rng(seed))
        assert world.moving is not None
        for _ in range(90):
            x, y = world.moving.crowd.places[0]
            aim = math.atan2(y - world.pose[1], x - world.pose[0]) - world.pose[2]
            before = world.moving.crowd.places[0].copy()
            world.step((1.5, 0.0, 3.0 * math.remainder(aim, math.tau)))
            assert math.dist(before, world.moving.crowd.places[0]) < 0.17
            touched |= world.in_contact
    assert touched


def test_people_move_no_robot_that_stands_still() -> None:
    blind = Walking(see_robot=False)
    world = World(empty_hall(6.0, 5.0), WHEELCHAIR, dynamics=Dynamics(8, walking=blind))
    world.reset((3.0, 2.5, 0.3), np.random.default_rng(3))
    for _ in range(450):
        world.step((0.0, 0.0, 0.0))
    assert not world.in_contact
    assert world.pose == pytest.approx((3.0, 2.5, 0.3), abs=1e-9)


def test_people_are_the_same_for_a_seed_and_differ_between_seeds() -> None:
    world = World(empty_hall(12.0, 8.0), WHEELCHAIR, dynamics=Dynamics(4))
    assert world.moving is not None
    starts = []
    for seed in (1, 1, 2):
        world.reset((6.0, 4.0, 0.0), np.random.default_rng(seed))
        starts.append(world.moving.crowd.places.tolist())
    assert starts[0] == starts[1] != starts[2]


def test_more_people_than_there_is_room_for_are_refused() -> None:
    world = World(empty_hall(4.0, 3.0), WHEELCHAIR, dynamics=Dynamics(60))
    with pytest.raises(ValueError, match=r"small has room for \d+ people .* not for 60"):
        world.reset((2.0, 1.5, 0.0))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Dynamics(-1), "pedestrians is -1; it must be a whole number from 0 to 200"),
        (lambda: Dynamics(2, "boids"), "model is 'boids'; it must be one of social_force, orca"),
        (
            lambda: Dynamics(changing_doors=1.5),
            "changing_doors is 1.5; it must be a number from 0",
        ),
        (lambda: Dynamics(moved_furniture=math.nan), "moved_furniture is nan"),
        (lambda: Walking(radius=2.0), "radius is 2.0; it must be a number from 0.1 to 0.5 m"),
    ],
)
def test_settings_that_make_no_sense_are_refused(make: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()  # type: ignore[operator]
