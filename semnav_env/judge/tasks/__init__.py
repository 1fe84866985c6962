"""Tasks: the requests of episodes, their missions, and their rewards."""

from typing import TYPE_CHECKING

from semnav_env.judge.tasks.episode_source import EpisodeSource
from semnav_env.judge.tasks.mission_maker import MissionMaker
from semnav_env.judge.tasks.request import EpisodeRequest
from semnav_env.judge.tasks.rewards import (
    Rewards,
    RewardTerm,
    RewardWeights,
    Tick,
    as_rewards,
    terms_of,
    weigh,
)
from semnav_env.judge.tasks.task import AdaptiveTask, CommandTask, SampledTask, Task, as_task
from semnav_features.lazy_names import lazy_names

if TYPE_CHECKING:
    from semnav_env.judge.tasks.added_terms import AddedTerms
    from semnav_env.judge.tasks.frozen import Episodes, FrozenEpisodes
    from semnav_env.judge.tasks.wrapping import Curriculum, RandomisedRobot

__all__ = [
    "AdaptiveTask",
    "AddedTerms",
    "CommandTask",
    "Curriculum",
    "EpisodeRequest",
    "EpisodeSource",
    "Episodes",
    "FrozenEpisodes",
    "MissionMaker",
    "RandomisedRobot",
    "RewardTerm",
    "RewardWeights",
    "Rewards",
    "SampledTask",
    "Task",
    "Tick",
    "as_rewards",
    "as_task",
    "terms_of",
    "weigh",
]

__getattr__ = lazy_names(
    __name__,
    {
        ".added_terms": ("AddedTerms",),
        ".frozen": ("Episodes", "FrozenEpisodes"),
        ".wrapping": ("Curriculum", "RandomisedRobot"),
    },
)
