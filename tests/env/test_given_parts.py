"""Rewards, observations, tasks and lidars of somebody's own, given to the environment."""

from __future__ import annotations

import pickle
from dataclasses import replace
from typing import Any

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import AddedTerms, EpisodeRequest, RewardWeights, Tick
from semnav_env.mind.observations import MODES, EntryObservation, Moment
from semnav_env.robots import RobotSpec
from semnav_env.vector import SemNavVectorEnv
from semnav_env.world.lidar import TIM561, LidarSpec
from tests.support.episodes import START, actions

FAST = replace(TIM561, name="fast", rate_hz=40.0)


def yaw_cost(tick: Tick) -> float:
    return -abs(tick.motion.yaw_rate)


class OnlySpeed:
    def terms(self, tick: Tick) -> dict[str, float]:
        return {"speed": tick.motion.speed, "asked": float(tick.action[0])}


class NearestHit:
    name = "nearest"

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> gym.Space[Any]:
        return gym.spaces.Box(0.0, lidar.range_max, (1,), np.float32)

    def observe(self, moment: Moment) -> Any:
        return np.array([moment.tracker.ranges.min()], np.float32)


class GoalPlace:
    def space(self, robot: RobotSpec, lidar: LidarSpec) -> gym.Space[Any]:
        return gym.spaces.Box(-1000.0, 1000.0, (2,), np.float64)

    def observe(self, moment: Moment) -> Any:
        return np.array(moment.belief.target.pose[:2])


def driven(steps: int = 20, **arguments: Any) -> list[tuple[Any, float, dict[str, Any]]]:
    """What an environment returns on a drive that is always the same."""
    env = SemNavEnv(**arguments)
    env.reset(seed=5, options=START)
    returned = [env.step(action) for action in actions(steps, 2)]
    return [(each[0], each[1], each[4]) for each in returned]


def test_added_terms_leave_the_others_as_they_are() -> None:
    plain, added = driven(), driven(rewards=AddedTerms({"yaw": yaw_cost}))
    for (_, reward, info), (_, other, more) in zip(plain, added, strict=True):
        terms = more["reward_terms"]
        assert info["reward_terms"] == {k: v for k, v in terms.items() if k != "yaw"}
        assert other == pytest.approx(reward + terms["yaw"])
    assert min(more["reward_terms"]["yaw"] for _, _, more in added) < -0.1


def test_terms_can_be_added_to_rewards_of_ones_own() -> None:
    terms = driven(1, rewards=AddedTerms({"yaw": yaw_cost}, OnlySpeed()))[0][2]["reward_terms"]
    assert list(terms) == ["speed", "asked", "yaw"]


def test_a_term_with_a_name_that_is_taken_is_refused() -> None:
    with pytest.raises(ValueError, match=r"'progress'.*name yours anew"):
        AddedTerms({"progress": yaw_cost})


@pytest.mark.parametrize("base", [AddedTerms({"yaw": yaw_cost}), AddedTerms({}, RewardWeights())])
def test_a_name_that_a_nested_base_has_taken_is_refused(base: AddedTerms) -> None:
    with pytest.raises(ValueError, match="name yours anew"):
        AddedTerms({"yaw": yaw_cost, "time": yaw_cost}, base)


def test_a_name_that_rewards_of_ones_own_have_taken_is_refused() -> None:
    with pytest.raises(ValueError, match=r"'speed'.*name yours anew"):
        driven(1, rewards=AddedTerms({"speed": yaw_cost}, OnlySpeed()))


class OneTerm:
    def __init__(self, value: object) -> None:
        self.value = value

    def terms(self, tick: Tick) -> dict[str, float]:
        return {"fine": 1.0, "odd": self.value}  # type: ignore[dict-item]


@pytest.mark.parametrize("value", [np.nan, np.inf, None, np.array([1.0]), np.zeros(2)])
@pytest.mark.parametrize("added", [False, True])
def test_a_term_that_is_no_finite_number_is_named(value: object, added: bool) -> None:
    rewards: Any = AddedTerms({"odd": lambda _: value}) if added else OneTerm(value)  # type: ignore[dict-item,return-value]
    with pytest.raises(ValueError, match=r"reward term 'odd' is .* must be a finite number"):
        driven(1, rewards=rewards)
    robots = SemNavVectorEnv(1, rewards=rewards)
    robots.reset(seed=5, options=START)
    with pytest.raises(ValueError, match=r"reward term 'odd' is .* must be a finite number"):
        robots.step(np.zeros((1, 2), np.float32))


def test_rewards_of_ones_own_replace_all_terms() -> None:
    for _, reward, info in driven(rewards=OnlySpeed()):
        assert set(info["reward_terms"]) == {"speed", "asked"}
        assert reward == sum(info["reward_terms"].values())


@pytest.mark.parametrize("value", [OnlySpeed, RewardWeights, yaw_cost, {"yaw": yaw_cost}])
def test_rewards_that_are_none_are_refused(value: object) -> None:
    with pytest.raises(ValueError, match=r"terms\(tick\)"):
        SemNavEnv(rewards=value)  # type: ignore[arg-type]


@pytest.mark.parametrize("mode", MODES)
def test_an_extra_entry_stands_beside_those_of_the_mode(mode: str) -> None:
    plain, more = (
        driven(3, observation=mode),
        driven(3, observation=EntryObservation(mode, extra=[NearestHit()])),
    )
    for (seen, _, _), (fuller, _, _) in zip(plain, more, strict=True):
        assert set(fuller) == {*seen, "nearest"}
        assert all(np.array_equal(seen[name], fuller[name]) for name in seen)
        assert 0.0 < fuller["nearest"][0] < 10.0


def test_an_entry_with_a_name_that_is_taken_is_refused() -> None:
    entry = NearestHit()
    entry.name = "walls"
    with pytest.raises(ValueError, match=r"'walls'.*name yours anew"):
        EntryObservation("semantic", extra=[entry])


@pytest.mark.parametrize("observation", [GoalPlace(), EntryObservation("raw", [NearestHit()])])
def test_an_observation_of_ones_own_passes_the_checker(observation: Any) -> None:
    check_env(SemNavEnv(observation=observation), skip_render_check=True)


def test_an_observation_type_is_an_object_not_a_class() -> None:
    with pytest.raises(ValueError, match="space"):
        SemNavEnv(observation=GoalPlace)  # type: ignore[arg-type]


def test_an_environment_of_given_parts_goes_on_after_pickling() -> None:
    env = SemNavEnv(observation=GoalPlace(), rewards=AddedTerms({"yaw": yaw_cost}))
    env.reset(seed=5, options=START)
    copy = pickle.loads(pickle.dumps(env))
    for action in actions(10, 2):
        one, other = env.step(action), copy.step(action)
        assert np.array_equal(one[0], other[0])
        assert one[1] == other[1]


@pytest.mark.parametrize("observation", [GoalPlace(), EntryObservation("raw", [NearestHit()])])
def test_one_object_serves_all_of_a_vector_environment(observation: Any) -> None:
    envs = gym.make_vec(
        "semnav_env:SemNav-v0", num_envs=2, vectorization_mode="sync", observation=observation
    )
    alone = SemNavEnv(observation=observation)
    seen, _ = envs.reset(seed=[3, 4])
    expected = alone.reset(seed=4)[0]
    assert envs.observation_space.contains(seen)
    for name, value in _named(expected):
        assert np.array_equal(dict(_named(seen))[name][1], value)
    envs.close()


def _named(observation: Any) -> list[tuple[str, Any]]:
    return list(observation.items()) if isinstance(observation, dict) else [("", observation)]


def test_the_rate_of_the_lidar_is_the_rate_of_control() -> None:
    env = SemNavEnv(lidar=FAST, max_seconds=2.0)
    env.reset(seed=5, options=START)
    far = SemNavEnv(max_seconds=2.0)
    far.reset(seed=5, options=START)
    ends = [env.step(np.array([0.2, 0.0]))[3] for _ in range(80)]
    for _ in range(30):
        far.step(np.array([0.2, 0.0]))
    assert ends == [False] * 79 + [True]
    assert env.seconds == pytest.approx(2.0) == far.seconds
    assert env.metadata["render_fps"] == 40.0
    assert env.world.pose == pytest.approx(far.world.pose, abs=0.02)


def test_a_fast_lidar_leaves_the_time_to_stand_still_as_it_is() -> None:
    for lidar in (TIM561, FAST):
        env = SemNavEnv(lidar=lidar)
        env.reset(seed=5, options=START)
        info: dict[str, Any] = {}
        while "is_success" not in info:
            info = env.step(np.zeros(2))[4]
        assert info["verdicts"] == ("stopped short",)
        assert env.seconds == pytest.approx(10.0, abs=0.2)


def test_the_robot_waits_as_long_at_every_rate() -> None:
    for lidar in (TIM561, FAST):
        env = SemNavEnv(lidar=lidar)
        env.reset(seed=5, options={"command": "wait for 3 seconds", "pose": START["pose"]})
        while env.belief.clause == 0:
            env.step(np.zeros(2))
        assert env.seconds == pytest.approx(3.0, abs=0.15)


class AlwaysStop:
    """A task of one's own."""

    def request(self, rng: np.random.Generator) -> EpisodeRequest:
        return EpisodeRequest(command="stop", pose=START["pose"])


def test_a_task_of_ones_own_says_what_is_asked() -> None:
    _, info = SemNavEnv(task=AlwaysStop()).reset(seed=0)
    assert info["command"] == "stop"


def test_the_rate_of_the_lidar_is_that_of_control() -> None:
    env = SemNavEnv(lidar=replace(TIM561, rate_hz=5.0), max_seconds=10.0)
    env.reset(seed=0, options=START)
    env.step([0.0, 0.0])
    assert (env.seconds, env.max_steps, env.metadata["render_fps"]) == (0.2, 50, 5.0)
