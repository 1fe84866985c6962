"""Lets an agent drive one episode, and records and judges it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from semnav_env.agents.base import Agent, steps
from semnav_env.agents.evaluation.causes import cause_of
from semnav_env.env import SemNavEnv
from semnav_env.metrics import Metrics, Recorder, Recording, measure
from semnav_env.metrics.event_log import events_of
from semnav_env.metrics.events import Event
from semnav_env.robots import RobotSpec
from semnav_env.verifier import Verdict, Verifier
from semnav_env.verifier.recheck import recheck


@dataclass(frozen=True, eq=False)
class Drive:
    """A driven episode.

    Attributes:
        recording: poses, velocities and contacts of every step.
        verifier: the judge; it knows the plan, the command, the true route and the goals.
        metrics: all measures.
        cause: why it failed, in words; empty after success.
        robot: the body that drove.
        social: how near people came, see `World.social`.
        impossible: why the robot believed at the end that the command is impossible; empty if it
            did not believe so.
    """

    recording: Recording
    verifier: Verifier
    metrics: Metrics
    cause: str
    robot: RobotSpec
    social: dict[str, float]
    impossible: str = ""

    @property
    def kind(self) -> str:
        """The kind of the clause that failed, such as "Turn"; empty after success."""
        clauses = self.verifier.mission.command.clauses
        active = min(self.verifier.follower.active, len(clauses) - 1)
        return "" if self.metrics.success else type(clauses[active]).__name__

    def as_infeasible(self) -> Drive:
        """The same drive, judged as that of a command that is impossible.

        It is a success if the robot stood still, said that the command is impossible, and had made
        no mistake before. There is no true route to weigh it by, so it has no SPL and SDTW.
        """
        right = bool(self.impossible) and self.verifier.verdict is Verdict.STOPPED_SHORT
        said = self.impossible or "did not say that it is impossible"
        cause = "" if right else f"{self.verifier.verdict}; robot: {said}"
        near = right or self.metrics.oracle_success
        told = replace(
            self.metrics, success=right, oracle_success=near, spl=math.nan, sdtw=math.nan
        )
        return replace(self, metrics=told, cause=cause)

    def rechecked(self) -> str:
        """The verdict of the second opinion if it differs from the verifier's; otherwise empty."""
        verifier, mission = self.verifier, self.verifier.mission
        found = recheck(self.recording, mission.floor_plan, verifier.goals, mission.rules)
        return "" if found.verdict == verifier.verdict else found.verdict

    def events(self) -> tuple[Event, ...]:
        """The events of the drive, in the order of time."""
        return events_of(self.recording, self.verifier.mission.floor_plan)

    def save_picture(self, path: str | Path, title: str = "") -> None:
        """Write a picture of the plan, the true route, the path driven, contacts and goals."""
        from semnav_env.metrics.picture import save_episode  # matplotlib only when it is wanted

        mission = self.verifier.mission
        plan, route, goals = mission.floor_plan, mission.route, mission.goals
        save_episode(path, plan, self.recording, self.robot, route, goals, title)


def drive(env: SemNavEnv, agent: Agent, seed: int, options: dict[str, Any]) -> Drive:
    """Let an agent drive one episode to its end.

    Args:
        env: an environment with the `observation=` of the agent.
        agent: the driver.
        seed: of the episode.
        options: for `env.reset`: "command", "pose", "floor_plan"; or "episode".
    """
    observation, info = env.reset(seed=seed, options=options)
    recorder = Recorder(env.world)
    for step in steps(env, agent, observation, info):
        recorder.note()
        info = step.info
    verifier, recording = env.judge.verifier, recorder.recording()
    metrics = measure(recording, verifier, env.robot)
    impossible = info["impossible"]
    cause = cause_of(verifier, metrics, impossible)
    social = env.world.social()
    return Drive(recording, verifier, metrics, cause, env.robot, social, impossible or "")
