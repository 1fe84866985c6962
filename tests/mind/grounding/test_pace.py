"""A pace counts from where it is said until another one is said, and leads nowhere itself."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from semnav_agents.base import steps
from semnav_agents.hearing.tokens import without_paces
from semnav_agents.planning.track import SLOW_SHARE, FollowerSettings
from semnav_agents.registry import make_agent
from semnav_env import SemNavEnv
from semnav_env.judge.tasks.implicit import with_implicit_steps
from semnav_env.language import (
    Clause,
    Command,
    DoorReference,
    Follow,
    GoToDoor,
    GoToRoom,
    IfThere,
    Leave,
    Pace,
    Place,
    PlaceReference,
    Side,
    Speed,
    Turn,
    Turning,
    encode,
)
from semnav_env.mind.grounding import GroundingError, ground
from semnav_env.mind.grounding.clause_order import (
    comes_after_corridor,
    is_only_a_direction,
    pace_at,
)
from semnav_env.mind.grounding.follower import Follower
from semnav_env.robots import ROBOTS, RobotSpec
from semnav_env.world.maps import load_floor_plan
from semnav_features.frames import Pose

PLAN = load_floor_plan("office_cross")
WEST: Pose = (1.3, 9.1, 0.0)
SLOW, FAST = Pace(Speed.SLOW), Pace(Speed.FAST)
END = Follow(PlaceReference(Place.END))
LEFT = Turn(Turning.LEFT)
DOOR = GoToDoor(DoorReference(1, Side.RIGHT))


def test_a_pace_counts_until_another_is_said() -> None:
    follower = Follower(Command((END, SLOW, LEFT, FAST, DOOR)), complete=True)
    follower.start(PLAN.scene, WEST)
    paces = []
    while not follower.done:
        paces.append((follower.active, follower.pace))
        follower.skip_to_next(PLAN.scene)
    assert paces == [(0, None), (2, Speed.SLOW), (4, Speed.FAST)]


@pytest.mark.parametrize("clauses", [(SLOW, DOOR), (SLOW, FAST, DOOR), (DOOR, SLOW)])
def test_a_pace_is_done_at_once(clauses: tuple[Clause, ...]) -> None:
    follower = Follower(Command(clauses), complete=True)
    follower.start(PLAN.scene, WEST)
    assert follower.active == clauses.index(DOOR)
    assert follower.goal == ground(DOOR, PLAN.scene, WEST, complete=True)
    follower.skip_to_next(PLAN.scene)
    assert follower.done


def test_a_pace_that_was_ruled_out_does_not_count() -> None:
    clauses = (IfThere(DoorReference(1)), SLOW, DOOR)
    assert pace_at(clauses, 2, frozenset()) is Speed.SLOW
    assert pace_at(clauses, 2, frozenset({1})) is None


def test_a_pace_between_clauses_does_not_part_them() -> None:
    assert is_only_a_direction((Follow(), SLOW, LEFT), 0)
    assert comes_after_corridor((Follow(), SLOW, LEFT), 2)
    assert comes_after_corridor((SLOW, Follow(), FAST, LEFT), 3)
    assert not comes_after_corridor((SLOW, LEFT), 1)


def test_a_command_is_more_than_a_pace() -> None:
    with pytest.raises(ValueError, match="not only how fast"):
        Command((SLOW,))
    with pytest.raises(GroundingError, match="leads nowhere"):
        ground(SLOW, PLAN.scene, WEST)


def test_implicit_steps_come_behind_a_pace() -> None:
    told = Command((SLOW, GoToDoor(DoorReference(2, Side.LEFT))))
    whole = with_implicit_steps(told, lambda command: Leave() in command.clauses, in_room=True)
    assert whole.clauses == (SLOW, Leave(), LEFT, told.clauses[1])


@pytest.mark.parametrize("robot", ROBOTS.values())
def test_slow_is_half_and_fast_is_what_the_body_allows(robot: RobotSpec) -> None:
    usual = FollowerSettings()
    assert usual.at(None, robot) is usual
    slow, fast = (usual.at(speed, robot) for speed in Speed)
    assert slow.cruise == SLOW_SHARE * usual.cruise
    assert slow.turn_rate == SLOW_SHARE * usual.turn_rate
    assert fast.cruise == pytest.approx(robot.max_speed)


@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
@pytest.mark.parametrize("agent", ["scripted", "oracle"])
def test_scripted_drivers_obey_a_pace_where_it_is_said(robot: str, agent: str) -> None:
    driver = make_agent(agent)
    env = SemNavEnv(robot, "office_cross", observation=driver.observation)
    cross = Follow(PlaceReference(Place.INTERSECTION))
    told = {"command": Command((SLOW, cross, FAST, END)), "pose": WEST}
    observation, info = env.reset(seed=0, options=told)
    fastest = {Speed.SLOW: 0.0, Speed.FAST: 0.0}
    for step in steps(env, driver, observation, info):
        info, pace = step.info, env.tracker.follower.pace
        assert step.observation["pace"] == [None, *Speed].index(pace)
        fastest[pace] = max(fastest[pace], env.simulator.motion.speed)
    assert info["is_success"], info["verdicts"]
    assert info["verdicts"] == ("done",) * 4
    assert fastest[Speed.SLOW] < 0.6 < 1.3 < fastest[Speed.FAST] <= env.robot.max_speed + 0.01


def test_the_listener_hears_a_command_without_its_paces() -> None:
    plain = Command((Follow(), LEFT, GoToRoom("kitchen")))
    paced = Command((SLOW, Follow(), LEFT, FAST, GoToRoom("kitchen")))
    told = np.array([[4.0, 1.0, 2.0], [0.0, 0.0, 0.0]], np.float32)
    observation = {"command": encode(paced, ["kitchen"]).ravel()}
    for name, rows, columns in (("told_ways", 80, 3), ("told_doors", 8, 5)):
        observation[name] = np.zeros((rows, columns), np.float32)
        observation[name][0, 0] = told[0, 0]
        observation[name] = observation[name].ravel()
    heard = without_paces(observation)
    assert np.array_equal(heard["command"], encode(plain, ["kitchen"]).ravel())
    assert (
        heard["told_ways"][0] == heard["told_doors"][0] == plain.clauses.index(GoToRoom("kitchen"))
    )
    usual = {**observation, "command": encode(plain, ["kitchen"]).ravel()}
    assert without_paces(usual) is usual


@pytest.mark.parametrize("agent", ["drive", "listener"])
def test_learned_agents_drive_as_without_a_pace(agent: str) -> None:
    ways = []
    for clauses in ((DOOR,), (SLOW, DOOR)):
        driver = make_agent(agent)
        env = SemNavEnv("wheelchair", "office_cross", observation=driver.observation)
        observation, info = env.reset(seed=0, options={"command": Command(clauses), "pose": WEST})
        ways.append([step.info["pose"] for step in steps(env, driver, observation, info)])
    assert np.array_equal(*ways)


def test_an_episode_at_a_pace_survives_pickling() -> None:
    driver = make_agent("scripted")
    env = SemNavEnv("spot", "office_cross", observation=driver.observation)
    observation, info = env.reset(seed=0, options={"command": Command((SLOW, END)), "pose": WEST})
    driver.reset(info)
    for _ in range(30):
        observation, *_ = env.step(driver.act(observation))
    copy, twin = pickle.loads(pickle.dumps((env, driver)))
    again = observation
    for _ in range(30):
        observation, *_ = env.step(driver.act(observation))
        again, *_ = copy.step(twin.act(again))
    assert all(np.array_equal(observation[name], again[name]) for name in observation)
    assert copy.belief.pace is Speed.SLOW
