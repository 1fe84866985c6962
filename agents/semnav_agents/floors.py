"""Floors of benchmarks: agents that do not hear the command, to compare other agents with.

A table of agents says little without them: some commands are carried out by chance, and some by
good driving and guessing (Thomason et al. 2019, "Shifting the Baseline: Single Modality Performance
on Visual Navigation & QA").
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Observation
from semnav_agents.scripted import ScriptedAgent
from semnav_env.mind.grounding.goal import GoalKind
from semnav_env.mind.observations import SeenGoal, read_odometry, table
from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray, Pose, points_to_local, points_to_parent

HELD_STEPS = 15
"""Steps for which a random action holds, one second: shorter actions cancel each other out."""

AHEAD = SeenGoal(GoalKind.SEEK, (3.0, 0.0, 0.0), None)
"""Distance ahead to which a blind agent drives until it knows a door, metres."""

PASSED_DISTANCE = 0.5
"""Distance behind its door at which a blind agent has passed it, metres."""


class RandomAgent:
    """Draws actions from the whole action space, each for a second, whatever it observes."""

    observation = "raw"

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode; its chance depends on the start pose alone."""
        self._rng, self._size = _generator(info), RobotSpec(**info["robot"]).action_size
        self._left = 0

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The next action."""
        if self._left == 0:
            self._left = HELD_STEPS
            self._action = self._rng.uniform(-1.0, 1.0, self._size).astype(np.float32)
        self._left -= 1
        return self._action.copy()


class BlindAgent:
    """Drives like the scripted agent, but through any door: it does not hear the command.

    It chooses one of the doors that it knows at random, drives through, and chooses the next one.
    """

    observation = "all"

    def __init__(self) -> None:
        self._driver = ScriptedAgent()

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode; its chance depends on the start pose alone."""
        self._rng = _generator(info)
        self._driver.reset(info)
        self._door: FloatArray | None = None

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The next action; goal and clause of the observation are not read."""
        pose, _ = read_odometry(observation)
        if self._door is None:
            self._door = self._chosen(observation, pose)
        goal = AHEAD if self._door is None else self._through(self._door, pose)
        return self._driver.act({**observation, "goal": goal.values})

    def _chosen(self, observation: Observation, pose: Pose) -> FloatArray | None:
        """The jambs of a chosen door, odom frame, with the far side to their left."""
        doors = table(observation, "remembered_doors").astype(np.float64)
        if not len(doors):
            return None
        jambs = doors[self._rng.integers(len(doors))].reshape(2, 2)
        if np.linalg.det(jambs) > 0.0:  # the robot, the origin, is to be on the right of the door
            jambs = jambs[::-1]
        return points_to_parent(pose, jambs)

    def _through(self, door: FloatArray, pose: Pose) -> SeenGoal:
        """The goal of going through a door; the door is forgotten behind it."""
        start, end = points_to_local(pose, door).tolist()
        x, y = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
        outward = math.atan2(end[0] - start[0], start[1] - end[1])
        c, s = math.cos(outward), math.sin(outward)
        if -(c * x + s * y) > PASSED_DISTANCE:
            self._door = None
        return SeenGoal(GoalKind.PASS, (x + c, y + s, outward), (tuple(start), tuple(end)))


def _generator(info: dict[str, Any]) -> np.random.Generator:
    return np.random.default_rng(np.array(info["pose"], np.float64).view(np.uint64))
