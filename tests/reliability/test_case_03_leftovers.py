"""Case 3: the rate of a lidar, tasks of one's own, small infos, resets that build nothing anew."""

from __future__ import annotations

import pickle
from dataclasses import replace
from typing import Any

import numpy as np

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import EpisodeRequest
from semnav_env.world.lidar import TIM561
from tests.support.episodes import START


class AlwaysStop:
    """A task of one's own."""

    def request(self, rng: np.random.Generator) -> EpisodeRequest:
        return EpisodeRequest(command="stop", pose=START["pose"])


def test_the_rate_of_the_lidar_is_that_of_control() -> None:
    env = SemNavEnv(lidar=replace(TIM561, rate_hz=5.0), max_seconds=10.0)
    env.reset(seed=0, options=START)
    env.step([0.0, 0.0])
    assert (env.seconds, env.max_steps, env.metadata["render_fps"]) == (0.2, 50, 5.0)


def test_a_task_of_ones_own_says_what_is_asked() -> None:
    _, info = SemNavEnv(task=AlwaysStop()).reset(seed=0)
    assert info["command"] == "stop"


def test_infos_are_small() -> None:
    env = SemNavEnv()
    infos: list[dict[str, Any]] = [env.reset(seed=0, options=START)[1]]
    infos += [env.step([1.0, 0.0])[4] for _ in range(5)]
    assert max(len(pickle.dumps(info)) for info in infos) < 3000


def test_a_reset_in_the_same_floor_makes_no_new_simulator() -> None:
    env = SemNavEnv()
    env.reset(seed=0, options=START)
    before = env.simulator
    env.reset(seed=1, options=START)
    assert env.simulator is before
