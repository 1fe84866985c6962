"""What an episode is about: its start, its command, its rewards and its end."""

from semnav_env.tasks.rewards import RewardWeights
from semnav_env.tasks.task import CommandTask

__all__ = ["CommandTask", "RewardWeights"]
