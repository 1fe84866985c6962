"""semnav-env: a Gymnasium environment for semantic indoor navigation.

Importing it registers `SemNav-Train-v0`, which draws the episodes of the split `train`,
`SemNav-v0`, which draws commands in one floor plan, and `SearchAndRescue-v0`; say
`gymnasium.make("semnav_env:SemNav-Train-v0")` to do both. No spec has a time limit before it is
made: `max_seconds` and the lidar say how many steps an episode has at most.
"""

from typing import Any

import gymnasium

__version__: str

_SEMNAV: dict[str, Any] = {
    "entry_point": "semnav_env.env:SemNavEnv",
    "vector_entry_point": "semnav_env.vector:SemNavVectorEnv",
}

# Gymnasium's passive checker fails in the first step after a first reset that was refused
# (1.4.0: "cannot unpack non-iterable NoneType"), and looks at one step alone. What is not the
# environment's own is looked at in every step instead: see `observations.check_observation`.
gymnasium.register("SemNav-v0", disable_env_checker=True, **_SEMNAV)

gymnasium.register(
    "SemNav-Train-v0", disable_env_checker=True, kwargs={"episodes": "train"}, **_SEMNAV
)

gymnasium.register(
    "SearchAndRescue-v0",
    entry_point="semnav_env.rescue.environment:search_and_rescue",
    vector_entry_point="semnav_env.rescue.environment:search_and_rescue_vector",
    disable_env_checker=True,
)


def __getattr__(name: str) -> str:
    """The version, read from the installed package when it is asked for."""
    if name != "__version__":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib.metadata import version

    return version("semnav-env")
