"""Drives drawn commands as they are, slowly, fast, and along the wall of each side."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from semnav_agents.base import steps
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.language import MAX_CLAUSES, Command, Follow, Pace, Side, Speed
from semnav_features.frames import Pose

MANNERS = ("usual", "slow", "fast", "left", "right")
"""How a command is carried out: as it was drawn, at a pace, or along the wall of a side."""

MAX_SECONDS = 300.0
"""Time limit of an episode, seconds: a slow robot needs twice as long."""

MOVING = 0.05
"""Speed above which a robot moves, m/s."""


@dataclass(frozen=True)
class Case:
    """A command that can be carried out, and where it is said.

    Attributes:
        seed: of the episode from which it was drawn.
        command: with a clause that follows a hallway.
        pose: start of the robot's centre, world frame.
    """

    seed: int
    command: Command
    pose: Pose


@dataclass(frozen=True)
class Outcome:
    """What became of a drive.

    Attributes:
        success: whether the judge said so.
        verdicts: of the clauses.
        contacts: how many.
        speed: mean speed while moving, m/s.
    """

    success: bool
    verdicts: tuple[str, ...]
    contacts: int
    speed: float


def drawn_cases(floor_plan: str, count: int) -> Iterator[Case]:
    """The first drawn commands that follow a hallway and have room for a pace."""
    env, seed, found = SemNavEnv(floor_plan=floor_plan), 0, 0
    while found < count:
        _, info = env.reset(seed=seed)
        command = env.tracker.command
        follows = any(isinstance(clause, Follow) for clause in command.clauses)
        if follows and len(command.clauses) < MAX_CLAUSES:
            found += 1
            yield Case(seed, command, info["pose"])
        seed += 1


def in_manner(command: Command, manner: str) -> Command:
    """The command at a pace, or along a wall wherever it follows a hallway."""
    if manner in tuple(Speed):
        return Command((Pace(Speed(manner)), *command.clauses))
    if manner in tuple(Side):
        return Command(
            tuple(
                replace(clause, along=Side(manner)) if isinstance(clause, Follow) else clause
                for clause in command.clauses
            )
        )
    return command


def drive(robot: str, floor_plan: str, case: Case, manner: str, agent: str) -> Outcome:
    """Drive a case in a manner."""
    driver = make_agent(agent)
    env = SemNavEnv(robot, floor_plan, observation=driver.observation, max_seconds=MAX_SECONDS)
    told = {"command": in_manner(case.command, manner), "pose": case.pose}
    observation, info = env.reset(seed=case.seed, options=told)
    speeds = []
    for step in steps(env, driver, observation, info):
        info = step.info
        speeds.append(env.simulator.motion.speed)
    moving = [speed for speed in speeds if speed > MOVING]
    mean = float(np.mean(moving)) if moving else 0.0
    return Outcome(info["is_success"], info["verdicts"], info["collisions"], mean)
