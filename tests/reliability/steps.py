"""Drives for many steps through ever new floors, and says whether memory stays flat."""

from __future__ import annotations

import gc
import math
import os
import time
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from semnav_env.env import SemNavEnv
from semnav_env.world.maps.geodesic import RECENT_FIELDS
from semnav_env.world.maps.library import MAX_KEPT_OFFICES

EPISODES_ON_A_FLOOR = 10
"""Episodes after which a floor is generated that has never been seen before."""

WARM_UP = 0.2
"""Least share of the steps during which caches fill, and memory may grow."""

MOST_GROWTH = 30.0 + RECENT_FIELDS.max_bytes / 1e6
"""Largest growth of memory after the warm-up, megabytes; the fields of distances that are kept may
fill up to their budget."""


class Drive(NamedTuple):
    """What was seen in a drive so far.

    Attributes:
        steps: number of them.
        episodes: number of resets.
        floors: number of floor plans.
        warm: resident memory when the last floor that is kept was made, and at the earliest after
            a fifth of the steps, megabytes.
        memory: now.
        seconds: since the start.
    """

    steps: int
    episodes: int
    floors: int
    warm: float
    memory: float
    seconds: float


def resident() -> float:
    """Resident memory of this process, megabytes."""
    gc.collect()
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def drive(count: int, every: int) -> Iterator[Drive]:
    """Drive at random, and report now and then; every observation and reward must be finite.

    Args:
        count: number of steps.
        every: steps between two reports.
    """
    env, rng, begun = SemNavEnv(max_seconds=60.0), np.random.default_rng(5), time.monotonic()
    warm, floors, episodes, ended = 0.0, 0, 0, True
    for step in range(1, count + 1):
        if ended:
            if episodes % EPISODES_ON_A_FLOOR == 0:
                floors += 1
                warm = resident() if floors <= MAX_KEPT_OFFICES + 1 else warm
            floor_plan = f"office:small:{10_000 + floors}"
            env.reset(seed=episodes, options={"floor_plan": floor_plan})
            episodes += 1
        if step % 10 == 1:
            pushed = rng.uniform((-0.3, -1.0), (1.0, 1.0))
        observation, reward, terminated, truncated, _ = env.step(pushed)
        assert math.isfinite(reward), (step, reward)
        assert all(np.isfinite(value).all() for value in observation.values()), step
        ended = terminated or truncated
        if step == round(WARM_UP * count):
            warm = resident()
        if step % every == 0 or step == count:
            yield Drive(step, episodes, floors, warm, resident(), time.monotonic() - begun)
