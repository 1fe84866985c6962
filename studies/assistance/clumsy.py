"""Simulated clumsy drivers."""

from __future__ import annotations

import math
from collections import deque
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Agent, Observation
from semnav_agents.registry import make_agent
from semnav_env.mind.grounding.goal import GoalKind
from semnav_env.mind.observations import SeenGoal
from semnav_env.robots import RobotSpec
from semnav_features.lidar_spec import LidarSpec


@dataclass(frozen=True)
class Clumsiness:
    """What makes a driver clumsy.

    Attributes:
        delay: reaction time, seconds.
        noise: standard deviation of what is added to each part of an action, shares.
        memory: time over which that noise is correlated, seconds: a hand does not jump.
    """

    delay: float
    noise: float
    memory: float = 0.5


class ClumsyDriver:
    """An agent that acts late and with a trembling hand.

    The noise is an Ornstein-Uhlenbeck process.

    Args:
        driver: who decides.
        clumsiness: how it is carried out.
        seed: of the noise.
    """

    def __init__(self, driver: Agent, clumsiness: Clumsiness, seed: int) -> None:
        self.driver, self.observation = driver, driver.observation
        self._clumsiness, self._seed = clumsiness, seed

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode; the noise begins anew."""
        self.driver.reset(info)
        rate = LidarSpec(**info["lidar"]).rate_hz
        size = RobotSpec(**info["robot"]).action_size
        late = round(self._clumsiness.delay * rate)
        self._late = deque([np.zeros(size, np.float32)] * late)
        self._kept = math.exp(-1.0 / (self._clumsiness.memory * rate))
        self._rng, self._noise = np.random.default_rng(self._seed), np.zeros(size)

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The action that was decided on a while ago, with noise."""
        self._late.append(self.driver.act(observation))
        spread = self._clumsiness.noise * math.sqrt(1.0 - self._kept**2)
        drawn = self._rng.normal(0.0, spread, self._noise.shape)
        self._noise = self._kept * self._noise + drawn
        return np.clip(self._late.popleft() + self._noise, -1.0, 1.0).astype(np.float32)


class BeeLineDriver:
    """Steers straight to the goal, whatever stands in the way, like who looks at nothing else."""

    observation = "all"

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode."""
        self._robot = RobotSpec(**info["robot"])

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """Turn towards the goal, and drive on the faster the straighter it lies ahead."""
        goal = SeenGoal.read(observation["goal"])
        action = np.zeros(self._robot.action_size, np.float32)
        x, y, heading = goal.pose
        if goal.kind is GoalKind.STOP:
            return action
        there = math.hypot(x, y) < 0.2
        off = heading if there else math.atan2(y, x)
        action[0] = 0.0 if there else 0.5 * max(0.0, math.cos(off))
        action[-1] = max(-0.6, min(0.6, off))
        return action


DRIVERS = {"scripted": lambda: make_agent("scripted"), "bee line": BeeLineDriver}
"""Those who decide, by name."""
