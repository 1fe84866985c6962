"""Draws the pictures of an environment."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import Point, Pose

if TYPE_CHECKING:
    from semnav_env.rendering.snapshot import RenderedEnvironment
    from semnav_env.rendering.viewer import Viewer


class Renderer:
    """Makes the pictures of an environment; nothing is drawn or imported before the first one."""

    def __init__(self, floor_plan: FloorPlan) -> None:
        self._floor_plan = floor_plan
        self._viewer: Viewer | None = None
        self._trail: list[Point] = []

    def begin(self, start: Pose) -> None:
        """Begin a new episode: forget the trail."""
        self._trail = [start[:2]]

    def note(self, env: RenderedEnvironment, pose: Pose) -> None:
        """Add the place of the robot to the trail, and show it in "human" mode."""
        if env.render_mode is not None:
            self._trail.append(pose[:2])
        if env.render_mode == "human":
            self.draw(env)

    def draw(self, env: RenderedEnvironment) -> NDArray[np.uint8] | None:
        """The picture, or None in "human" mode, where it goes to a window, and without a mode."""
        if env.render_mode is None:
            gym.logger.warn("render() does nothing: give render_mode to gymnasium.make")
            return None
        from semnav_env.rendering.snapshot import snapshot  # most environments are never drawn
        from semnav_env.rendering.viewer import Viewer

        if self._viewer is None:
            self._viewer = Viewer(self._floor_plan, fps=env.metadata["render_fps"])
        frame = snapshot(env, self._trail)
        if env.render_mode == "human":
            self._viewer.show(frame)
            return None
        return self._viewer.draw(frame)

    def close(self) -> None:
        """Close the window, if any."""
        if self._viewer is not None:
            self._viewer.close()
            self._viewer = None

    def __getstate__(self) -> dict[str, Any]:
        """Leave out the viewer, which is created again after unpickling."""
        return {**self.__dict__, "_viewer": None}
