"""Parts of the benchmark for a single environment: its step, parts of a step, and its reset."""

from __future__ import annotations

import time
from typing import Any

import gymnasium as gym
import numpy as np

from semnav_env.bench.timing import Part, seconds_per_call
from semnav_env.env import SemNavEnv
from semnav_env.mind.belief import BeliefTracker
from semnav_env.mind.belief.understand import extract_features, understand
from semnav_env.robots import DepthRig
from semnav_env.world.lidar.raster import cast
from semnav_env.world.simulator.sensing import sense
from semnav_features import Door
from semnav_features.clouds import find_door
from semnav_features.frames import compose

RESETS = 20
"""Resets timed in a run; one takes as long as many steps."""

MEAN_DRIVE_SECONDS = 19.0
"""Limit of an episode in timings of training, simulated seconds: so long a drive of `train` takes
on average (`semnav evaluate train --agent scripted --episodes 60`), so that there are as many
resets for a step as in training."""

RARE = 10
"""Calls timed of what takes milliseconds."""


def step_parts(steps: int, **options: Any) -> list[Part]:
    """A step and a reset.

    Args:
        steps: calls in a timing.
        options: of `SemNavEnv`.
    """
    env = gym.make("semnav_env:SemNav-v0", **options)
    env.reset(seed=0)
    actions = cruising_actions(steps, env.action_space.shape or ())
    return [
        Part("step", lambda: _drive(env, actions)),
        Part("reset", lambda: seconds_per_call(env.reset, RESETS)),
    ]


def training_step_part(steps: int, episodes: str, **options: Any) -> Part:
    """A step on the episodes of a split, with the time of their resets.

    Args:
        steps: calls in a timing.
        episodes: name of the split, or path of a file.
        options: of `SemNavEnv`.
    """
    env = gym.make("semnav_env:SemNav-v0", **on_split(episodes), **options)
    env.reset(seed=0)
    actions = cruising_actions(steps, env.action_space.shape or ())

    def drive() -> float:
        begin = time.perf_counter()
        for action in actions:
            _, _, terminated, truncated, _ = env.step(action)
            if terminated or truncated:
                env.reset()
        return (time.perf_counter() - begin) / len(actions)

    return Part(f"step, on {episodes} with resets", drive)


def on_split(episodes: str) -> dict[str, Any]:
    """Arguments of an environment with the episodes of a split and their usual length."""
    return {"episodes": episodes, "max_seconds": MEAN_DRIVE_SECONDS}


def kernel_parts(steps: int, **options: Any) -> list[Part]:
    """The parts of a step, each timed alone at the present pose of the robot."""
    env = SemNavEnv(**options)
    env.reset(seed=0)
    lidar, pose = env.simulator.lidar, env.world.pose
    tracker = BeliefTracker(env.lidar_spec, lidar.mount, env.extractor)
    tracker.begin(env.tracker.command)
    out = lidar.ranges(pose, (0, 0, 0))
    tracker.update(out, pose)
    follower, scene, believed = tracker.follower, tracker.scene, tracker.belief.pose
    exact: list[Any] = [*compose(pose, env.robot.lidar_mount), *lidar.arrays[:5], out]
    calls = {
        "sense: physics, odometry, scan": lambda: sense(env.simulator.arrays),
        "of it the exact scan": lambda: cast(*exact),
        "understand: features, memory, progress": lambda: understand(tracker.senses),
        "of it the features": lambda: extract_features(tracker.senses, True),
        "grounding a clause, when it is time to look": lambda: follower.look(scene(), believed),
    }
    rig, door = DepthRig.spot(), Door((1.0, 0.45), (1.0, -0.45))
    cloud = env.simulator.see(rig)
    rare = {
        f"a cloud of {rig.pixels} pixels": lambda: env.simulator.see(rig),
        "a door looked for in it": lambda: find_door(cloud, door),
    }
    timed = [*((*each, steps) for each in calls.items()), *((*each, RARE) for each in rare.items())]
    return [
        Part(name, lambda call=call, count=count: seconds_per_call(call, count))  # type: ignore[misc]
        for name, call, count in timed
    ]


def cruising_actions(steps: int, shape: tuple[int, ...]) -> np.ndarray:
    """Driving along at about half of the largest speed with a little steering."""
    actions = np.random.default_rng(0).uniform(-0.05, 0.05, (steps, *shape)).astype(np.float32)
    actions[..., 0] += 0.55
    return actions


def _drive(env: gym.Env[Any, Any], actions: np.ndarray) -> float:
    """Seconds per step, without the time of resets."""
    begin = time.perf_counter()
    for action in actions:
        _, _, terminated, truncated, info = env.step(action)
        if terminated or truncated or info["in_contact"]:
            stopped = time.perf_counter()
            env.reset()
            begin += time.perf_counter() - stopped
    return (time.perf_counter() - begin) / len(actions)
