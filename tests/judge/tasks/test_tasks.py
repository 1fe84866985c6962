"""Tasks: what episodes are asked to be, given to the environment in many ways."""

from __future__ import annotations

import pickle
from dataclasses import replace

import gymnasium as gym
import numpy as np
import pytest

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import (
    AddedTerms,
    CommandTask,
    Curriculum,
    EpisodeRequest,
    FrozenEpisodes,
    RandomisedRobot,
    Task,
    as_task,
    wrapping,
)
from semnav_env.language import Command, Turn, Turning
from semnav_env.robots import SPOT, WHEELCHAIR, RobotSpec
from semnav_env.world.lidar import TIM561
from semnav_env.world.simulator import EXACT, OdometrySettings
from semnav_features.lidar_spec import LidarSpec

AROUND = "turn around"
LEFT = Command((Turn(Turning.LEFT, degrees=90),))
SLOW = replace(WHEELCHAIR, name="slow", max_speed=0.5)
NOISY = replace(TIM561, name="noisy", sigma=0.05)
VEERING = OdometrySettings(turn_bias=0.05)


class StopAt:
    """A task of somebody's own."""

    def __init__(self, pose: tuple[float, float, float]) -> None:
        self.pose = pose

    def request(self, rng: np.random.Generator) -> EpisodeRequest:
        return EpisodeRequest("stop", pose=self.pose)


def drawn_stop(rng: np.random.Generator) -> EpisodeRequest:
    return EpisodeRequest(f"wait for {rng.integers(1, 50)} seconds")


def commands_of(task: object, count: int = 6, seed: int = 0) -> list[str]:
    """The commands of the first episodes of an environment."""
    env = SemNavEnv(task=task)
    return [env.reset(seed=seed if n == 0 else None)[1]["command"] for n in range(count)]


@pytest.mark.parametrize("command", [AROUND, LEFT])
def test_a_command_is_the_task_of_every_episode(command: str | Command) -> None:
    assert commands_of(command, 2) == [str(command)] * 2


def test_a_list_of_commands_is_drawn_from() -> None:
    assert set(commands_of([AROUND, LEFT])) == {AROUND, str(LEFT)}


def test_a_task_recognises_the_language_as_reset_does() -> None:
    said = "geh durch die zweite Tür rechts"
    told = SemNavEnv(floor_plan="office_cross").reset(seed=0, options={"command": said})[1]
    again = SemNavEnv(floor_plan="office_cross", task=said).reset(seed=0)[1]
    assert again == told


def test_a_curriculum_takes_frozen_episodes_as_they_are() -> None:
    task = Curriculum([RandomisedRobot(FrozenEpisodes("test_real"), robots=(SLOW,)), None])
    info = SemNavEnv(task=task).reset(seed=0)[1]
    assert info["episode_id"].startswith("test_real-")
    assert info["robot"]["name"] == "slow"


def test_a_list_of_floor_plans_is_drawn_from() -> None:
    env = SemNavEnv(task=CommandTask((AROUND,), ("office_cross", "villa_hall")))
    plans = [env.reset(seed=seed)[1]["floor_plan"] for seed in range(6)]
    assert set(plans) == {"office_cross", "villa_hall"}


def test_a_function_is_called_for_each_episode() -> None:
    told = commands_of(drawn_stop)
    assert all(each.startswith("wait for") for each in told)
    assert len(set(told)) > 1


@pytest.mark.parametrize("task", [[AROUND, LEFT], drawn_stop, None])
def test_a_seed_gives_the_same_episodes(task: object) -> None:
    assert commands_of(task, seed=3) == commands_of(task, seed=3)


def test_a_task_of_ones_own_asks_for_pose_and_command() -> None:
    pose = (-2.5, -0.3, 0.24)
    env = SemNavEnv(task=StopAt(pose))
    info = env.reset(seed=0)[1]
    assert (info["command"], info["pose"]) == ("stop", pose)


def test_options_of_reset_go_before_the_task() -> None:
    assert SemNavEnv(task=AROUND).reset(options={"command": "stop"})[1]["command"] == "stop"


@pytest.mark.parametrize("value", [3, [], {}, [3], Task, StopAt, b"turn left", ["turn left", 3]])
def test_what_is_no_task_is_refused_with_what_would_do(value: object) -> None:
    with pytest.raises(ValueError, match="a command, a list of commands, a function"):
        as_task(value)
    with pytest.raises(ValueError, match="task is"):
        SemNavEnv(task=value)


def test_a_function_that_gives_no_request_is_refused() -> None:
    with pytest.raises(ValueError, match="EpisodeRequest"):
        SemNavEnv(task=lambda rng: "turn left").reset(seed=0)


def test_a_task_and_episodes_are_not_given_together() -> None:
    with pytest.raises(ValueError, match="not both"):
        SemNavEnv(task=AROUND, episodes="val_seen")
    with pytest.raises(ValueError, match="give floor_plan= or episodes=, not both"):
        SemNavEnv(floor_plan="office_cross", episodes="val_seen")


def test_a_curriculum_goes_on_when_enough_episodes_succeed() -> None:
    curriculum = Curriculum([AROUND, "stop"], promotion=0.5, window=4)
    for success in (True, False, False, False, True):
        curriculum.note(success)
        assert curriculum.stage == 0
    curriculum.note(True)
    assert curriculum.stage == 1
    for _ in range(8):
        curriculum.note(True)
    assert curriculum.stage == 1


def test_the_environment_tells_a_curriculum_how_episodes_end() -> None:
    """Waiting is done by standing still, so every episode succeeds."""
    curriculum = Curriculum(["wait for 1 second", AROUND], promotion=1.0, window=2)
    env = SemNavEnv(task=curriculum)
    told = []
    for seed in range(3):
        told.append(env.reset(seed=seed)[1]["command"])
        while "is_success" not in env.step(np.zeros(2))[4]:
            pass
    assert told == ["wait for 1 seconds", "wait for 1 seconds", AROUND]


def test_episodes_asked_for_by_options_do_not_count_for_a_curriculum() -> None:
    curriculum = Curriculum([AROUND, "stop"], window=1)
    env = SemNavEnv(task=curriculum)
    env.reset(seed=0, options={"command": "wait for 1 second"})
    while "is_success" not in env.step(np.zeros(2))[4]:
        pass
    assert curriculum.stage == 0


def test_an_episode_that_is_driven_on_counts_once_for_a_curriculum() -> None:
    curriculum = Curriculum(["wait for 1 second", AROUND], promotion=1.0, window=2)
    env = SemNavEnv(task=curriculum)
    env.reset(seed=0)
    ends = sum("is_success" in env.step(np.zeros(2))[4] for _ in range(30))
    assert ends > 2
    assert curriculum.stage == 0


def test_a_curriculum_that_hears_of_no_end_says_what_to_do(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A `TimeLimit` outside of the environment cuts episodes off unseen."""
    monkeypatch.setattr(wrapping, "MOST_UNHEARD", 2)
    curriculum = Curriculum([AROUND, "stop"], window=2)
    env = gym.make("semnav_env:SemNav-v0", task=curriculum, max_episode_steps=1)
    for seed in range(2):
        env.reset(seed=seed)
        assert env.step(np.zeros(2, np.float32))[3]
    with pytest.warns(RuntimeWarning, match="max_seconds= in place of max_episode_steps="):
        env.reset(seed=2)


@pytest.mark.parametrize("bad", [{"tasks": []}, {"promotion": 1.5}, {"window": 0}])
def test_a_curriculum_of_nothing_is_refused(bad: dict) -> None:
    with pytest.raises(ValueError, match="a curriculum has"):
        Curriculum(**{"tasks": [AROUND]} | bad)


def test_body_lidar_and_odometry_are_drawn_for_each_episode() -> None:
    task = RandomisedRobot(AROUND, ("wheelchair", SLOW), (TIM561, NOISY), (EXACT, VEERING))
    env, other = SemNavEnv(task=task), SemNavEnv(task=task)
    drawn = [_setup(env, seed) for seed in range(12)]
    assert {body for body, _, _ in drawn} == {WHEELCHAIR, SLOW}
    assert {lidar for _, lidar, _ in drawn} == {TIM561, NOISY}
    assert {odometry for _, _, odometry in drawn} == {EXACT, VEERING}
    assert [_setup(other, seed) for seed in range(12)] == drawn


def _setup(env: SemNavEnv, seed: int) -> tuple[object, ...]:
    info = env.reset(seed=seed)[1]
    return RobotSpec(**info["robot"]), LidarSpec(**info["lidar"]), env.setup.odometry


def test_the_drawn_body_is_the_one_that_drives() -> None:
    env = SemNavEnv(task=RandomisedRobot(AROUND, robots=(SLOW,)))
    env.reset(seed=0, options=None)
    for _ in range(30):
        info = env.step(np.array([1.0, 0.0]))[4]
    assert env.world.velocity[0] == pytest.approx(0.5, abs=0.02) or info["in_contact"]


@pytest.mark.parametrize(
    ("drawn", "words"),
    [
        ({"robots": (SPOT,)}, "spot takes 3 values as an action"),
        ({"lidars": ("barbret",)}, "beams 786; the environment's has 811"),
        ({"lidars": (replace(TIM561, rate_hz=40.0),)}, "rate_hz"),
    ],
)
def test_a_robot_that_does_not_fit_the_spaces_is_refused(drawn: dict, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        SemNavEnv(task=RandomisedRobot(AROUND, **drawn)).reset(seed=0)


def test_an_environment_with_a_task_goes_on_after_pickling() -> None:
    task = Curriculum([RandomisedRobot([AROUND, "stop"], lidars=(TIM561, NOISY)), drawn_stop])
    env = SemNavEnv(task=task)
    env.reset(seed=0)
    copy = pickle.loads(pickle.dumps(env))
    assert [_setup(env, seed) for seed in range(3)] == [_setup(copy, seed) for seed in range(3)]


def test_a_reward_term_that_is_no_number_is_named() -> None:
    env = SemNavEnv(rewards=AddedTerms({"silent": lambda tick: None}))  # type: ignore[arg-type,return-value]
    env.reset(seed=0)
    with pytest.raises(ValueError, match="'silent' is None; it must be a finite number"):
        env.step(np.zeros(2))
