"""`SearchAndRescue-v0`: its parts fit together, one robot or many."""

from __future__ import annotations

import pickle

import gymnasium as gym
import numpy as np
import pytest

from semnav_agents.base import steps
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.language import Command, GoBack, SearchHouse
from semnav_env.rescue import PersonSearch, PersonTrack
from semnav_env.rescue.environment import search_and_rescue
from semnav_env.rescue.people_entry import read_people
from semnav_features.frames import to_local

NAME = "semnav_env:SearchAndRescue-v0"


def test_a_search_without_a_detector_is_refused() -> None:
    env = SemNavEnv()
    with pytest.raises(ValueError, match="needs a person detector: make"):
        env.reset(seed=0, options={"command": "search the house"})


def test_a_payload_that_is_none_is_named() -> None:
    with pytest.raises(ValueError, match="payload is 3; it must be None or have begin"):
        SemNavEnv(payload=3)  # type: ignore[arg-type]


def test_a_robot_that_stands_still_has_not_searched() -> None:
    env = search_and_rescue("raw", robot="spot")
    env.reset(seed=1)
    for _ in range(600):
        *_, terminated, _, info = env.step(np.zeros(3))
        if terminated:
            break
    assert info["verdicts"] == ("incomplete",)
    assert not info["is_success"]
    assert info["search"]["found"] < info["search"]["victims"] == 2
    assert 0.0 <= info["search"]["least_coverage"] < 0.95


def test_the_same_seed_gives_the_same_search() -> None:
    def driven() -> list[np.ndarray]:
        env = search_and_rescue("raw", robot="spot")
        env.reset(seed=5)
        return [env.step([0.3, 0.0, 0.5])[0]["people"] for _ in range(80)]

    assert np.array_equal(driven(), driven())


def test_a_pickled_search_goes_on_as_before() -> None:
    env = search_and_rescue("raw", robot="spot")
    env.reset(seed=5)
    for _ in range(30):
        env.step([0.3, 0.0, 0.5])
    twin = pickle.loads(pickle.dumps(env))
    for _ in range(30):
        one, other = env.step([0.2, 0.0, -0.5]), twin.step([0.2, 0.0, -0.5])
        assert np.array_equal(one[0]["people"], other[0]["people"])
    assert env.payload.outcome == twin.payload.outcome  # type: ignore[union-attr]


def test_many_robots_search_as_each_would_alone() -> None:
    options = {"robot": "spot", "observation": "raw"}
    envs = gym.make_vec(NAME, num_envs=2, vectorization_mode="vector_entry_point", **options)
    alone = [search_and_rescue(**options) for _ in range(2)]
    envs.reset(seed=7)
    for k, env in enumerate(alone):
        env.reset(seed=7 + k)
    for _ in range(60):
        observed, rewards, *_ = envs.step(np.tile([0.3, 0.0, 0.5], (2, 1)))
        for k, env in enumerate(alone):
            own, reward, *_ = env.step([0.3, 0.0, 0.5])
            assert np.array_equal(observed["people"][k], own["people"])
            assert rewards[k] == pytest.approx(reward)


def test_people_are_read_back_from_the_observation() -> None:
    env = search_and_rescue("raw", robot="spot")
    observation, _ = env.reset(seed=5)
    for _ in range(100):
        observation, *_ = env.step([0.0, 0.0, 0.6])
    tracks = env.payload.people.tracks  # type: ignore[union-attr]
    seen = read_people(observation)
    assert [each.reported for each in seen] == [track.reported for track in tracks]
    assert all(0.0 <= each.probability <= 1.0 for each in seen)


def test_searchers_refuse_an_environment_without_detector() -> None:
    for name in ("searcher", "explorer"):
        env = SemNavEnv("spot", observation="all")
        start = env.reset(seed=0)
        with pytest.raises(ValueError, match="needs a person detector"):
            next(steps(env, make_agent(name), *start))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["searcher", "explorer"])
def test_a_house_is_searched(name: str) -> None:
    agent = make_agent(name)
    env = search_and_rescue(robot="spot", observation=agent.observation)
    *_, last = steps(env, agent, *env.reset(seed=1))
    assert last.info["is_success"]
    assert last.info["search"]["found"] == 2
    assert last.info["collisions"] == 0


def test_a_search_can_be_followed_by_another_clause() -> None:
    env = search_and_rescue("raw", robot="spot")
    command = Command((SearchHouse(), GoBack()))
    _, info = env.reset(seed=1, options={"command": command})
    assert info["command"] == "search the house and go back to the start"


def test_only_first_reports_of_victims_and_reports_of_nobody_are_worth_something(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    env = search_and_rescue("raw", robot="spot")
    env.reset(seed=1)
    search = env.payload
    assert isinstance(search, PersonSearch)
    victim = search._victims[0]
    places = [victim, (victim[0] + 0.3, victim[1]), (victim[0] + 50.0, victim[1])]
    worth = []
    for place in places:
        track = PersonTrack(to_local(search._frame, place), 5.0, 1.0, True)
        monkeypatch.setattr(search.people, "update", lambda *_, track=track: [track])
        search._step = 0
        search.update(env.simulator.motion, env.tracker)
        worth.append(search.reported)
    assert worth == [1, 0, -1]
