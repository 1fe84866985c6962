"""A vector environment: what one robot's step costs among many."""

from __future__ import annotations

import time

from semnav_env.bench.single import cruising_actions
from semnav_env.bench.timing import Part
from semnav_env.maps import FloorPlan
from semnav_env.vector import SemNavVectorEnv


def vector_part(
    floor_plan: str | FloorPlan,
    robot: str,
    observation: str,
    steps: int,
    robots: int,
    threads: int,
) -> Part:
    """The step of a vector environment, seconds for each robot; robots that hit something go on.

    Args:
        floor_plan: where all of them drive.
        robot: name of a body.
        observation: as in `SemNavEnv`.
        steps: of one robot in a timing, about.
        robots: how many there are.
        threads: in which they are driven.
    """
    envs = SemNavVectorEnv(
        robots, robot=robot, floor_plan=floor_plan, observation=observation, threads=threads
    )
    envs.reset(seed=0)
    shape = envs.single_action_space.shape or ()
    actions = cruising_actions(max(1, steps // robots), (robots, *shape))

    def drive() -> float:
        begin = time.perf_counter()
        for action in actions:
            _, _, terminated, truncated, infos = envs.step(action)
            stopped = infos.get("in_contact", terminated) & ~terminated & ~truncated
            if stopped.any():
                paused = time.perf_counter()
                envs.reset(options={"reset_mask": stopped})
                begin += time.perf_counter() - paused
        return (time.perf_counter() - begin) / actions[..., 0].size

    name = f'step of one of {robots}, observation="{observation}", threads: {threads}'
    return Part(name, drive)
