"""Frozen episodes: what is said where, and what is right; in splits, for training and testing."""

from semnav_env.episodes.episode import Episode, Expected, StaleEpisodeError
from semnav_env.episodes.files import EpisodeFileError, read_episodes, write_episodes
from semnav_env.episodes.splits import SPLITS, Split, evenly, is_episodes, load_episodes

__all__ = [
    "SPLITS",
    "Episode",
    "EpisodeFileError",
    "Expected",
    "Split",
    "StaleEpisodeError",
    "evenly",
    "is_episodes",
    "load_episodes",
    "read_episodes",
    "write_episodes",
]
