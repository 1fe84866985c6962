"""The pose of the lidar on the robot, from the transforms that the robot publishes."""

from __future__ import annotations

import math

from semnav_features.frames import ORIGIN, Pose, compose
from semnav_ros.messages import TransformMessage

MOST_TILT = math.radians(3.0)
"""Largest tilt of a lidar's plane that is taken as level, radians."""

LONGEST_CHAIN = 32
"""Most frames between the lidar and the base."""


class FixedFrames:
    """The fixed transforms of a robot."""

    def __init__(self) -> None:
        self._parents: dict[str, TransformMessage] = {}

    def take(self, transform: TransformMessage) -> None:
        """Note where a frame lies."""
        self._parents[_plain(transform.child)] = transform

    def pose(self, child: str, base: str) -> Pose | None:
        """The pose of a frame in the base frame; None if the transforms do not lead there.

        Raises:
            ValueError: a frame between them is tilted.
        """
        pose, name = ORIGIN, _plain(child)
        for _ in range(LONGEST_CHAIN):
            if name == _plain(base):
                return pose
            if (transform := self._parents.get(name)) is None:
                return None
            pose, name = compose(_level_pose(transform), pose), _plain(transform.parent)
        return None


def _plain(name: str) -> str:
    """The name of a frame without the slash that ROS 1 once put before it."""
    return name.lstrip("/")


def _level_pose(transform: TransformMessage) -> Pose:
    x, y, z, w = transform.quaternion
    if not math.cos(MOST_TILT) <= 1.0 - 2.0 * (x * x + y * y):
        raise ValueError(
            f"the frame {transform.child!r} is tilted or upside down; the lidar must be level: "
            "give its pose by --mount, and turn its scans in the driver"
        )
    return *transform.place, heading_of(x, y, z, w)


def heading_of(x: float, y: float, z: float, w: float) -> float:
    """The heading of a quaternion, radians."""
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
