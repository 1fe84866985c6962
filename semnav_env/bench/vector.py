"""Parts of the benchmark for a vector environment: the time of one robot's step."""

from __future__ import annotations

import time
from typing import Any

from semnav_env.bench.single import cruising_actions, on_split
from semnav_env.bench.timing import Part
from semnav_env.vector import SemNavVectorEnv


def vector_part(steps: int, robots: int, threads: int, **options: Any) -> Part:
    """The step of a vector environment, seconds for each robot, without resets.

    Resets after a collision and after the end of an episode do not count, as in
    `single.step_parts`.

    Args:
        steps: of one robot in a timing, about.
        robots: how many there are.
        threads: in which they are driven.
        options: of `SemNavEnv`.
    """
    envs = SemNavVectorEnv(robots, threads=threads, autoreset_mode="Disabled", **options)
    envs.reset(seed=0)
    shape = envs.single_action_space.shape or ()
    actions = cruising_actions(max(1, steps // robots), (robots, *shape))

    def drive() -> float:
        begin = time.perf_counter()
        for action in actions:
            _, _, terminated, truncated, infos = envs.step(action)
            stopped = infos["in_contact"] | terminated | truncated
            if stopped.any():
                paused = time.perf_counter()
                envs.reset(options={"reset_mask": stopped})
                begin += time.perf_counter() - paused
        return (time.perf_counter() - begin) / actions[..., 0].size

    return Part(_name(robots, threads), drive)


def training_part(steps: int, robots: int, threads: int, episodes: str, **options: Any) -> Part:
    """The step of a vector environment on the episodes of a split, with resets, as in training.

    The time includes resets and the preparation of buildings that are new to the process.

    Args:
        steps: of one robot in a timing, about.
        robots: how many there are.
        threads: in which they are driven.
        episodes: name of the split, or path of a file.
        options: of `SemNavEnv`.
    """
    options = on_split(episodes) | {"threads": threads, "autoreset_mode": "SameStep"} | options
    envs = SemNavVectorEnv(robots, **options)
    envs.reset(seed=0)
    shape = envs.single_action_space.shape or ()
    actions = cruising_actions(max(1, steps // robots), (robots, *shape))

    def drive() -> float:
        begin = time.perf_counter()
        for action in actions:
            envs.step(action)
        return (time.perf_counter() - begin) / actions[..., 0].size

    return Part(f"{_name(robots, threads)}, on {episodes} with resets", drive)


def _name(robots: int, threads: int) -> str:
    among = "threads" if threads > 1 else "thread"
    return f"step of one of {robots} robots, {threads} {among}"
