"""Measures the processor time of starts, each in a process of its own."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile

from semnav_env.bench.timing import Part

_SEMNAV = ("-m", "semnav_scripts.main")
_EVERYTHING = """
import gymnasium
import numpy as np
name, many = "semnav_env:SemNav-v0", {"num_envs": 2, "vectorization_mode": "vector_entry_point"}
for observation in ("semantic", "command", "all", "raw"):
    envs = gymnasium.make_vec(name, **many, observation=observation)
    envs.reset(seed=0), envs.step(np.zeros((2, 2)))
    env = gymnasium.make(name, observation=observation)
    env.reset(seed=0)
    for _ in range(100):
        env.step(np.array((0.5, 0.1)))
"""

STARTS: dict[str, tuple[str, ...]] = {
    "import semnav_env": ("-c", "import semnav_env"),
    "import semnav_env; gymnasium.make": (
        "-c",
        "import semnav_env, gymnasium; gymnasium.make('SemNav-v0')",
    ),
    "semnav --help": (*_SEMNAV, "--help"),
    "semnav map list": (*_SEMNAV, "map", "list"),
    "semnav ground": (
        *_SEMNAV,
        "ground",
        "the second door on the right",
        "--pose=-2.5,-0.3,0.24",
    ),
    "an environment's first reset": (
        "-c",
        "import gymnasium; gymnasium.make('semnav_env:SemNav-v0').reset(seed=0)",
    ),
}
"""What Python is called with, by name."""


def start_parts() -> list[Part]:
    """Processor time of whole processes whose kernels are in the cache."""
    return [
        Part(name, lambda words=words: _seconds(words))  # type: ignore[misc]
        for name, words in STARTS.items()
    ]


def compile_seconds() -> float:
    """Processor time, seconds, to compile single and vector environments, with all observations.

    The process uses an empty cache folder in place of the user's.
    """
    with tempfile.TemporaryDirectory() as folder:
        return _seconds(("-c", _EVERYTHING), {"SEMNAV_CACHE_DIR": folder})


def _seconds(words: tuple[str, ...], variables: dict[str, str] | None = None) -> float:
    """Processor time of a call of Python, seconds."""
    before = os.times()
    subprocess.run(
        [sys.executable, *words],
        env={**os.environ, **(variables or {})},
        check=True,
        capture_output=True,
    )
    after = os.times()
    return sum(after[2:4]) - sum(before[2:4])
