"""The robot's belief at the end of an episode, for pictures of failures."""

from __future__ import annotations

from dataclasses import dataclass

from semnav_features.frames import Point
from semnav_features.scene import Door


@dataclass(frozen=True)
class FinalBelief:
    """The doors that a robot remembered at the end, and the goal of its agent.

    Attributes:
        doors: remembered doors, world frame, as seen from the true pose of the robot.
        goal: place of the agent's own goal, likewise, metres.
    """

    doors: tuple[Door, ...]
    goal: Point
