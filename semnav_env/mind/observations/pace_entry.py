"""How fast the robot was told to drive, as an entry of the observation."""

from __future__ import annotations

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from semnav_env.language.clauses import Speed
from semnav_env.mind.observations.observer import Moment
from semnav_env.robots import RobotSpec
from semnav_features.lidar_spec import LidarSpec

PACES = (None, Speed.SLOW, Speed.FAST)
"""The paces, by the number that stands for each in the observation."""


class PaceEntry:
    """The pace of `Pace` clauses: 0 usual, 1 slow, 2 fast; shape (1,).

    Attributes:
        name: its key in the observation.
    """

    name = "pace"

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> Box[np.float32]:
        """The space of the entry."""
        return Box(0.0, len(PACES) - 1.0, (1,), np.float32)

    def observe(self, moment: Moment) -> NDArray[np.float32]:
        """The pace now."""
        return np.array([PACES.index(moment.tracker.follower.pace)], np.float32)


def read_pace(observation: dict[str, NDArray[np.float32]]) -> Speed | None:
    """The pace of an observation; None for the usual one, and without the entry."""
    return PACES[int(observation["pace"][0])] if "pace" in observation else None
