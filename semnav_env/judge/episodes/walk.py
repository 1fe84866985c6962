"""Walks a point through a command, to prove that the judge accepts its true route."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from semnav_env.judge import Judge, Motion, place
from semnav_env.judge.routes.route import Route
from semnav_env.mind.grounding import Goal, PassGoal, ReachGoal, StopGoal
from semnav_features.frames import Pose, to_parent

STEP_SECONDS = 0.1
"""Time from one pose of the walk to the next, seconds."""

CROSSING_DEPTH = 0.4
"""Distance that the walk continues behind the middle of a door to cross it, metres."""

MAX_LEGS = 20
"""Largest number of goals of a walk; a command has fewer."""


def carries_out(judge: Judge) -> bool:
    """Whether a walk to each goal along the shortest path carries the command out.

    A point is moved, so this says nothing about bodies. The judge cannot be used afterwards.
    """
    pose = judge.mission.start
    for _ in range(MAX_LEGS):
        if judge.over:
            break
        goal, active = judge.follower.goal, judge.follower.active
        for x, y, heading in _leg(judge, pose, goal):
            pose = x, y, heading
            speed = 0.0 if isinstance(goal, StopGoal) else 1.0
            judge.update(Motion(pose, speed, 0.0, in_contact=False, seconds=STEP_SECONDS))
            if judge.over or judge.follower.active != active:
                break
    return judge.success


def _leg(judge: Judge, pose: Pose, goal: Goal) -> Iterator[Pose]:
    if isinstance(goal, StopGoal):
        yield from (pose,) * (round(goal.wait / STEP_SECONDS) + 2)
        return
    way = judge.mission.geodesic.to(place(goal)).way(pose[:2])
    facing = goal.pose[2] if isinstance(goal, ReachGoal) and goal.fixes_heading else None
    if isinstance(goal, PassGoal):
        behind = to_parent((*place(goal), goal.pose[2]), (CROSSING_DEPTH, 0.0))
        way = np.vstack((way, behind))
    yield from Route(pose, way, facing).poses.tolist()
