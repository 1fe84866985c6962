"""The learned agent, which runs a trained policy with NumPy alone."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from semnav_agents.base import Observation
from semnav_agents.hearing.network import NetworkShape
from semnav_agents.learning.actions import for_body
from semnav_agents.learning.compact import (
    COMPACT_ENTRIES,
    COMPACT_SIZE,
    CompactObserver,
    unseen,
)
from semnav_agents.learning.inertia import Inertia
from semnav_agents.learning.policy import Policy, PolicySettings
from semnav_agents.learning.shield import Shield
from semnav_agents.networks.bundled import bundled_names, network_folder, network_kind
from semnav_env.mind.observations import read_odometry
from semnav_env.mind.observations.layout import GOAL
from semnav_env.networks.card import CARD_FILE, Card, card_fields
from semnav_env.robots import RobotSpec, robot_spec
from semnav_features.frames import points_to_parent
from semnav_features.lidar_spec import LidarSpec

_STOP = GOAL.columns.index("stop")
"""Where in the goal it says that the robot is to stand still."""


def pretrained_names() -> tuple[str, ...]:
    """Names of the policies that come with the package, sorted."""
    return bundled_names(PolicySettings)


def agent_label(name: str) -> dict[str, object]:
    """The entries of the results that name an agent; a trained agent has a preset and a seed.

    Returns:
        "agent" and "training_seed", which is -1 for an agent that is not trained.
    """
    if network_kind(name) not in (PolicySettings.KIND, NetworkShape.KIND):
        return {"agent": name, "training_seed": -1}
    folder = network_folder(name)
    card = card_fields(folder)
    label = card["preset"].get("name", folder.name)
    return {"agent": str(label), "training_seed": card["seed"]}


class LearnedAgent:
    """An agent that runs a trained policy without exploration noise.

    Args:
        policy: from a compact observation to an action.
        robots: names of the bodies that it was trained on.
        repeat: steps for which an action holds.
        shielded: whether each action is checked against the remembered obstacles, see `Shield`.
    """

    observation = "all"
    policy: Policy
    robots: tuple[str, ...]
    repeat: int
    shielded: bool

    def __init__(
        self, policy: Policy, robots: tuple[str, ...], repeat: int, shielded: bool = True
    ) -> None:
        self.policy, self.robots, self.repeat = policy, robots, repeat
        self.shielded = shielded
        self._held = 0
        self._observer: CompactObserver
        self._robot: RobotSpec
        self._action: NDArray[np.float32]

    @classmethod
    def load(cls, path: str | Path) -> Self:
        """The agent in a folder that `semnav train` wrote, or one of `pretrained_names`.

        A policy that has learned nothing yet is a warning.

        Raises:
            ValueError: there is none, it is damaged, or it does not fit this version.
            OSError: a file cannot be read.
        """
        folder = network_folder(path)
        card = Card.read(folder, PolicySettings)
        settings, widths = card.settings, card.settings.widths
        if settings.is_untrained:
            warnings.warn(
                f"{folder} holds an untrained policy, of 0 decisions; go on with "
                f"`semnav train {card.preset.get('name')} --out {folder} --resume`",
                stacklevel=2,
            )
        try:
            sizes = [robot_spec(robot).action_size for robot in settings.robots]
        except ValueError as error:
            raise ValueError(f"{folder / CARD_FILE}: {error}") from None
        fitting = (COMPACT_SIZE, max(sizes))
        if (widths[0], widths[-1]) != fitting:
            raise ValueError(
                f"{folder}: the policy takes {widths[0]} values and gives {widths[-1]}; this "
                f"version has {fitting[0]} and {fitting[1]}: train it anew"
            )
        return cls(Policy.load(folder, card), settings.robots, settings.repeat)

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode.

        Raises:
            ValueError: the robot is not the one that it was trained on.
        """
        self._robot = RobotSpec(**info["robot"])
        if self._robot.name not in self.robots:
            trained = " and ".join(map(repr, self.robots))
            raise ValueError(f"this agent was trained on {trained}, not {self._robot.name!r}")
        lidar = LidarSpec(**info["lidar"])
        self._observer = CompactObserver([self._robot], lidar)
        self._shield = Shield(self._robot) if self.shielded else None
        self._inertia = Inertia(self._robot)
        self._held = 0

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The action; the policy chooses a new one every `repeat` steps, unless it is to stop."""
        if observation["goal"][_STOP]:
            return np.zeros(self._robot.action_size, np.float32)
        row = {name: observation[name][None] for name in COMPACT_ENTRIES}
        pose, velocity = read_odometry(observation)
        if self._held == 0:
            action = self._inertia.act(self.policy, self._observer.observe(row)[0], pose)
            self._action = for_body(action, self._robot.action_size)
        self._held = (self._held + 1) % self.repeat
        if self._shield is None:
            return self._action.copy()
        more = points_to_parent(pose, unseen(row, 0))
        points = np.vstack((self._observer.memories[0].points, more))
        return self._shield.checked(self._action, points, pose, velocity)
