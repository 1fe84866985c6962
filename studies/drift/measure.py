"""Drives episodes with odometry that errs more and more, and counts what becomes of them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from statistics import fmean

from shapely import Point

from semnav_agents.evaluation.drive import drive
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.judge import Verdict
from semnav_env.judge.episodes import Episode
from semnav_env.world.maps import FloorPlan
from semnav_env.world.simulator import odometry_settings
from semnav_features.frames import Pose, compose

MAX_SECONDS = 300.0
"""Time limit of an episode, as in `semnav evaluate`, simulated seconds."""

DOORWAY = 0.5
"""Episodes end in doorways; an error below this says nothing about the room, metres."""


@dataclass(frozen=True)
class Condition:
    """One cell of the study.

    Attributes:
        robot: name of the body.
        odometry: name of its odometry.
        factor: biases and noises are this many times as large.
        corrected: whether walls that are seen again correct the believed pose.
    """

    robot: str
    odometry: str
    factor: float
    corrected: bool


@dataclass(frozen=True)
class Ending:
    """How one episode ended.

    Attributes:
        success: whether the command was carried out.
        wrong_door: whether it failed because the robot crossed a door that was not meant.
        lost: whether the robot was in another room than it believed, and off by more than
            `DOORWAY`.
        error: distance from the believed to the true place, metres.
    """

    success: bool
    wrong_door: bool
    lost: bool
    error: float


def endings(condition: Condition, episodes: list[Episode]) -> Iterator[Ending]:
    """How the scripted agent ends each episode under one condition."""
    agent = make_agent("scripted")
    env = SemNavEnv(
        condition.robot,
        observation=agent.observation,
        odometry=odometry_settings(condition.odometry).scaled(condition.factor),
        corrects_drift=condition.corrected,
        max_seconds=MAX_SECONDS,
    )
    for episode in episodes:
        driven = drive(env, agent, episode.number, {"episode": episode})
        true, start = env.world.pose, driven.judge.mission.start
        believed = compose(start, env.belief.pose)
        error = math.dist(true[:2], believed[:2])
        elsewhere = _room(env.floor_plan, true) != _room(env.floor_plan, believed)
        wrong_door = driven.judge.verdict is Verdict.WRONG_DOOR
        yield Ending(driven.metrics.success, wrong_door, elsewhere and error > DOORWAY, error)


def row(condition: Condition, ends: list[Ending]) -> dict[str, object]:
    """A condition and its figures: shares, and the mean and the largest error in metres."""
    errors = [end.error for end in ends]
    return asdict(condition) | {
        "episodes": len(ends),
        "success": round(fmean(end.success for end in ends), 3),
        "wrong_door": round(fmean(end.wrong_door for end in ends), 3),
        "lost": round(fmean(end.lost for end in ends), 3),
        "error": round(fmean(errors), 2),
        "largest_error": round(max(errors), 2),
    }


def _room(plan: FloorPlan, pose: Pose) -> str:
    """The name of the room in which a pose lies; "" in a hallway."""
    place = Point(pose[:2])
    return next((room.name for room in plan.rooms if room.polygon.covers(place)), "")
