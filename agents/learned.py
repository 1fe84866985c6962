"""The learned agent, which runs a trained policy with NumPy and safetensors alone."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from semnav_env.agents.base import Observation
from semnav_env.agents.learning.compact import COMPACT_SIZE, compact
from semnav_env.agents.learning.files import AGENT_FILE, POLICY_FILE, AgentDescription, load_tensors
from semnav_env.agents.learning.policy import Policy
from semnav_env.robots import robot_spec

PRETRAINED_FOLDER = Path(__file__).with_name("pretrained")
"""Folder of the trained agents that come with the package."""


def pretrained_names() -> tuple[str, ...]:
    """Names of the trained agents that come with the package, sorted."""
    return tuple(sorted(path.parent.name for path in PRETRAINED_FOLDER.glob(f"*/{AGENT_FILE}")))


class LearnedAgent:
    """A trained policy, without the noise with which it explored.

    Args:
        policy: from a compact observation to an action.
        robot: name of the body that it was trained on.
        repeat: steps for which an action holds.
    """

    observation = "all"

    def __init__(self, policy: Policy, robot: str, repeat: int) -> None:
        self.policy, self.robot, self.repeat = policy, robot, repeat
        self._held = 0
        self._action: NDArray[np.float32]

    @classmethod
    def load(cls, path: str | Path) -> Self:
        """The agent in a folder that `semnav train` wrote, or one of `pretrained_names`.

        Raises:
            ValueError: there is none, it is damaged, or it does not fit this version.
            OSError: a file cannot be read.
            ImportError: safetensors is not installed.
        """
        folder = PRETRAINED_FOLDER / path if path in pretrained_names() else Path(path)
        description = AgentDescription.read(folder)
        try:
            fitting = (COMPACT_SIZE, robot_spec(description.robot).action_size)
        except ValueError as error:
            raise ValueError(f"{folder / AGENT_FILE}: {error}") from None
        widths = description.widths
        if (widths[0], widths[-1]) != fitting:
            raise ValueError(
                f"{folder}: the policy takes {widths[0]} values and gives {widths[-1]}; this "
                f"version has {fitting[0]} and {fitting[1]}: train it anew"
            )
        tensors = load_tensors(folder / POLICY_FILE)
        try:
            policy = Policy.from_tensors(tensors, widths)
        except ValueError as error:
            raise ValueError(f"{folder / POLICY_FILE}: {error}") from None
        return cls(policy, description.robot, description.repeat)

    def reset(self, info: dict[str, Any]) -> None:
        """Begin an episode.

        Raises:
            ValueError: the robot is not the one that it was trained on.
        """
        robot = info["robot"]["name"]
        if robot != self.robot:
            raise ValueError(f"this agent was trained on {self.robot!r}, not {robot!r}")
        self._held = 0

    def act(self, observation: Observation) -> NDArray[np.float32]:
        """The action; a new one is chosen every `repeat` steps."""
        if self._held == 0:
            self._action = self.policy.act(compact(observation))
        self._held = (self._held + 1) % self.repeat
        return self._action.copy()
