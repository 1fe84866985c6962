"""Pictures of an episode, in memory or in a window."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.rendering.camera import Viewport, looking_at
from semnav_env.rendering.canvas import Canvas, image_array
from semnav_env.rendering.frame import Frame
from semnav_env.rendering.map_view import draw_map, draw_scale_bar
from semnav_env.rendering.panel import PANEL_WIDTH, draw_panel
from semnav_env.rendering.plan_layer import PlanLayer
from semnav_env.rendering.prompt import draw_prompt
from semnav_env.rendering.window import Window
from semnav_env.world.maps.floor_plan import FloorPlan

LEAST_WINDOW_SIZE = (320, 240)
"""Smallest width and height of a picture, pixels."""


class Viewer:
    """Draws frames of one floor plan; the plan itself is drawn once and kept.

    Needs no display for `draw`. A frame of another floor plan is drawn as well, at the cost of
    drawing that plan anew.

    Args:
        floor_plan: the plan that most frames will show.
        size: pixels, (width, height); every size shows the same picture.
        fps: frames per second that `show` slows down to.

    Raises:
        ValueError: a size that is too small or higher than wide, or a rate that is not positive.
        ImportError: pygame-ce is missing.
    """

    def __init__(
        self, floor_plan: FloorPlan, size: tuple[int, int] = (960, 720), fps: float = 15.0
    ) -> None:
        _check(size, fps)
        self.size, self.fps = size, fps
        self._canvas = Canvas(size)
        map_width = self._canvas.width - PANEL_WIDTH
        self._map = Viewport(0.0, 0.0, map_width, self._canvas.height)
        self._panel = Viewport(map_width, 0.0, PANEL_WIDTH, self._canvas.height)
        self._plan = PlanLayer(floor_plan, 0.0, self._canvas.zoom)
        self._window: Window | None = None

    def draw(self, frame: Frame) -> NDArray[np.uint8]:
        """A fresh picture, shape (height, width, 3), RGB."""
        return image_array(self._paint(frame))

    def show(self, frame: Frame) -> bool:
        """Show the frame in a window, opened at first; False once the user has closed it.

        Raises:
            RuntimeError: there is no display.
        """
        window = self.window
        return window.is_open and window.present(self._paint(frame))

    @property
    def window(self) -> Window:
        """The window; opened when it is asked for first.

        Raises:
            RuntimeError: there is no display.
        """
        if self._window is None:
            self._window = Window(self.size, "semnav-env", self.fps)
        return self._window

    def close(self) -> None:
        """Close the window if there is one; a second call does nothing."""
        if self._window is not None:
            self._window.close()
            self._window = None

    def _paint(self, frame: Frame) -> Any:
        canvas = self._canvas
        bounds = frame.floor_plan.boundary.bounds
        camera = looking_at(bounds, frame.pose[:2], self._map, canvas.pixel)
        if self._plan.floor_plan is not frame.floor_plan or self._plan.scale != camera.scale:
            self._plan = PlanLayer(frame.floor_plan, camera.scale, canvas.zoom)
        canvas.begin()
        with canvas.within(self._map):
            self._plan.paste_onto(canvas, camera, self._map)
            draw_map(canvas, camera, frame)
            draw_scale_bar(canvas, camera, self._map)
            if frame.prompt:
                draw_prompt(canvas, self._map, frame.prompt)
        draw_panel(canvas, self._panel, frame)
        return canvas.finish()


def _check(size: tuple[int, int], fps: float) -> None:
    if size[0] < LEAST_WINDOW_SIZE[0] or size[1] < LEAST_WINDOW_SIZE[1] or size[0] < size[1]:
        raise ValueError(
            f"size is {size}; it must be at least {LEAST_WINDOW_SIZE} pixels and not higher than "
            "wide"
        )
    if not fps > 0:
        raise ValueError(f"fps is {fps}; it must be positive")
