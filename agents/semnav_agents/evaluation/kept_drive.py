"""What is kept of a driven episode, to look at it without driving it again."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semnav_env.judge import Judge, place
from semnav_env.judge.metrics import Recording
from semnav_env.judge.metrics.final_belief import FinalBelief
from semnav_env.robots import RobotSpec
from semnav_env.world.maps import FloorPlan
from semnav_features.frames import FloatArray, Point

MAX_MOMENTS = 240
"""The most moments of a drive that are kept: enough to follow four minutes."""


@dataclass(frozen=True, eq=False)
class KeptDrive:
    """Evenly spaced moments of a drive, n of them, and what its picture shows beside them.

    Everything is in the world frame, metres and radians.

    Attributes:
        floor_plan: the plan with the furniture of the episode.
        robot: the body that drove.
        clauses: of the command, in canonical words.
        seconds: duration of the drive, simulated seconds.
        poses: true poses of the robot's centre, shape (n, 3).
        touched: whether something was touched since the moment before, shape (n,).
        people: x, y and radius of each person, shape (n, k, 3).
        leaves: of doors that open and close, as at the end: x1, y1, x2, y2, shape (m, 4).
        route: the true route, shape (r, 2).
        goals: places of the true goals, one for each clause.
        belief: what the robot remembered at the end, and where its agent was driving to.
    """

    floor_plan: FloorPlan
    robot: RobotSpec
    clauses: tuple[str, ...]
    seconds: float
    poses: FloatArray
    touched: NDArray[np.bool_]
    people: FloatArray
    leaves: FloatArray
    route: FloatArray
    goals: tuple[Point, ...]
    belief: FinalBelief | None


def keep(
    recording: Recording, judge: Judge, robot: RobotSpec, belief: FinalBelief | None
) -> KeptDrive:
    """What is kept of a drive; its arguments are the attributes of `Drive`."""
    count = len(recording.poses)
    rows = np.linspace(0, count - 1, min(count, MAX_MOMENTS)).round().astype(np.int64)
    ends = np.append(0, np.cumsum(recording.contacts > 0))  # contacts before each row
    touched = np.diff(ends[rows + 1], prepend=0) > 0
    people, leaves = recording.people, recording.leaves
    mission = judge.mission
    return KeptDrive(
        floor_plan=mission.floor_plan,
        robot=robot,
        clauses=tuple(str(clause) for clause in mission.command.clauses),
        seconds=recording.seconds,
        poses=recording.poses[rows],
        touched=touched,
        people=np.zeros((len(rows), 0, 3)) if people is None else people[rows],
        leaves=np.zeros((0, 4)) if leaves is None else leaves,
        route=mission.route,
        goals=tuple(place(goal) for goal in mission.goals),
        belief=belief,
    )
