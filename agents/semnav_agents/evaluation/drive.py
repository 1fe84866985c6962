"""Lets an agent drive one episode, and records and judges it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeAlias

from semnav_agents.base import Agent, GoalHolder, steps
from semnav_agents.evaluation.causes import cause_of
from semnav_agents.evaluation.kept_drive import KeptDrive, keep
from semnav_env.env import SemNavEnv
from semnav_env.judge import Judge, Verdict
from semnav_env.judge.metrics import Metrics, Recorder, Recording, measure
from semnav_env.judge.metrics.event_log import events_of
from semnav_env.judge.metrics.events import Event
from semnav_env.judge.metrics.final_belief import FinalBelief
from semnav_env.judge.recheck import recheck
from semnav_env.robots import RobotSpec
from semnav_features.door_passages import DoorPassage
from semnav_features.frames import ORIGIN, Pose, compose, relative, to_parent

Watch: TypeAlias = Callable[[bool], None]
"""Looks at an environment after each step of an episode; it is told whether the episode is over."""


@dataclass(frozen=True, eq=False)
class Drive:
    """A driven episode.

    Attributes:
        recording: poses, velocities and contacts of every step.
        judge: the judge; it knows the plan, the command, the true route and the goals.
        metrics: all measures.
        cause: why it failed, in words; empty after success.
        robot: the body that drove.
        social: distances to people, see `World.social`.
        impossible: why the robot believed at the end that the command is impossible; empty if it
            did not believe so.
        belief: remembered doors and the agent's goal at the end.
    """

    recording: Recording
    judge: Judge
    metrics: Metrics
    cause: str
    robot: RobotSpec
    social: dict[str, float]
    impossible: str = ""
    belief: FinalBelief | None = None

    @property
    def kind(self) -> str:
        """The kind of the clause that failed, such as "Turn"; empty after success."""
        clauses = self.judge.mission.command.clauses
        judged = min(self.judge.clause, len(clauses) - 1)
        return "" if self.metrics.success else type(clauses[judged]).__name__

    def as_infeasible(self) -> Drive:
        """The result of the same drive for an impossible command.

        The drive is a success if the robot stood still, said that the command is impossible, and
        made no mistake before. Without a true route it has no SPL and sDTW.
        """
        right = recognised_impossible(self.judge, self.impossible)
        said = self.impossible or "did not say that it is impossible"
        cause = "" if right else f"{self.judge.verdict}; robot: {said}"
        near = right or self.metrics.oracle_success
        told = replace(
            self.metrics, success=right, oracle_success=near, spl=math.nan, sdtw=math.nan
        )
        return replace(self, metrics=told, cause=cause)

    def rechecked(self) -> str:
        """The verdict of the second opinion if it differs from the judge's; otherwise empty."""
        judge, mission = self.judge, self.judge.mission
        found = recheck(self.recording, mission.floor_plan, judge.goals, mission.rules)
        return "" if found.verdict == judge.verdict else found.verdict

    def events(self) -> tuple[Event, ...]:
        """The events of the drive, in the order of time."""
        return events_of(self.recording, self.judge.mission.floor_plan)

    def passages(self) -> tuple[DoorPassage, ...]:
        """How the robot passed doorways of the plan, in the order of time."""
        return self.recording.passages(self.judge.mission.floor_plan.doors)

    def kept(self) -> KeptDrive:
        """What is kept of the drive, to look at it later."""
        return keep(self.recording, self.judge, self.robot, self.belief)

    def save_picture(self, path: str | Path, title: str = "") -> None:
        """Write a picture: plan, true route, driven path, contacts, goals, belief at the end."""
        from semnav_env.judge.metrics.picture import (
            save_episode,  # matplotlib only when it is wanted
        )

        mission = self.judge.mission
        plan, route, goals = mission.floor_plan, mission.route, mission.goals
        save_episode(path, plan, self.recording, self.robot, route, goals, title, self.belief)


def recognised_impossible(judge: Judge, impossible: str | None) -> bool:
    """Whether a robot answered an impossible command correctly, see `Drive.as_infeasible`.

    Args:
        judge: the judge, after the end.
        impossible: why the robot believes that the command is impossible.
    """
    return bool(impossible) and judge.verdict is Verdict.STOPPED_SHORT


def drive(
    env: SemNavEnv, agent: Agent, seed: int, options: dict[str, Any], watch: Watch | None = None
) -> Drive:
    """Let an agent drive one episode to its end.

    Args:
        env: an environment with the `observation=` of the agent.
        agent: the driver.
        seed: of the episode.
        options: for `env.reset`: "command", "pose", "floor_plan"; or "episode".
        watch: is called after each step, and told whether the episode is over; as `Film.note`.
    """
    observation, info = env.reset(seed=seed, options=options)
    recorder = Recorder(env.world)
    for step in steps(env, agent, observation, info):
        recorder.note()
        if watch is not None:
            watch(step.terminated or step.truncated)
    return ended(env, recorder, agent.own_goal() if isinstance(agent, GoalHolder) else None)


def ended(env: SemNavEnv, recorder: Recorder, own_goal: Pose | None) -> Drive:
    """The drive of an episode that has just ended.

    Args:
        env: where it ended.
        recorder: of the episode.
        own_goal: to which the agent drove, odometry frame; None if to that of the belief.
    """
    judge, recording = env.judge, recorder.recording()
    metrics = measure(recording, judge, env.robot)
    impossible = env.belief.impossible
    return Drive(
        recording,
        judge,
        metrics,
        cause_of(judge, metrics, impossible),
        env.robot,
        env.world.social(),
        impossible or "",
        _final_belief(env, own_goal),
    )


def _final_belief(env: SemNavEnv, own_goal: Pose | None) -> FinalBelief:
    """The robot's belief, moved so that the believed pose is the true pose."""
    odometry_frame = compose(env.world.pose, relative(env.belief.pose, ORIGIN))
    goal = env.belief.goal.pose if own_goal is None else own_goal
    doors = env.tracker.scene().placed(odometry_frame).doors
    return FinalBelief(tuple(doors), to_parent(odometry_frame, goal[:2]))
