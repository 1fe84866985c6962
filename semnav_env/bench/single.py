"""How long a step, its parts and a reset take: medians of several runs in one process."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from statistics import median
from typing import Any

import gymnasium as gym
import numpy as np

from semnav_env.belief import BeliefTracker
from semnav_env.belief.understand import extract_features
from semnav_env.env import SemNavEnv
from semnav_env.features.corridor import corridor_at
from semnav_env.features.frames import compose
from semnav_env.lidar.raster import cast

RESETS = 20
"""Resets timed in a run; one takes as long as many steps."""


@dataclass(frozen=True)
class Timing:
    """One part.

    Attributes:
        name: what was timed.
        microseconds: median over the runs of the mean of one call.
        share: of a whole step.
    """

    name: str
    microseconds: float
    share: float

    @property
    def per_second(self) -> float:
        """Calls per second."""
        return 1e6 / self.microseconds


ALTERNATING_TWISTS = ((0.3, 0.0, 0.2), (-0.3, 0.0, -0.2))
"""Twists that are driven in turn, so that the robot stays near its start and touches nothing."""


def benchmark(floor_plan: str, robot: str, observation: str, runs: int, steps: int) -> list[Timing]:
    """Time the parts of a step and the whole of it, the whole first.

    Args:
        floor_plan: bundled name or path.
        robot: name of a body.
        observation: as in `SemNavEnv`.
        runs: how often each part is timed; the median counts.
        steps: calls per run.
    """
    env = gym.make(
        "semnav_env:SemNav-v0", robot=robot, floor_plan=floor_plan, observation=observation
    )
    bare = env.unwrapped
    assert isinstance(bare, SemNavEnv)
    env.reset(seed=0)
    actions = _actions(bare, steps)
    parts: list[tuple[str, Callable[[], float]]] = [
        ("step (gymnasium.make)", lambda: _drive(env, actions)),
        ("step (SemNavEnv)", lambda: _drive(bare, actions)),
        *_kernel_parts(bare, steps),
        ("reset", lambda: _seconds_per_call(lambda _: bare.reset(), RESETS)),
    ]
    for _, part in parts:
        part()
    runs_by_part = [[part() for _, part in parts] for _ in range(runs)]
    seconds = [median(column) for column in zip(*runs_by_part, strict=True)]
    return [
        Timing(name, 1e6 * each, each / seconds[0])
        for (name, _), each in zip(parts, seconds, strict=True)
    ]


def _seconds_per_call(call: Callable[[int], object], times: int) -> float:
    """The mean; `call` is given the number of the call."""
    begin = time.perf_counter()
    for i in range(times):
        call(i)
    return (time.perf_counter() - begin) / times


def _actions(env: SemNavEnv, steps: int) -> np.ndarray:
    """Driving along at 0.75 m/s and more, with a little steering."""
    rng = np.random.default_rng(0)
    actions = rng.uniform(-0.05, 0.05, (steps, env.robot.action_size)).astype(np.float32)
    actions[:, 0] += 0.55
    return actions


def _drive(env: gym.Env[Any, Any], actions: np.ndarray) -> float:
    """Seconds per step; the clock stands still while an episode that hit something is renewed."""
    begin = time.perf_counter()
    for action in actions:
        _, _, terminated, truncated, info = env.step(action)
        if terminated or truncated or info["in_contact"]:
            stopped = time.perf_counter()
            env.reset()
            begin += time.perf_counter() - stopped
    return (time.perf_counter() - begin) / len(actions)


def _kernel_parts(env: SemNavEnv, steps: int) -> list[tuple[str, Callable[[], float]]]:
    """The parts of a step by themselves, at the environment's present pose."""
    lidar, pose = env.simulator.lidar, env.world.pose
    tracker = BeliefTracker(env.lidar_spec, lidar.mount, env.extractor)
    tracker.begin(env.judge.verifier.mission.command)
    lidar_pose = compose(pose, env.robot.lidar_mount)
    velocity = (0.3, 0.0, 0.2)
    out = lidar.ranges(pose, (0, 0, 0))
    arguments: list[Any] = [*lidar_pose, *lidar.arrays[:5], out]
    tracker.update(out, pose, velocity)
    scene = env.floor_plan.scene

    def repeat(call: Callable[[int], object]) -> Callable[[], float]:
        return lambda: _seconds_per_call(call, steps)

    return [
        ("scan without noise", repeat(lambda i: cast(*arguments))),
        ("scan with noise", repeat(lambda i: lidar.ranges(pose, (0, 0, i), out))),
        ("features", repeat(lambda i: extract_features(tracker.senses))),
        (
            "features, memory, goal",
            repeat(lambda i: tracker.update(out, pose, velocity)),
        ),
        ("world step", repeat(lambda i: env.world.step(ALTERNATING_TWISTS[i // 15 % 2]))),
        ("hallway (a few times a second)", repeat(lambda i: corridor_at(scene, pose))),
    ]
