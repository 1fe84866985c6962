"""The depth cameras of a robot, as data: where they are, and what they measure."""

from __future__ import annotations

from dataclasses import dataclass

from semnav_env.robots.depth_camera import DepthCamera
from semnav_env.robots.rigs import (
    FULL_HEIGHT_CAMERAS,
    FULL_HEIGHT_SOURCE,
    SPOT_CAMERAS,
    SPOT_SOURCE,
)


@dataclass(frozen=True)
class DepthRig:
    """Depth cameras on a robot.

    Attributes:
        name: of the rig.
        cameras: in the robot frame.
        source: where the numbers come from.
    """

    name: str
    cameras: tuple[DepthCamera, ...]
    source: str = ""

    @classmethod
    def spot(cls) -> DepthRig:
        """The five stereo pairs of SPOT, tilted down so that little above 1 m is seen."""
        return cls("spot", SPOT_CAMERAS, SPOT_SOURCE)

    @classmethod
    def full_height(cls) -> DepthRig:
        """Four wide depth cameras that see from the floor to the lintel."""
        return cls("full_height", FULL_HEIGHT_CAMERAS, FULL_HEIGHT_SOURCE)

    @property
    def pixels(self) -> int:
        """The most points of a cloud."""
        return sum(camera.rows * camera.columns for camera in self.cameras)
