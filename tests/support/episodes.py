"""Driving about, the same way every time, for the tests of the environment."""

from __future__ import annotations

import hashlib
import json
import pickle
from collections.abc import Iterator
from typing import Any

import numpy as np

from semnav_env.env import SemNavEnv

COMMAND = "go through the second door on the right"
START = {"command": COMMAND, "pose": (-2.5, -0.3, 0.24)}


def actions(count: int, size: int, seed: int = 0) -> np.ndarray:
    """Slowly changing random actions that mostly go forward, shape (count, size)."""
    rng = np.random.default_rng(seed)
    drawn = rng.uniform(-1.0, 1.0, (count // 10 + 1, size))
    drawn[:, 0] = 0.5 + 0.5 * drawn[:, 0]
    return np.repeat(drawn, 10, axis=0)[:count].astype(np.float32)


def rollout(env: SemNavEnv, steps: np.ndarray) -> Iterator[dict[str, np.ndarray]]:
    """The observations of some steps; an episode that ends is followed by another one."""
    for action in steps:
        observation, _, terminated, truncated, _ = env.step(action)
        yield observation
        if terminated or truncated:
            yield env.reset()[0]


def fresh(observation: str = "all", robot: str = "wheelchair", **options: Any) -> SemNavEnv:
    """An environment at the start of an episode with seed 5."""
    env = SemNavEnv(robot, observation=observation)
    env.reset(seed=5, options=options or START)
    return env


def digest(observations: Iterator[dict[str, np.ndarray]]) -> str:
    """A hash of observations, every bit of them."""
    box = hashlib.sha256()
    for observation in observations:
        for name in sorted(observation):
            box.update(observation[name].tobytes())
    return box.hexdigest()


def rounded_digest(observations: Iterator[dict[str, np.ndarray]]) -> str:
    """A hash of observations to a thousandth, which no processor's last bit changes."""
    box = hashlib.sha256()
    for observation in observations:
        for name in sorted(observation):
            values = np.round(observation[name].astype(np.float64) * 1000.0)
            box.update(values.astype(np.int64).tobytes())
    return box.hexdigest()


def main(path: str) -> None:
    """Go on with the environment pickled at `path` and print the digest of what it observes."""
    with open(path, "rb") as file:
        env, steps = pickle.load(file)
    print(json.dumps(digest(rollout(env, steps))))


if __name__ == "__main__":
    import sys

    main(sys.argv[1])
