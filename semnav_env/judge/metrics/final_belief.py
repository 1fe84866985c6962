"""What a robot believed at the end of an episode, for pictures of what went wrong."""

from __future__ import annotations

from dataclasses import dataclass

from semnav_features.frames import Point
from semnav_features.scene import Door


@dataclass(frozen=True)
class FinalBelief:
    """The doors that a robot remembered at the end, and where its agent was driving to.

    Attributes:
        doors: remembered doors, world frame, as seen from the true pose of the robot.
        goal: place of the agent's own goal, likewise, metres.
    """

    doors: tuple[Door, ...]
    goal: Point
