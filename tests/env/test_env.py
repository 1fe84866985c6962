"""The environment keeps Gymnasium's contract, and answers bad input with one clear error."""

from __future__ import annotations

import math
import subprocess
import sys
from importlib.metadata import version
from itertools import product

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import semnav_env
from semnav_env.env import SemNavEnv
from semnav_env.language import CommandError
from semnav_env.mind.grounding import GroundingError
from semnav_env.mind.observations import MODES
from semnav_env.robots import ROBOTS
from semnav_env.world.maps import bundled_names
from semnav_features.memory import SceneMemory
from tests.support.episodes import START, actions, fresh

CROSS = {"floor_plan": "office_cross"}
IDS = [name for name, spec in gym.registry.items() if "semnav_env" in str(spec.entry_point)]


def test_importing_the_package_registers_it() -> None:
    assert IDS == ["SemNav-v0", "SemNav-Train-v0", "SearchAndRescue-v0"]


def test_the_package_says_its_version() -> None:
    assert semnav_env.__version__ == version("semnav-env")
    assert not hasattr(semnav_env, "__verzion__")


@pytest.mark.parametrize(("name", "robot", "mode"), list(product(IDS, ROBOTS, MODES)))
def test_every_registered_id_passes_the_checker(name: str, robot: str, mode: str) -> None:
    env = gym.make(f"semnav_env:{name}", robot=robot, observation=mode)
    check_env(env.unwrapped, skip_render_check=True)


@pytest.mark.parametrize("name", IDS)
def test_the_passive_checker_has_nothing_to_say(name: str) -> None:
    """It looks at the first calls alone, and would warn, which is an error here."""
    env = gym.make(f"semnav_env:{name}", disable_env_checker=False, render_mode="rgb_array")
    env.reset(seed=0)
    for _ in range(2):
        env.step(env.action_space.sample())
    env.render()
    env.close()


@pytest.mark.parametrize(("plan", "robot"), list(product(bundled_names(), ROBOTS)))
def test_random_episodes_stay_within_the_spaces(plan: str, robot: str) -> None:
    env = SemNavEnv(robot, plan, observation="all", max_seconds=4.0)
    for seed in range(3):
        observation, _ = env.reset(seed=seed)
        assert env.observation_space.contains(observation)
        for action in actions(70, env.robot.action_size, seed):
            observation, reward, terminated, truncated, info = env.step(action)
            assert env.observation_space.contains(observation)
            assert np.isfinite(reward)
            assert reward == pytest.approx(sum(info["reward_terms"].values()))
            if terminated or truncated:
                assert "is_success" in info
                break


def test_an_episode_ends_at_the_time_limit_and_says_so() -> None:
    env = SemNavEnv(max_seconds=1.0)
    env.reset(seed=0, options=START)
    ends = [env.step(np.array([0.1, 0.0]))[2:] for _ in range(15)]
    assert [truncated for _, truncated, _ in ends] == [False] * 14 + [True]
    assert ends[-1][2]["verdicts"] == ("out of time",)


def test_an_argument_that_there_is_not_is_answered_with_the_nearest() -> None:
    with pytest.raises(TypeError, match="no argument 'floorplan'; did you mean 'floor_plan'"):
        gym.make("semnav_env:SemNav-v0", floorplan="office_cross")
    with pytest.raises(TypeError, match="no argument 'zebra'; there are: robot, floor_plan, "):
        SemNavEnv(zebra=1)  # type: ignore[call-arg]


def test_an_episode_that_is_out_of_time_stays_truncated() -> None:
    env = SemNavEnv(max_seconds=1.0)
    env.reset(seed=0, options=START)
    ends = [env.step(np.array([0.1, 0.0]))[2:] for _ in range(18)][-4:]
    assert [(terminated, truncated) for terminated, truncated, _ in ends] == [(False, True)] * 4
    assert {info["verdicts"] for _, _, info in ends} == {("out of time",)}
    env.reset(seed=0, options=START)
    assert env.step(np.array([0.1, 0.0]))[2:4] == (False, False)


def test_standing_still_ends_as_stopped_short() -> None:
    env = fresh()
    for _ in range(200):
        *_, terminated, _, info = env.step(np.zeros(2))
        if terminated:
            break
    assert info["verdicts"] == ("stopped short",)


def test_a_robot_that_came_to_rest_has_looked_from_there(monkeypatch) -> None:
    """What it could not see on the way it may see from where it stands now."""
    env = fresh("semantic", command="go to the end of the hallway", pose=START["pose"])
    monkeypatch.setattr(SceneMemory, "size", property(lambda memory: (1, 1)))  # nothing new
    follower, looked_from = env.tracker.follower, []
    look = follower.look
    monkeypatch.setattr(
        follower, "look", lambda scene, pose: (looked_from.append(pose), look(scene, pose))
    )
    for forward in np.repeat((0.0, 0.3, 0.0), (60, 20, 60)):
        env.step(np.array([forward, 0.0], dtype=np.float32))
    at_rest = env.simulator.odometry.pose
    assert math.hypot(*at_rest[:2]) > 0.4
    assert math.dist(looked_from[-1][:2], at_rest[:2]) < 0.2


def test_driving_into_a_wall_is_counted_once() -> None:
    env = fresh("semantic", command="turn around", pose=(-2.5, -0.3, 0.24 + 1.4))
    infos = [env.step(np.array([0.6, 0.0]))[4] for _ in range(45)]
    assert infos[-1]["in_contact"]
    assert infos[-1]["collisions"] == 1
    assert infos[-1]["reward_terms"]["contact"] < 0


@pytest.mark.parametrize(
    ("action", "words"),
    [
        ([np.nan, 0.0], "finite"),
        ([np.inf, 0.0], "finite"),
        ([0.0], "shape"),
        ([0.0, 0.0, 0.0], "shape"),
        ([[0.0, 0.0]], "shape"),
    ],
)
def test_bad_actions_are_refused_and_leave_the_world_alone(action: list, words: str) -> None:
    env = fresh()
    pose = env.world.pose
    with pytest.raises(ValueError, match=words):
        env.step(action)
    assert env.world.pose == pose


def test_actions_out_of_range_are_clipped() -> None:
    one, other = fresh(), fresh()
    for _ in range(20):
        far, near = one.step(np.array([7.0, -3.0]))[0], other.step(np.array([1.0, -1.0]))[0]
    assert all(np.array_equal(far[name], near[name]) for name in far)


@pytest.mark.parametrize(
    ("options", "error", "words"),
    [
        ({"comand": "stop"}, ValueError, "there are: command"),
        ({"command": 3}, ValueError, "text or a Command"),
        ({"command": ""}, CommandError, "empty"),
        ({"command": "sing a song"}, CommandError, "sing"),
        (START | {"command": "go through the fourth door on the right"}, GroundingError, "after 3"),
        (START | {"pose": (-2.5, 0.9, 0.24)}, ValueError, "start pose"),
        (START | {"pose": (500.0, 0.0, 0.0)}, ValueError, "start pose"),
        (START | {"pose": (np.nan, 0.0, 0.0)}, ValueError, "a pose is"),
        (START | {"pose": (1.0, 2.0)}, ValueError, "x, y, heading"),
        (START | {"pose": (-2.5, -0.3, 90.0)}, ValueError, "radians"),
        ({"command": "go to room east south 2"} | CROSS, ValueError, "out: .*no open door leads"),
        (
            {"command": "fahr in Raum east south 2"} | CROSS,
            ValueError,
            'kein Start .*"fahr in Raum .*dorthin führt keine offene Tür: die Tür von .* ist zu',
        ),
        (
            {"command": "take the twentieth door"} | CROSS,
            ValueError,
            "out: no twentieth door: .* after",
        ),
        ({"episode": {}}, ValueError, "no episode {}"),
        ({"floor_plan": "heidelberg_halway"}, ValueError, "heidelberg_hallway"),
    ],
)
def test_bad_options_get_one_clear_error(options: dict, error: type, words: str) -> None:
    with pytest.raises(error, match=words):
        fresh("semantic", **options)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"robot": "tank"}, "wheelchair"),
        ({"floor_plan": "moon_base"}, "office_cross"),
        ({"observation": "psychic"}, "semantic"),
        ({"lidar": "radar"}, "tim561"),
        ({"render_mode": "ascii"}, "rgb_array"),
        ({"max_seconds": -1.0}, "a number from 0.001"),
        ({"max_seconds": float("nan")}, "a number from 0.001"),
        ({"max_seconds": "60"}, "max_seconds is '60'; it must be a number"),
    ],
)
def test_bad_arguments_list_what_would_have_worked(arguments: dict, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        SemNavEnv(**arguments)


@pytest.mark.parametrize("value", [{}, 3, [3], "x"])
@pytest.mark.parametrize(
    ("name", "right"),
    [
        ("robot", "there are: wheelchair"),
        ("floor_plan", "name"),
        ("observation", "there are: semantic"),
        ("lidar", "there are: tim561"),
        ("odometry", "there are: usual, exact"),
        ("extractor", "it must be a semnav_features.settings.ExtractorSettings"),
        ("rewards", "it must be a semnav_env.judge.tasks.RewardWeights"),
        ("dynamics", "it must be a semnav_env.world.dynamics.settings.Dynamics"),
        ("render_mode", "there are: rgb_array"),
        ("episodes", "name of a split|no split|Episode"),
    ],
)
def test_an_argument_of_another_kind_names_the_right_one(
    name: str, right: str, value: object
) -> None:
    with pytest.raises(ValueError, match=right):
        SemNavEnv(**{name: value})  # type: ignore[arg-type]


def test_stepping_before_a_reset_is_an_error() -> None:
    with pytest.raises(RuntimeError, match="reset"):
        SemNavEnv().step(np.zeros(2))


def test_the_floor_plan_can_change_from_episode_to_episode() -> None:
    env = fresh("semantic")
    env.reset(seed=1, options={"floor_plan": "office_cross"})
    assert env.floor_plan.name == "office_cross"
    env.reset(seed=1)
    assert env.floor_plan.name == "heidelberg_hallway"


def test_it_renders_without_a_display() -> None:
    code = (
        "import gymnasium as gym; "
        "env = gym.make('semnav_env:SemNav-v0', render_mode='rgb_array'); "
        "env.reset(seed=0); print(env.render().shape)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=_no_display()
    )
    assert done.stdout.strip() == "(720, 960, 3)"


def _no_display() -> dict[str, str]:
    import os

    hidden = ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER")
    return {name: value for name, value in os.environ.items() if name not in hidden}


@pytest.mark.parametrize("mode", ["sync", "async"])
def test_it_runs_in_gymnasiums_vector_environments(mode: str) -> None:
    envs = gym.make_vec(
        "semnav_env:SemNav-v0", num_envs=2, vectorization_mode=mode, max_seconds=1.0
    )
    try:
        envs.reset(seed=0)
        for _ in range(40):
            observation, *_ = envs.step(envs.action_space.sample())
        assert envs.observation_space.contains(observation)
    finally:
        envs.close()


def test_a_failed_reset_leaves_nothing_to_step() -> None:
    env = fresh("semantic")
    with pytest.raises(GroundingError):
        env.reset(options=START | {"command": "go through the ninth door on the right"})
    with pytest.raises(RuntimeError, match="reset"):
        env.step(np.zeros(2))


def test_a_refused_first_reset_can_be_followed_by_another() -> None:
    env = gym.make("semnav_env:SemNav-v0")
    with pytest.raises(CommandError):
        env.reset(options={"command": "blargh"})
    env.reset(seed=0, options={"command": "turn left"})
    env.step(env.action_space.sample())


@pytest.mark.parametrize("steps", ["no", 0, [True]])
def test_implicit_steps_that_are_neither_true_nor_false_are_refused(steps: object) -> None:
    with pytest.raises(ValueError, match=r"implicit_steps is .*; it must be True or False"):
        SemNavEnv().reset(options={"implicit_steps": steps})


def test_options_that_are_no_dict_are_refused() -> None:
    with pytest.raises(ValueError, match="options are a dict"):
        SemNavEnv().reset(options="turn left")  # type: ignore[arg-type]


def test_a_reset_in_the_same_floor_makes_no_new_simulator() -> None:
    env = SemNavEnv()
    env.reset(seed=0, options=START)
    before = env.simulator
    env.reset(seed=1, options=START)
    assert env.simulator is before


def test_rendering_before_a_reset_is_an_error() -> None:
    with pytest.raises(RuntimeError, match=r"call reset\(\) before render\(\)"):
        SemNavEnv(render_mode="rgb_array").render()
