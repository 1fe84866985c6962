"""semnav-env: a Gymnasium environment for semantic indoor navigation.

Importing it registers `SemNav-Train-v0`, which draws the episodes of the split `train`,
`SemNav-v0`, which draws commands in one floor plan, and `SearchAndRescue-v0`.
`gymnasium.make("semnav_env:SemNav-Train-v0")` imports the package and makes an environment. The
spec of an environment has no time limit before the environment is made, because the largest number
of steps follows from `max_seconds` and the lidar.

Names are loaded at their first use. A robot that needs `BeliefTracker` and `parse` loads no
simulator.
"""

from typing import TYPE_CHECKING, Any

import gymnasium

from semnav_features.lazy_names import lazy_names

if TYPE_CHECKING:
    from semnav_env.env import SemNavEnv
    from semnav_env.judge.tasks import RewardWeights
    from semnav_env.language import parse
    from semnav_env.mind.belief import BeliefTracker
    from semnav_env.mind.grounding.ground import ground
    from semnav_env.robots import RobotSpec, robot_spec
    from semnav_env.rules import Rules
    from semnav_env.version import __version__
    from semnav_env.world.maps import generate_office, load_floor_plan
    from semnav_features.lidar_spec import LidarSpec
    from semnav_features.lidars import lidar_spec

__all__ = [
    "BeliefTracker",
    "LidarSpec",
    "RewardWeights",
    "RobotSpec",
    "Rules",
    "SemNavEnv",
    "__version__",
    "generate_office",
    "ground",
    "lidar_spec",
    "load_floor_plan",
    "parse",
    "robot_spec",
]

__getattr__ = lazy_names(
    __name__,
    {
        ".mind.belief": ("BeliefTracker",),
        ".language": ("parse",),
        ".env": ("SemNavEnv",),
        ".mind.grounding.ground": ("ground",),
        ".world.maps": ("generate_office", "load_floor_plan"),
        ".robots": ("RobotSpec", "robot_spec"),
        ".rules": ("Rules",),
        ".judge.tasks": ("RewardWeights",),
        ".version": ("__version__",),
        "semnav_features.lidar_spec": ("LidarSpec",),
        "semnav_features.lidars": ("lidar_spec",),
    },
)

# Gymnasium's passive checker stays off, because it cannot follow a first `reset` that is refused,
# as any command may be: in Gymnasium 1.4.0 the first step after the next `reset` then ends in
# "cannot unpack non-iterable NoneType object". It has no other complaint (`tests/env/test_env.py`).
_SEMNAV: dict[str, Any] = {
    "entry_point": "semnav_env.env:SemNavEnv",
    "vector_entry_point": "semnav_env.vector:SemNavVectorEnv",
    "disable_env_checker": True,
}

gymnasium.register("SemNav-v0", **_SEMNAV)
gymnasium.register("SemNav-Train-v0", kwargs={"episodes": "train"}, **_SEMNAV)
gymnasium.register(
    "SearchAndRescue-v0",
    entry_point="semnav_env.rescue.environment:search_and_rescue",
    vector_entry_point="semnav_env.rescue.environment:search_and_rescue_vector",
    disable_env_checker=True,
)
