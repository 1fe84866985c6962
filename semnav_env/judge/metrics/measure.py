"""Computes all measures of a recorded episode."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from semnav_env.judge import Judge, Verdict, place
from semnav_env.judge.metrics.motion import clearances, collisions_per_100m, rms_jerk
from semnav_env.judge.metrics.paths import (
    PUBLISHED_GOAL_RADIUS,
    cls,
    ndtw,
    resampled,
    soft_spl,
    spl,
)
from semnav_env.judge.metrics.recording import Recording
from semnav_env.judge.metrics.results import Metrics
from semnav_env.mind.grounding.goal import Goal, PassGoal, ReachGoal, SeekGoal, StopGoal
from semnav_env.robots import RobotSpec
from semnav_env.rules import SuccessRules
from semnav_env.world.maps.geodesic import WaysTo
from semnav_features.frames import FloatArray, path_length

GOAL_RADIUS = 1.0
"""Distance at which a goal counts as reached in the stricter of the two loose measures of success,
metres."""


def measure(recording: Recording, judge: Judge, robot: RobotSpec) -> Metrics:
    """Compute the measures of an episode.

    Args:
        recording: recording of the episode.
        judge: the judge that judged it; it knows the plan, the route and the goals.
        robot: the robot that drove.
    """
    path, route = recording.path, judge.mission.route
    driven_length, route_length = path_length(path), judge.route_length
    goals = judge.mission.goals
    goal = place(goals[-1]) if goals else judge.mission.start[:2]
    distances = geodesic_distances(judge.mission.geodesic.to(goal), path)
    ends, lengths = (float(distances[-1]), float(distances[0])), (driven_length, route_length)
    driven, wanted = resampled(path), resampled(route)
    alike = ndtw(driven, wanted)
    clear = clearances(recording.poses, robot, judge.mission.floor_plan)
    success, verdicts = judge.success, judge.verdicts
    return Metrics(
        success=success,
        within_1m=bool(distances[-1] < GOAL_RADIUS),
        within_3m=bool(distances[-1] < PUBLISHED_GOAL_RADIUS),
        oracle_success=success
        or (bool(goals) and ever_met(goals[-1], recording, judge.mission.rules.success)),
        oracle_within_1m=bool(distances.min() < GOAL_RADIUS),
        oracle_within_3m=bool(distances.min() < PUBLISHED_GOAL_RADIUS),
        spl=spl(success, *lengths),
        soft_spl=soft_spl(success, *ends, *lengths),
        ndtw=alike,
        sdtw=success * alike,
        cls=cls(driven, wanted),
        clauses=sum(map(_settled, verdicts)) / len(verdicts) if verdicts else 1.0,
        contact_free=recording.collisions == 0,
        collisions=recording.collisions,
        collisions_per_100m=collisions_per_100m(recording.collisions, driven_length),
        least_clearance=float(clear.min()),
        mean_clearance=float(clear.mean()),
        jerk=rms_jerk(path, recording.period),
        goal_distance=float(distances[-1]),
        path_length=driven_length,
        route_length=route_length,
        seconds=recording.seconds,
    )


def geodesic_distances(ways: WaysTo, points: FloatArray) -> FloatArray:
    """Lengths of the shortest paths from points of shape (n, 2), metres, shape (n,).

    A point without a path gets the length of the path from the nearest point that has one.
    """
    known = [ways.length((x, y)) for x, y in points.tolist()]
    return np.array(
        [
            distance if np.isfinite(distance) else path_length(ways.way((x, y)))
            for distance, (x, y) in zip(known, points.tolist(), strict=True)
        ]
    )


def ever_met(goal: Goal, recording: Recording, rules: SuccessRules) -> bool:
    """Whether a goal was met at some time, whether or not the clauses before were done."""
    poses = [(x, y, heading) for x, y, heading in recording.poses.tolist()]
    match goal:
        case PassGoal():
            return any(goal.crossed_between(before, after) for before, after in pairwise(poses))
        case StopGoal():
            return stood_there(goal, recording, rules.standstill_speed)
        case ReachGoal():
            return any(map(goal.reached_by, poses[1:]))
        case SeekGoal():
            return False


def stood_there(goal: StopGoal, recording: Recording, standstill_speed: float) -> bool:
    """Whether the robot stood still within `GOAL_RADIUS` of a goal for the duration of the goal.

    Args:
        goal: a stop goal, with its duration.
        recording: recording of the episode.
        standstill_speed: speed below which a robot stands still, m/s.
    """
    away = np.hypot(*(recording.path[1:] - goal.pose[:2]).T)
    stands = (recording.speeds[1:] < standstill_speed) & (away < GOAL_RADIUS)
    since = steps = 0
    for stood in stands.tolist():
        since = since + 1 if stood else 0
        steps = max(steps, since)
    return steps > 0 and steps * recording.period >= goal.wait


def _settled(verdict: str) -> bool:
    return verdict in (Verdict.DONE, Verdict.SKIPPED)
