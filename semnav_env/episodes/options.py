"""What `reset` is asked for: a frozen episode, or its parts one by one."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from semnav_env.commands import parse
from semnav_env.episodes.episode import Episode, Expected
from semnav_env.episodes.splits import load_episodes
from semnav_env.settings import check_kind

Episodes: TypeAlias = str | Path | Sequence[Episode]
"""The name of a split, the path of a file, or episodes."""

OPTIONS = ("command", "language", "implicit_steps", "pose", "floor_plan", "episode")

PARTS = OPTIONS[:-1]
"""What an episode says; not to be given beside one."""


class EpisodeOptions:
    """Checks the options of `reset`, and fills in what an episode says.

    Args:
        episodes: a split, a file, or episodes to draw from where no part is given; None for none.

    Raises:
        ValueError: no such split, no episodes, or ambiguous ones, which nobody can carry out.
    """

    def __init__(self, episodes: Episodes | None) -> None:
        self._episodes = {episode.id: episode for episode in map(_drivable, _read(episodes))}
        self._ids = tuple(self._episodes)
        self.info: dict[str, str] = {}

    def complete(self, options: dict[str, Any] | None, rng: np.random.Generator) -> dict[str, Any]:
        """The options with "command", "pose", "floor_plan" and "feasible" of an episode.

        Args:
            options: as `reset` gets them; "episode" is an id or an `Episode`.
            rng: draws an episode where no part of one is given.

        Raises:
            ValueError: options that are unknown or contradict each other, or an unknown episode.
            StaleEpisodeError: the floor plan has changed since the episode was made.
        """
        if not isinstance(options, dict | None):
            raise ValueError(f"options are a dict with {', '.join(OPTIONS)}, not {options!r}")
        given = dict(options or {})
        for unknown in given.keys() - set(OPTIONS):
            raise ValueError(f"no option {unknown!r}; there are: {', '.join(OPTIONS)}")
        wanted, self.info = given.pop("episode", None), {}
        if wanted is None and self._ids and not given.keys() & set(PARTS):
            wanted = self._ids[int(rng.integers(len(self._ids)))]
        if wanted is None:
            return given
        for part in given:
            raise ValueError(f"an episode has its own {part}; leave {part!r} out")
        episode = self._episode(wanted)
        plan, self.info = episode.plan(), {"episode_id": episode.id}
        return {
            "command": parse(episode.command, episode.language, plan.room_names),
            "implicit_steps": False,  # all that is to be done has been said
            "pose": episode.start,
            "floor_plan": episode.floor_plan,
            "feasible": episode.expected is not Expected.INFEASIBLE,
        }

    def _episode(self, wanted: object) -> Episode:
        if isinstance(wanted, Episode):
            return _drivable(wanted)
        if wanted in self._ids:
            return self._episodes[str(wanted)]
        there = f"{self._ids[0]} to {self._ids[-1]}" if self._ids else "none: give episodes="
        raise ValueError(f"no episode {wanted!r:.80}; there are: {there}")


def _read(episodes: object) -> Sequence[Episode]:
    if episodes is None:
        return ()
    if isinstance(episodes, str | Path):
        return load_episodes(episodes)
    if not isinstance(episodes, Sequence):
        right = "the name of a split, the path of a file, or a list of Episodes"
        raise ValueError(f"episodes is {episodes!r:.80}; it must be {right}")
    if not episodes:
        raise ValueError("there are no episodes to draw from")
    return episodes


def _drivable(episode: Episode) -> Episode:
    check_kind("an episode", episode, Episode)
    if episode.expected is Expected.AMBIGUOUS:
        raise ValueError(
            f'{episode.id}: "{episode.command}" can mean {len(episode.readings)} things, so nobody '
            "can carry it out; ask an interpreter what it means"
        )
    return episode
