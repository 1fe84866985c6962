"""Frozen episodes in splits, for training and testing: start, command and right answer."""

from typing import TYPE_CHECKING

from semnav_env.judge.episodes.episode import Episode, Expected, StaleEpisodeError
from semnav_features.lazy_names import lazy_names

if TYPE_CHECKING:
    from semnav_env.judge.episodes.files import EpisodeFileError, read_episodes, write_episodes
    from semnav_env.judge.episodes.splits import (
        SPLITS,
        Split,
        evenly,
        find_episode,
        is_episodes,
        load_episodes,
    )

__all__ = [
    "SPLITS",
    "Episode",
    "EpisodeFileError",
    "Expected",
    "Split",
    "StaleEpisodeError",
    "evenly",
    "find_episode",
    "is_episodes",
    "load_episodes",
    "read_episodes",
    "write_episodes",
]

__getattr__ = lazy_names(
    __name__,
    {
        ".files": ("EpisodeFileError", "read_episodes", "write_episodes"),
        ".splits": ("SPLITS", "Split", "evenly", "find_episode", "is_episodes", "load_episodes"),
    },
)
