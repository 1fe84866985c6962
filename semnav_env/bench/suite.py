"""What one run of `semnav bench` measures: parts, the yardstick first, for `timings`."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from semnav_env.bench.brute_force import yardstick, yardstick_alone
from semnav_env.bench.peers import peer_parts
from semnav_env.bench.plans import repeated
from semnav_env.bench.single import kernel_parts, step_parts, training_step_part
from semnav_env.bench.start_up import compile_seconds, start_parts
from semnav_env.bench.timing import Part, Timing
from semnav_env.bench.vector import training_part, vector_part
from semnav_env.env import SemNavEnv
from semnav_env.world.maps import FloorPlan
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import TIM561

COPIES, BEAMS, ROBOTS = (1, 2, 10, 29), (201, 405, 811, 1621), (1, 8, 64, 256)
"""Sizes at which growth is timed: copies of the plan, beams of the lidar, robots."""


TRAINING_LENGTH = 10
"""A timing of steps with resets has so many times as many steps: each needs ends of episodes."""


def usual_parts(robots: int, threads: int, steps: int, **options: Any) -> list[Part]:
    """Steps, their parts, a reset, and peers that are installed.

    Args:
        robots: in the vector environment.
        threads: most threads to drive them in.
        steps: calls in a timing.
        options: of `SemNavEnv`.
    """
    step, reset = step_parts(steps, **options)
    counts = range(1, threads + 1)
    vector = [vector_part(steps, robots, count, **options) for count in counts]
    parts = [yardstick(), yardstick_alone(), step, *vector, *kernel_parts(steps, **options), reset]
    env = SemNavEnv(**options)
    env.reset(seed=0)
    return parts + peer_parts(env.floor_plan, env.robot, env.lidar_spec, env.world.pose)


def growth_parts(plan: FloorPlan, threads: int, steps: int, **options: Any) -> list[Part]:
    """Steps among more and more walls, beams and robots.

    Copies are added beside the building, so the surroundings of the robot stay the same.
    """
    parts = [yardstick()]
    for copies in COPIES:
        larger = repeated(plan, copies)
        step = step_parts(steps, floor_plan=larger, **options)[0]
        parts.append(step._replace(name=f"step, {len(larger.segments)} segments"))
    for beams in BEAMS:
        step = step_parts(steps, floor_plan=plan, lidar=with_beams(beams), **options)[0]
        parts.append(step._replace(name=f"step, {beams} beams"))
    for count in range(1, threads + 1):
        parts += [vector_part(steps, n, count, floor_plan=plan, **options) for n in ROBOTS]
    return parts


def training_parts(
    episodes: str, robots: int, threads: int, steps: int, floor_plan: FloorPlan, **options: Any
) -> list[Part]:
    """Steps on a split, resets included, each after the plain step.

    Args:
        episodes: name of the split, or path of a file.
        robots: in the vector environment.
        threads: most threads to drive them in.
        steps: calls in a timing of the plain step; of `TRAINING_LENGTH` times as many in training.
        floor_plan: of the plain step.
        options: of `SemNavEnv`.
    """
    longer = TRAINING_LENGTH * steps
    plain = step_parts(steps, floor_plan=floor_plan, **options)[0]
    parts = [yardstick(), plain, training_step_part(longer, episodes, **options)]
    for count in range(1, threads + 1):
        parts.append(vector_part(steps, robots, count, floor_plan=floor_plan, **options))
        parts.append(training_part(longer, robots, count, episodes, **options))
    return parts


def start_up_parts() -> list[Part]:
    """Starts of processes, processor time."""
    return [yardstick(), *start_parts()]


def with_compilation(found: list[Timing]) -> list[Timing]:
    """The timings, and that of compiling all kernels once into an empty folder."""
    taken = 1e6 * compile_seconds()
    name = "compiling all kernels, processor time"
    return [*found, Timing(name, taken, found[0].microseconds / taken)]


def with_beams(beams: int) -> LidarSpec:
    """A TiM561 with more or fewer beams over the same angle."""
    increment = math.radians(270.0) / (beams - 1)
    return replace(TIM561, name=f"{beams} beams", beams=beams, angle_increment=increment)
