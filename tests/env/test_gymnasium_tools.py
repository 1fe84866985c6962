"""What Gymnasium's own tools ask of an environment."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from typing import Any

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.envs.registration import EnvSpec
from gymnasium.wrappers import FlattenObservation, TimeAwareObservation

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import RewardWeights
from semnav_env.plain_settings import SETTINGS, from_plain
from semnav_env.robots import SPOT, WHEELCHAIR
from semnav_env.rules import Rules, SuccessRules
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.dynamics.settings import Walking
from semnav_env.world.simulator import OdometrySettings
from semnav_features import ExtractorSettings
from semnav_features.lidars import TIM561
from tests.support.episodes import START, actions, digest, rollout

ID = "semnav_env:SemNav-v0"
GIVEN: dict[str, Any] = {
    "robot": replace(SPOT, mass=30.0, lidar_mount=(0.2, 0.1, 0.0)),
    "lidar": replace(TIM561, sigma=0.01),
    "odometry": OdometrySettings(distance_bias=0.03),
    "extractor": ExtractorSettings(rupture_range=7.0),
    "rewards": RewardWeights(time=-0.02),
    "dynamics": Dynamics(pedestrians=1, walking=Walking(radius=0.2)),
    "rules": Rules(success=SuccessRules(door_distance=0.6)),
}


def test_every_settings_class_survives_plain_dictionaries() -> None:
    assert GIVEN.keys() == SETTINGS.keys()
    for name, value in GIVEN.items():
        plain = json.loads(json.dumps(asdict(value)))
        assert from_plain(plain, SETTINGS[name]) == value


def test_a_spec_with_settings_survives_json_and_makes_the_same() -> None:
    env = gym.make(ID, **GIVEN, max_seconds=20.0)
    assert env.spec is not None
    text = env.spec.to_json()
    assert "max_episode_steps=300" in str(env.spec.pprint(disable_print=True))
    other = gym.make(EnvSpec.from_json(text))
    assert other.spec is not None
    assert other.spec.to_json() == text
    seen = []
    for each in (env.unwrapped, other.unwrapped):
        assert isinstance(each, SemNavEnv)
        each.reset(seed=4, options=START)
        seen.append(digest(rollout(each, actions(30, 3))))
    assert seen[0] == seen[1]


@pytest.mark.parametrize(
    ("settings", "problem"),
    [
        (
            {"odometry": {"turn_bais": 0.1}},
            "no odometry named .*turn_bais",
        ),
        ({"odometry": asdict(OdometrySettings()) | {"turn_bias": -1.0}}, "turn_bias is -1.0"),
        ({"robot": {"name": "tank"}}, "no robot named .*tank"),
    ],
)
def test_a_wrong_dictionary_is_named(settings: dict[str, Any], problem: str) -> None:
    with pytest.raises(ValueError, match=problem):
        SemNavEnv(**settings)


def test_time_aware_observation_finds_the_time_limit() -> None:
    env = TimeAwareObservation(gym.make(ID, max_seconds=4.0), flatten=False)
    observation, _ = env.reset(seed=0)
    assert env.observation_space["time"].high == 60
    assert observation["time"] == 0
    over, steps = False, 0
    while not over:
        observation, _, terminated, truncated, _ = env.step(np.zeros(2, np.float32))
        over, steps = terminated or truncated, steps + 1
    assert observation["time"] == steps == 60


@pytest.mark.parametrize("name", ["SemNav-v0", "SearchAndRescue-v0"])
@pytest.mark.parametrize("mode", [None, "sync"])
def test_a_vector_of_environments_can_have_a_limit_of_steps(name: str, mode: str | None) -> None:
    envs = gym.make_vec(
        f"semnav_env:{name}", num_envs=2, vectorization_mode=mode, max_episode_steps=5
    )
    envs.reset(seed=0)
    ends = [envs.step(envs.action_space.sample())[3].tolist() for _ in range(5)]
    assert ends == [[False] * 2] * 4 + [[True] * 2]


def test_a_limit_of_steps_counts_actions_that_are_held_once() -> None:
    envs = gym.make_vec(ID, num_envs=1, max_episode_steps=3, repeat=2)
    envs.reset(seed=0)
    assert [envs.step(np.zeros((1, 2)))[3].tolist() for _ in range(3)] == [[False]] * 2 + [[True]]
    with pytest.raises(ValueError, match="max_episode_steps"):
        gym.make_vec(ID, num_envs=1, max_episode_steps=0)


def test_a_vector_can_be_made_from_any_spec() -> None:
    """A spec has a time limit once its environment is made, for `max_seconds` says which."""
    env = gym.make(ID, max_seconds=0.4)
    assert gym.spec("SemNav-v0").max_episode_steps is None
    assert env.spec is not None
    assert env.spec.max_episode_steps == 6
    vector = gym.make_vec(ID, num_envs=2, max_seconds=0.4)
    for spec in (env.spec, env.unwrapped.spec, vector.spec):
        assert spec is not None
        envs = gym.make_vec(spec, num_envs=2)
        envs.reset(seed=0)
        ends = [bool(envs.step(np.zeros((2, 2), np.float32))[3].all()) for _ in range(6)]
        assert ends == [False] * 5 + [True]


@pytest.mark.parametrize("mode", ["vector_entry_point", "sync"])
def test_the_training_id_draws_episodes_of_the_benchmark(mode: str) -> None:
    envs = gym.make_vec("semnav_env:SemNav-Train-v0", num_envs=3, vectorization_mode=mode)
    _, infos = envs.reset(seed=0)
    alone = [gym.make(ID, episodes="train").reset(seed=seed)[1] for seed in range(3)]
    for name in ("episode_id", "instruction", "floor_plan"):
        assert infos[name].tolist() == [info[name] for info in alone]
    assert len(set(infos["floor_plan"])) > 1
    assert all(each.startswith("train-") for each in infos["episode_id"])


@pytest.mark.parametrize("mode", ["semantic", "raw", "all"])
def test_a_flattened_observation_is_float32(mode: str) -> None:
    env = FlattenObservation(gym.make(ID, observation=mode))
    observation, _ = env.reset(seed=0)
    assert env.observation_space.dtype == observation.dtype == np.float32
    assert env.observation_space.contains(observation)


@pytest.mark.parametrize(("robot", "combinations"), [(WHEELCHAIR, 8), (SPOT, 26)])
def test_every_key_combination_is_an_action(robot: Any, combinations: int) -> None:
    env = SemNavEnv(robot)
    keys = env.get_keys_to_action()
    assert len(keys) == combinations
    assert all(action in env.action_space for action in keys.values())
    np.testing.assert_allclose(keys["w",][0], -keys["s",][0])
    np.testing.assert_allclose(keys["w", "a"], keys["w",] + keys["a",])


def test_gymnasiums_play_drives_by_the_keys(monkeypatch: pytest.MonkeyPatch) -> None:
    pygame = pytest.importorskip("pygame", reason="the extra 'render' is not installed")
    play = pytest.importorskip("gymnasium.utils.play")
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    steps = []

    def note(before: Any, after: Any, action: Any, *_: Any) -> None:
        steps.append(action)
        if len(steps) == 3:
            pygame.event.post(pygame.event.Event(pygame.KEYUP, key=pygame.K_w))
        if len(steps) == 5:
            pygame.event.post(pygame.event.Event(pygame.QUIT))

    pressed = pygame.event.Event(pygame.KEYDOWN, key=pygame.K_w)
    shown = play.PlayableGame.__init__

    def started(self: Any, *arguments: Any) -> None:
        shown(self, *arguments)
        pygame.event.post(pressed)

    monkeypatch.setattr(play.PlayableGame, "__init__", started)
    env = gym.make(ID, render_mode="rgb_array")
    play.play(env, callback=note, noop=np.zeros(2, np.float32), seed=0, fps=200)
    assert [float(step[0]) for step in steps] == [0.5, 0.5, 0.5, 0.0, 0.0]
