"""Drives episodes and collects samples for a learner of grounding."""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass, field
from typing import Any

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Agent, Observation
from semnav_agents.hearing.clause_state import ClauseState
from semnav_agents.hearing.elements import Description, describe
from semnav_agents.hearing.labels import Label, as_record, imagined_label, real_label, steps_on
from semnav_agents.scripted import ScriptedAgent
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import Episode
from semnav_env.language.clauses import Clause, GoToRoom
from semnav_env.language.command import Command
from semnav_env.language.encoding import encode
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.goal import door_of
from semnav_env.mind.observations import EntryObservation, Moment, SeenGoal
from semnav_env.mind.observations.layout import GOAL
from semnav_env.robots import RobotSpec
from semnav_features.frames import relative, to_local
from semnav_features.lidar_spec import LidarSpec
from semnav_features.scene import Scene

DECISION_STEPS = 3
"""Steps of the environment between decisions of an agent that hears."""

KEPT_SHARE, KEPT_NEAR_SHARE, NEAR_GOAL_DISTANCE = 0.2, 0.5, 1.5
"""Shares of the decisions that are kept; and of those nearer to the goal than this, metres."""

IMAGINED_CLAUSES = 3
"""Number of imagined clauses, which were not said, for each kept sample."""

LATE_STEPS = 2
"""Number of decisions for which a completed clause is shown as completed."""


class GroundedGoal:
    """The entry "goal" beside those of `observation="command"`, for the agent that demonstrates."""

    name = "goal"

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> gym.Space[Any]:
        """The space of the entry."""
        return GOAL.space

    def observe(self, moment: Moment) -> NDArray[np.float32]:
        """The present target, robot frame."""
        belief = moment.belief
        goal, pose = belief.target, belief.pose
        door = door_of(goal)
        jambs = None if door is None else (to_local(pose, door.start), to_local(pose, door.end))
        return SeenGoal(goal.kind, relative(pose, goal.pose), jambs).values


class ShownAgent(ScriptedAgent):
    """The scripted agent on observations for an agent that hears."""

    observation = EntryObservation("command", [GroundedGoal()])


@dataclass
class Samples:
    """The collected samples."""

    descriptions: list[Description] = field(default_factory=list)
    labels: list[NDArray[np.void]] = field(default_factory=list)

    def add(self, description: Description, label: Label) -> None:
        """Keep a sample."""
        self.descriptions.append(description)
        self.labels.append(as_record(label, description.frame))

    def arrays(self) -> dict[str, NDArray[Any]]:
        """All of them as arrays by name, in half precision where that is enough."""
        parts = self.descriptions
        return {
            "elements": np.stack([each.elements for each in parts]).astype(np.float16),
            "count": np.array([each.mask.sum() for each in parts], np.int8),
            "bases": np.stack([each.bases for each in parts]),
            "command": np.stack([each.command for each in parts]).astype(np.float16),
            "jambs": np.stack([each.jambs for each in parts]),
            "robot": np.array([each.robot for each in parts], np.float32),
            "labels": np.stack(self.labels),
        }


class Collector:
    """Drives frozen episodes and labels the states of the driver.

    Args:
        commands: commands from which imagined clauses are drawn.
        seed: seed of the choice of samples.
        robot: name of the body.
        max_seconds: time limit of an episode.
    """

    def __init__(
        self,
        commands: Sequence[tuple[Clause, ...]],
        seed: tuple[int, ...],
        robot: str = "wheelchair",
        max_seconds: float = 300.0,
    ) -> None:
        self.commands, self.rng = commands, np.random.default_rng(seed)
        self.env = SemNavEnv(robot, observation=ShownAgent.observation, max_seconds=max_seconds)

    def drive(self, episode: Episode, driver: Agent, samples: Samples) -> bool:
        """Let a driver drive an episode; returns whether it succeeds."""
        observation, info = self.env.reset(seed=episode.number, options={"episode": episode})
        driver.reset(info)
        self._lidar = LidarSpec(**info["lidar"])
        self._mount = RobotSpec(**info["robot"]).lidar_mount
        follower = self.env.tracker.follower
        shown = ClauseState(observation["command"], self.env.belief.pose)
        late: list[tuple[ClauseState, int]] = []
        over, step = False, 0
        while not over:
            late = self._follow(shown, follower, late)
            if step % DECISION_STEPS == 0 or (late and late[-1][1] == LATE_STEPS + 1):
                self._keep(observation, shown, follower, samples)
                late = self._keep_late(observation, late, follower, samples)
            action = driver.act(observation)
            self._keep_own(driver, follower, samples)
            observation, _, terminated, truncated, info = self.env.step(action)
            over, step = terminated or truncated, step + 1
        return bool(info["is_success"])

    def _follow(
        self, shown: ClauseState, follower: Follower, late: list[tuple[ClauseState, int]]
    ) -> list[tuple[ClauseState, int]]:
        """Bring the state that is shown to that of the environment's follower."""
        belief = self.env.belief
        pose, speed = belief.pose, float(np.hypot(*belief.velocity[:2]))
        period = 1.0 / self.env.setup.control_hz
        for state, _ in late:
            state.note(pose, speed, period)
        shown.note(pose, speed, period)
        if follower.active != shown.clause:
            late = [*late, (copy(shown), LATE_STEPS + 1)]
            shown.start_clause(follower.active, follower.begin, pose)
        return late

    def _keep(
        self, observation: Observation, shown: ClauseState, follower: Follower, samples: Samples
    ) -> None:
        """Keep a sample of the active clause, and of some imagined clauses."""
        pose = self.env.belief.pose
        label = real_label(follower, pose)
        if label is None or label.goal is None:
            return
        near = float(np.hypot(*np.subtract(label.goal.pose[:2], pose[:2]))) < NEAR_GOAL_DISTANCE
        if self.rng.random() > (KEPT_NEAR_SHARE if near else KEPT_SHARE):
            return
        samples.add(self._described(observation, shown), label)
        scene = self.env.belief.scene
        for _ in range(IMAGINED_CLAUSES):
            self._imagine(observation, shown, follower, scene, samples)

    def _keep_late(
        self,
        observation: Observation,
        late: list[tuple[ClauseState, int]],
        follower: Follower,
        samples: Samples,
    ) -> list[tuple[ClauseState, int]]:
        """Keep samples of clauses that have just been carried out; returns those to show again."""
        for state, _ in late:
            step = steps_on(follower.command.clauses, state.clause, follower.active)
            samples.add(self._described(observation, state), Label(None, step))
        return [(state, left - 1) for state, left in late if left > 1]

    def _imagine(
        self,
        observation: Observation,
        shown: ClauseState,
        follower: Follower,
        scene: Scene,
        samples: Samples,
    ) -> None:
        """Keep a sample of a clause of another command, as if it had been said here."""
        clauses = self.commands[int(self.rng.integers(len(self.commands)))]
        index = int(self.rng.integers(len(clauses)))
        label = imagined_label(clauses, index, follower, scene, self.env.belief.pose)
        if label is None:
            return
        rooms = [clause.name for clause in clauses if isinstance(clause, GoToRoom)]
        state = copy(shown)
        state.tokens, state.clause = encode(Command(clauses), rooms), index
        state.way_back = None
        samples.add(self._described(observation, state), label)

    def _keep_own(self, driver: Agent, follower: Follower, samples: Samples) -> None:
        """Keep a sample of the state in which a driving learner has just decided."""
        decisions = getattr(driver, "decisions", ())
        share = 1.0 if len(decisions) > 1 else KEPT_SHARE
        for state, description in decisions if not follower.done else ():
            if state.clause < follower.active:
                step = steps_on(follower.command.clauses, state.clause, follower.active)
                samples.add(description, Label(None, step))
            elif state.clause == follower.active and self.rng.random() < share:
                label = real_label(follower, self.env.belief.pose)
                if label is not None:
                    samples.add(description, label)

    def _described(self, observation: Observation, state: ClauseState) -> Description:
        return describe(observation, state, self._lidar, self._mount)
