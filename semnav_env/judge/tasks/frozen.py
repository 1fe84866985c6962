"""Tasks of frozen episodes: a split, a file, or a list."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TypeAlias

import numpy as np

from semnav_env.judge.episodes.episode import Episode, Expected
from semnav_env.judge.tasks.request import EpisodeRequest
from semnav_features.validation import check_kind

Episodes: TypeAlias = str | Path | Sequence[Episode]
"""The name of a split, the path of a file, or episodes."""


class FrozenEpisodes:
    """Draws from frozen episodes.

    Args:
        episodes: a split, a file, or episodes.

    Raises:
        ValueError: no such split, no episodes, or ambiguous ones, which cannot be carried out.
    """

    def __init__(self, episodes: Episodes) -> None:
        self._episodes = {each.id: each for each in map(_drivable, _read(episodes))}
        self._ids = tuple(self._episodes)

    def request(self, rng: np.random.Generator) -> EpisodeRequest:
        """One of the episodes, each equally likely."""
        drawn = self._ids[int(rng.integers(len(self._ids)))]
        return EpisodeRequest(episode=self._episodes[drawn])

    def find(self, wanted: object) -> Episode:
        """The episode with an id.

        Raises:
            ValueError: there is none; names the first and the last.
        """
        if wanted in self._ids:
            return self._episodes[str(wanted)]
        raise ValueError(f"no episode {wanted!r:.80}; there are: {self._ids[0]} to {self._ids[-1]}")


def spelled_out(request: EpisodeRequest, episodes: FrozenEpisodes | None) -> EpisodeRequest:
    """Replace the episode of a request by its command, pose and floor plan.

    Args:
        request: for an episode.
        episodes: in which an id is looked up.

    Raises:
        ValueError: an unknown episode, or one that nobody can carry out.
        StaleEpisodeError: the floor plan has changed since the episode was made.
    """
    wanted = request.episode
    if isinstance(wanted, Episode):
        episode = _drivable(wanted)
    elif episodes is not None:
        episode = episodes.find(wanted)
    else:
        raise ValueError(f"no episode {wanted!r:.80}; there are: none: give episodes=")
    plan = episode.plan()
    return replace(
        request,
        episode=None,
        episode_id=episode.id,
        words=episode.command,
        command=episode.command_in(plan.room_names),
        language=episode.language,
        implicit_steps=False,  # all that is to be done has been said
        pose=episode.start,
        floor_plan=episode.floor_plan,
        feasible=episode.expected is not Expected.INFEASIBLE,
    )


def _read(episodes: object) -> Sequence[Episode]:
    if isinstance(episodes, str | Path):
        from semnav_env.judge.episodes.splits import load_episodes  # most environments need none

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
