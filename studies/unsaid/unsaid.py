"""What is gained by doing what goes without saying: commands with and without their implicit steps.

Every trial is made of a command that says everything ("leave the room, turn left and go through the
second door on the left") by leaving unsaid what a person would ("go through the second door on the
left"). It counts as understood if it leads where the full command leads.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from semnav_agents.base import Agent
from semnav_agents.evaluation.drive import drive
from semnav_env.env import SemNavEnv
from semnav_env.judge import place, plan_goals
from semnav_env.language import Command, DoorReference, GoToDoor, Leave, Side, Turn, Turning
from semnav_env.mind.grounding import GroundingError
from semnav_env.robots import RobotSpec
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.placement import sample_pose
from semnav_features.frames import Pose

MAX_ORDINAL = 3
"""Doors are counted up to this."""


@dataclass(frozen=True)
class Unsaid:
    """A command that leaves something unsaid, and where it is given.

    Attributes:
        said: the command.
        meant: the same with every step.
        pose: where the robot starts, world frame.
    """

    said: Command
    meant: Command
    pose: Pose


@dataclass(frozen=True)
class Followed:
    """What became of such a command.

    Attributes:
        understood: it leads where the full command leads.
        reached: the robot got there; None if it was not driven.
    """

    understood: bool
    reached: bool | None = None


def unsaid_trials(
    floor_plan: FloorPlan, robot: RobotSpec, rng: np.random.Generator
) -> tuple[Unsaid, ...]:
    """Commands said in every room, and on sending the robot into a room from a corridor."""
    regions = [(room, True) for room in floor_plan.rooms]
    regions += [(corridor, False) for corridor in floor_plan.corridors]
    trials: list[Unsaid] = []
    for region, is_room in regions:
        with suppress(ValueError):  # no room for the robot in there
            trials += _trials_from(sample_pose(floor_plan, robot, rng, region), is_room)
    return tuple(trial for trial in trials if _is_feasible(floor_plan, trial))


def follow(
    env: SemNavEnv, trial: Unsaid, agent: Agent | None, seed: int, *, implicit_steps: bool
) -> Followed:
    """What becomes of a trial.

    Args:
        env: in the trial's floor plan.
        trial: what is said and meant.
        agent: drives; None only asks whether the command is understood.
        seed: of the episode.
        implicit_steps: whether what goes without saying is done.
    """
    options = {"command": trial.said, "pose": trial.pose, "implicit_steps": implicit_steps}
    try:
        env.reset(seed=seed, options=options)
    except GroundingError:
        return Followed(False, None if agent is None else False)
    understood = _leads_there(env, trial)
    if agent is None or not understood:
        return Followed(understood, None if agent is None else False)
    return Followed(True, drive(env, agent, seed, options).judge.success)


def _leads_there(env: SemNavEnv, trial: Unsaid) -> bool:
    found = env.judge.mission.goals
    meant = plan_goals(env.floor_plan, trial.meant, trial.pose)
    return bool(found) and math.dist(place(found[-1]), place(meant[-1])) < 0.1


def _trials_from(pose: Pose, in_room: bool) -> Iterator[Unsaid]:
    into = [GoToDoor(DoorReference(1, side)) for side in (Side.LEFT, Side.RIGHT)]
    for side, turning in ((Side.LEFT, Turning.LEFT), (Side.RIGHT, Turning.RIGHT)):
        for number in range(1, MAX_ORDINAL + 1):
            door = GoToDoor(DoorReference(number, side))
            for before in [()] if in_room else [(first,) for first in into]:
                said, meant = (*before, door), (*before, Leave(), Turn(turning), door)
                yield Unsaid(Command(said), Command(meant), pose)


def _is_feasible(floor_plan: FloorPlan, trial: Unsaid) -> bool:
    try:
        plan_goals(floor_plan, trial.meant, trial.pose)
    except GroundingError:
        return False
    return True
