"""Many robots in one environment: the calls of a single one, over all of them, on threads."""

from semnav_env.vector.numeric_infos import NumericInfos
from semnav_env.vector.vector_env import SemNavVectorEnv

__all__ = ["NumericInfos", "SemNavVectorEnv"]
