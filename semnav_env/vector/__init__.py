"""Many robots in one vector environment, driven in threads."""

from semnav_env.vector.numeric_infos import NumericInfos
from semnav_env.vector.vector_env import SemNavVectorEnv

__all__ = ["NumericInfos", "SemNavVectorEnv"]
