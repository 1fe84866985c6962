"""The cloud of a robot's depth cameras as an entry of the observation."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from semnav_env.mind.observations.layout import FEATURE_BOUND
from semnav_env.mind.observations.observer import Moment

if TYPE_CHECKING:
    from semnav_env.robots import DepthRig, RobotSpec
    from semnav_features.lidar_spec import LidarSpec


class CloudEntry:
    """An extra entry "cloud", for `EntryObservation(mode, extra=[CloudEntry(DepthRig.spot())])`.

    One flat array of rows x, y, z and counts: metres in the robot frame, z up from the floor, and
    1 for a point, 0 for a row that is left over. A larger cloud is thinned evenly. Where the
    observation has it, `render` shows the cloud and the jambs that are found in it.

    Args:
        rig: the cameras.
        points: rows.

    Raises:
        ValueError: no rows.
    """

    rig: DepthRig
    points: int
    name = "cloud"

    def __init__(self, rig: DepthRig, points: int = 2048) -> None:
        if points < 1:
            raise ValueError(f"a cloud of {points} points; it must have at least 1")
        self.rig, self.points = rig, points

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> Box[np.float32]:
        """The space of the entry."""
        return Box(-FEATURE_BOUND, FEATURE_BOUND, (4 * self.points,), np.float32)

    def observe(self, moment: Moment) -> NDArray[np.float32]:
        """The present cloud of the cameras.

        Raises:
            ValueError: a moment without cameras.
        """
        if moment.see is None:
            raise ValueError("this moment has no depth cameras; give it `see`")
        points = moment.see(self.rig).thinned(self.points).points_robot
        rows = np.zeros((self.points, 4), np.float32)
        rows[: len(points), :3], rows[: len(points), 3] = points, 1.0
        return rows.clip(-FEATURE_BOUND, FEATURE_BOUND).ravel()


def rig_of(observation: Any) -> DepthRig | None:
    """The cameras whose cloud an observation holds; None if it holds none."""
    extra = getattr(observation, "extra", ())
    return next((entry.rig for entry in extra if isinstance(entry, CloudEntry)), None)
