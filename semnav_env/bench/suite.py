"""What `semnav bench` times in one run."""

from __future__ import annotations

import numpy as np

from semnav_env.bench.brute_force import brute_force_ranges
from semnav_env.bench.plans import repeated
from semnav_env.bench.single import kernel_parts, step_parts
from semnav_env.bench.timing import Part, Timing, seconds_per_call, timings
from semnav_env.bench.vector import vector_part
from semnav_env.features.lidar_spec import lidar_spec
from semnav_env.maps import FloorPlan

YARDSTICK_SEGMENTS = 208
"""Wall segments of the brute-force scan, whatever the floor plan."""

COPIES = (1, 2, 10, 29)
"""Sizes at which growth is timed, in copies of the plan around the robot."""


def benchmark(
    floor_plan: str | FloorPlan,
    robot: str,
    observation: str,
    robots: int,
    threads: tuple[int, ...],
    runs: int,
    steps: int,
) -> list[Timing]:
    """Time steps, their parts and a reset; the yardstick first.

    Args:
        floor_plan: bundled name, path or plan.
        robot: name of a body.
        observation: as in `SemNavEnv`.
        robots: in the vector environment.
        threads: numbers of threads to drive them in.
        runs: how often each part is timed; the median counts.
        steps: calls in a timing.
    """
    step = step_parts(floor_plan, robot, observation, steps)
    vector = [
        vector_part(floor_plan, robot, observation, steps, robots, count) for count in threads
    ]
    parts = [yardstick(), step[0], *vector, *kernel_parts(floor_plan, robot, steps), step[1]]
    return timings(parts, runs)


def growth(plan: FloorPlan, robot: str, observation: str, runs: int, steps: int) -> list[Timing]:
    """Time the step in ever larger buildings that are the same around the robot."""
    parts = [yardstick()]
    for copies in COPIES:
        larger = repeated(plan, copies)
        part = step_parts(larger, robot, observation, steps)[0]
        parts.append(Part(f"step, {len(larger.segments)} segments", part.seconds))
    return timings(parts, runs)


def yardstick() -> Part:
    """A brute-force scan of a TiM561 in NumPy among random walls."""
    rng, angles = np.random.default_rng(0), lidar_spec("tim561").angles
    starts = rng.uniform(-15.0, 15.0, (YARDSTICK_SEGMENTS, 2))
    segments = np.hstack((starts, starts + rng.uniform(-4.0, 4.0, starts.shape)))
    name = f"brute-force scan, {len(angles)} beams, {len(segments)} segments"
    scan = lambda: brute_force_ranges((0.0, 0.0, 0.0), segments, angles)  # noqa: E731
    return Part(name, lambda: seconds_per_call(scan, 20))
