"""The environments of the learning track for stable-baselines3, and its measure of success."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray
from stable_baselines3.common.vec_env import VecEnv, VecEnvWrapper, VecMonitor
from stable_baselines3.common.vec_env.base_vec_env import VecEnvStepReturn

from semnav_agents.learning.preset_envs import dealt
from semnav_agents.learning.sb3_vec_env import as_sb3_vec_env
from semnav_env.judge.episodes import Episode, load_episodes
from semnav_env.judge.metrics import spl
from semnav_env.judge.tasks import RewardWeights
from semnav_env.vector import SemNavVectorEnv
from studies.learning.heard_vector import LARGEST, SIZE, HeardVectors

Array = NDArray[np.float32]
Decide = Callable[[Array, NDArray[np.bool_]], Array]
"""Gives actions (n, 3) for vectors (n, SIZE); the mask says which robots have begun an episode."""

ROBOT, REPEAT, CONTROL_HZ = "wheelchair", 3, 15.0
"""The body; steps of the environment for which a decision holds; steps in a simulated second."""

MAX_SECONDS = 100.0
"""Time limit of an episode, in training and in measuring, simulated seconds."""

REWARDS = RewardWeights(contact=-1.0)
"""As of the presets of `semnav train`."""

ACTION_SIZE = 3
"""Forward, yaw, and the finger, which moves on where this is above 0."""

OPTIONS: dict[str, Any] = {
    "robot": ROBOT,
    "repeat": REPEAT,
    "max_seconds": MAX_SECONDS,
    "rewards": REWARDS,
    "threads": 1,
}


class CommandVecEnv(VecEnvWrapper):
    """Robots that are seen as vectors, and whose last action value moves the finger.

    Args:
        venv: environments with `observation="command"`.
    """

    def __init__(self, venv: VecEnv) -> None:
        action = Box(-1.0, 1.0, (ACTION_SIZE,), np.float32)
        super().__init__(venv, Box(-LARGEST, LARGEST, (SIZE,), np.float32), action)
        self._vectors = HeardVectors(self.num_envs, REPEAT / CONTROL_HZ)

    def reset(self) -> Array:
        """Begin episodes."""
        self._vectors.forget(np.ones(self.num_envs, bool))
        self._seen: dict[str, NDArray[Any]] = self.venv.reset()  # type: ignore[assignment]
        return self._vectors.observe(self._seen)

    def step_async(self, actions: Array) -> None:
        """Move fingers on, and drive."""
        self._vectors.advance(actions[:, -1] > 0.0, self._seen)
        self.venv.step_async(actions[:, :-1])

    def step_wait(self) -> VecEnvStepReturn:
        """Wait for the step; a last observation is seen with the finger where it was."""
        seen, rewards, over, infos = self.venv.step_wait()
        self._seen = seen  # type: ignore[assignment]
        last = {name: values.copy() for name, values in self._seen.items()}
        for k in np.flatnonzero(over).tolist():
            for name, entry in infos[k]["terminal_observation"].items():
                last[name][k] = entry
        vectors = self._vectors.observe(last)
        if over.any():
            for k in np.flatnonzero(over).tolist():
                infos[k]["terminal_observation"] = vectors[k].copy()
            self._vectors.forget(over)
            vectors = np.where(over[:, None], self._vectors.observe(self._seen), vectors)
        return vectors, rewards, over, infos


def training_envs(robots: int) -> VecMonitor:
    """Robots in the offices of `train`, each with offices of its own."""
    each = [{"episodes": part} for part in dealt(load_episodes("train"), robots)]
    envs = as_sb3_vec_env(robots, observation="command", each=each, **OPTIONS)
    return VecMonitor(CommandVecEnv(envs))


def measured(
    decide: Decide, episodes: Sequence[Episode], robots: int = 40
) -> Iterator[dict[str, Any]]:
    """Drive episodes once each, many at once.

    Yields:
        For each, as they end: id, clauses, success, contact_free, spl.
    """
    robots = min(robots, len(episodes))
    envs = SemNavVectorEnv(robots, observation="command", autoreset_mode="Disabled", **OPTIONS)
    waiting, running = iter(episodes), dict[int, Episode]()
    vectors, begun = HeardVectors(robots, REPEAT / CONTROL_HZ), np.zeros(robots, bool)

    def begin(index: int) -> None:
        episode = next(waiting, None)
        if episode is None:
            envs.rest(index)
            return
        envs.begin(index, episode.number, {"episode": episode})
        running[index], begun[index] = episode, True

    for k in range(robots):
        begin(k)
    seen = envs.observe()
    while running:
        vectors.forget(begun)
        actions = np.clip(decide(vectors.observe(seen), begun), -1.0, 1.0)
        begun[:] = False
        vectors.advance(actions[:, -1] > 0.0, seen)
        seen, _, terminated, truncated, infos = envs.step(actions[:, :-1])
        over = [k for k in np.flatnonzero(terminated | truncated).tolist() if k in running]
        for k in over:
            yield _row(running.pop(k), {name: infos[name][k] for name in _TOLD})
            begin(k)
        if over and running:
            seen = envs.observe()
    envs.close()


_TOLD = ("is_success", "collisions", "path_length", "route_length")


def _row(episode: Episode, info: dict[str, Any]) -> dict[str, Any]:
    success = bool(info["is_success"])
    ratio = spl(success, float(info["path_length"]), float(info["route_length"]))
    return {
        "episode": episode.id,
        "clauses": episode.clauses,
        "success": success,
        "contact_free": int(info["collisions"]) == 0,
        "spl": round(ratio, 4),
    }
