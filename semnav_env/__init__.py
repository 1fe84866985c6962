"""semnav-env: a Gymnasium environment for semantic indoor navigation.

Importing it registers `SemNav-v0` and `SearchAndRescue-v0`; say
`gymnasium.make("semnav_env:SemNav-v0")` to do both.
"""

import gymnasium

gymnasium.register(
    "SemNav-v0",
    entry_point="semnav_env.env:SemNavEnv",
    vector_entry_point="semnav_env.vector:SemNavVectorEnv",
    disable_env_checker=True,  # it cannot step after a first reset that was refused
)

gymnasium.register(
    "SearchAndRescue-v0",
    entry_point="semnav_env.rescue.environment:search_and_rescue",
    vector_entry_point="semnav_env.rescue.environment:search_and_rescue_vector",
    disable_env_checker=True,
)
