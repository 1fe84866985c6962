"""The robots as seen from above, drawn to scale."""

from __future__ import annotations

import numpy as np

from semnav_env.rendering import palette
from semnav_env.rendering.camera import Camera
from semnav_env.rendering.canvas import ShapeCanvas
from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray, Point, Pose, points_to_parent


def draw_body(
    canvas: ShapeCanvas, camera: Camera, robot: RobotSpec, pose: Pose, in_contact: bool = False
) -> None:
    """Draw the footprint, the wheels or legs, and an arrow towards the front."""
    pen = _Pen(canvas, camera, pose)
    length, width = robot.length, robot.width
    halo, edge = palette.CONTACT if in_contact else palette.WHITE, palette.INK
    pen.slab((0.0, 0.0), (length, width), halo, 5.0 if in_contact else 3.0)
    if robot.holonomic:
        _draw_legged(pen, length, width, edge)
    else:
        _draw_wheeled(pen, length, width, robot.axle, edge)


class _Pen:
    """Draws rectangles and arrows given in metres in the robot frame."""

    def __init__(self, canvas: ShapeCanvas, camera: Camera, pose: Pose) -> None:
        self._canvas, self._camera, self._pose = canvas, camera, pose

    def slab(self, centre: Point, size: Point, colour: palette.Colour, grow: float = 0.0) -> None:
        """A rectangle with rounded corners; `grow` widens it by units of the page."""
        outline = self._page(rounded_rectangle(centre, size, 0.16 * min(size)))
        self._canvas.polygon(outline, colour)
        if grow:
            self._canvas.stroke([*outline, outline[0]], colour, 2 * grow)

    def arrow(self, back: float, front: float, half: float, colour: palette.Colour) -> None:
        """An arrowhead on the x axis."""
        points = np.array([(front, 0.0), (back, half), (back + 0.35 * half, 0.0), (back, -half)])
        self._canvas.polygon(self._page(points), colour)

    def _page(self, points: FloatArray) -> FloatArray:
        return self._camera.pixels(points_to_parent(self._pose, points))


def _draw_wheeled(
    pen: _Pen, length: float, width: float, axle: float, edge: palette.Colour
) -> None:
    """Draw a seat between two large driven wheels on the axle, with castors in front."""
    rim = 0.04
    pen.slab((0.0, 0.0), (length, width), edge)
    pen.slab((0.0, 0.0), (length - rim, width - rim), palette.CHAIR)
    pen.slab((axle, 0.0), (0.68 * length, 0.62 * width), palette.CHAIR_SEAT)
    pen.slab((-0.43 * length, 0.0), (0.09 * length, 0.62 * width), palette.TYRE)
    for side in (-1, 1):
        pen.slab((axle, side * 0.42 * width), (0.5 * length, 0.12 * width), palette.TYRE)
        pen.slab((0.4 * length, side * 0.38 * width), (0.13 * length, 0.08 * width), palette.TYRE)
    pen.arrow(0.04 * length, 0.36 * length, 0.25 * width, palette.WHITE)


def _draw_legged(pen: _Pen, length: float, width: float, edge: palette.Colour) -> None:
    """Draw a narrow yellow trunk with a dark face between four legs."""
    rim = 0.04
    pen.slab((0.0, 0.0), (length, 0.62 * width), edge)
    pen.slab((0.0, 0.0), (length - rim, 0.62 * width - rim), palette.SPOT)
    pen.slab((-0.05 * length, 0.0), (0.6 * length, 0.36 * width), palette.SPOT_BACK)
    pen.slab((0.46 * length, 0.0), (0.08 * length, 0.5 * width), palette.TYRE)
    for end in (-1, 1):
        for side in (-1, 1):
            pen.slab((end * 0.3 * length, side * 0.4 * width), (0.2 * length, 0.2 * width), edge)
    pen.arrow(0.02 * length, 0.36 * length, 0.22 * width, palette.TYRE)


def rounded_rectangle(centre: Point, size: Point, radius: float) -> FloatArray:
    """Counter-clockwise outline with five points to a corner, shape (20, 2), metres."""
    quarter = np.linspace(0.0, np.pi / 2, 5)
    arcs = []
    for index, (sx, sy) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        angles = quarter + index * np.pi / 2
        x = centre[0] + sx * (size[0] / 2 - radius) + radius * np.cos(angles)
        y = centre[1] + sy * (size[1] / 2 - radius) + radius * np.sin(angles)
        arcs.append(np.stack((x, y), axis=-1))
    return np.concatenate(arcs)
