"""Demonstrations: the observations and actions of an agent, as a Minari dataset."""

from __future__ import annotations

import re
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.agents.base import Agent, steps
from semnav_env.env import SemNavEnv
from semnav_env.episodes import Episode

DATASET_NAME = re.compile(r"(?:[-_\w]+/)*[-_\w]+-v\d+")
"""The form of a dataset's name in Minari, such as "semnav/train-scripted-v0"."""


@dataclass(frozen=True, eq=False)
class Demonstration:
    """One driven episode of n steps.

    Attributes:
        episode: the frozen episode that was driven.
        observations: the entries of the observation by name, each of shape (n + 1, size).
        actions: shape (n, action size).
        rewards: shape (n,).
        terminations: shape (n,).
        truncations: shape (n,).
        success: whether the command was carried out.
    """

    episode: Episode
    observations: dict[str, NDArray[Any]]
    actions: NDArray[np.float32]
    rewards: NDArray[np.float64]
    terminations: NDArray[np.bool_]
    truncations: NDArray[np.bool_]
    success: bool


def demonstrate(env: SemNavEnv, agent: Agent, episode: Episode) -> Demonstration:
    """Let an agent drive a frozen episode, with its number as the seed, and record everything."""
    with episode.named_in_errors():
        first, info = env.reset(seed=episode.number, options={"episode": episode})
    driven = list(steps(env, agent, first, info))
    seen = [first, *(step.observation for step in driven)]
    return Demonstration(
        episode,
        {name: np.stack([each[name] for each in seen]) for name in first},
        np.stack([step.action for step in driven]),
        np.array([step.reward for step in driven]),
        np.array([step.terminated for step in driven]),
        np.array([step.truncated for step in driven]),
        bool(driven[-1].info["is_success"]),
    )


class DemonstrationFile:
    """A new Minari dataset; each demonstration is written at once.

    Args:
        out: a name such as "semnav/train-scripted-v0", by which Minari finds it, or a folder.
        env: the environment, which gives the spaces of observations and actions.
        agent: name of the agent, for the description of the dataset.

    Raises:
        ImportError: Minari is not installed; the error names the extra.
        FileExistsError: there is already a dataset of that name, or something in that folder.
    """

    def __init__(self, out: str, env: SemNavEnv, agent: str) -> None:
        try:
            import h5py  # noqa: F401 - Minari fails late without it
            import minari
            from minari.dataset.minari_storage import MinariStorage
            from minari.storage import get_dataset_path
        except ImportError:
            raise ImportError(
                'demonstrations are kept by minari and h5py: pip install "semnav-env[data]"'
            ) from None
        named = DATASET_NAME.fullmatch(out) is not None
        self.folder = Path(get_dataset_path(out) if named else out).absolute()
        if self.folder.exists() and (not self.folder.is_dir() or any(self.folder.iterdir())):
            raise FileExistsError(
                17, "there is something already; give another name or folder", str(self.folder)
            )
        data = self.folder / "data"
        data.mkdir(parents=True, exist_ok=True)
        self._storage = MinariStorage.new(data, env.observation_space, env.action_space)
        self._storage.update_metadata(
            {
                "dataset_id": out if named else f"semnav/{agent_word(agent)}-v0",
                "minari_version": minari.__version__,
                "algorithm_name": agent,
                "description": f"{agent} on {env.robot.name} in frozen episodes of semnav-env",
            }
        )

    def add(self, demonstration: Demonstration) -> None:
        """Write a demonstration; an interruption waits until it is complete."""
        from minari.data_collector.episode_buffer import EpisodeBuffer

        episode = demonstration.episode
        buffer = EpisodeBuffer(
            seed=episode.number,
            options={
                "episode": episode.id,
                "command": episode.command,
                "floor_plan": episode.floor_plan,
                "success": demonstration.success,
            },
            observations=demonstration.observations,
            actions=demonstration.actions,
            rewards=demonstration.rewards.tolist(),
            terminations=demonstration.terminations.tolist(),
            truncations=demonstration.truncations.tolist(),
        )
        with _uninterrupted():
            self._storage.update_episodes([buffer])

    @property
    def count(self) -> int:
        """Number of demonstrations in the file, counted there."""
        import h5py

        with h5py.File(self.folder / "data" / "main_data.hdf5", "r") as file:
            return len(file)


def agent_word(agent: str) -> str:
    """The name of an agent, without characters that the name of a dataset cannot have."""
    return re.sub(r"[^-_\w]+", "_", Path(agent).name) or "agent"


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Delay an interruption from the keyboard until the end of the block."""
    held: list[int] = []
    try:
        before = signal.signal(signal.SIGINT, lambda number, _: held.append(number))
    except ValueError:  # not the main thread, which alone gets interruptions
        yield
        return
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        if held:
            raise KeyboardInterrupt
