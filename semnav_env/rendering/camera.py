"""Maps metres in the world to pixels on the page, and chooses the part of the world to show."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from semnav_features.frames import FloatArray, Point

PLAN_MARGIN = 0.4
"""Margin around a plan that is shown whole, metres."""

FOLLOW_SPAN = 16.0
"""Length of the shorter side of a view that follows the robot, metres."""

MAX_FIT_FACTOR = 1.35
"""Largest size of a plan that is still shown whole, as a multiple of `FOLLOW_SPAN`."""


@dataclass(frozen=True, slots=True)
class Viewport:
    """A rectangle of the page, pixels: left, top, width, height."""

    left: float
    top: float
    width: float
    height: float


@dataclass(frozen=True, slots=True)
class Camera:
    """A similarity from the world (y up) to the page (y down).

    Attributes:
        scale: pixels per metre.
        origin: page position of the world's origin.
    """

    scale: float
    origin: Point

    def pixels(self, points: ArrayLike) -> FloatArray:
        """World points of shape (..., 2) as page positions."""
        return np.asarray(points, dtype=np.float64) * (self.scale, -self.scale) + self.origin

    def pixel(self, point: Point) -> Point:
        """`pixels` for one point."""
        return self.origin[0] + self.scale * point[0], self.origin[1] - self.scale * point[1]


def looking_at(
    bounds: tuple[float, float, float, float], position: Point, view: Viewport, grid: float
) -> Camera:
    """The camera on the whole plan where it is small, else on the surroundings of `position`.

    Args:
        bounds: least x, least y, greatest x and greatest y of the plan, metres.
        position: position of the robot, metres.
        view: rectangle of the page to fill.
        grid: the origin is rounded to multiples of this many pixels, so that a plan drawn once
            can be pasted.
    """
    size = bounds[2] - bounds[0] + 2 * PLAN_MARGIN, bounds[3] - bounds[1] + 2 * PLAN_MARGIN
    fit = min(view.width / size[0], view.height / size[1])
    follow = min(view.width, view.height) / FOLLOW_SPAN
    scale = fit if fit * MAX_FIT_FACTOR >= follow else follow
    seen = view.width / scale, view.height / scale
    x, y = (
        _centre(
            bounds[axis] - PLAN_MARGIN, bounds[axis + 2] + PLAN_MARGIN, seen[axis], position[axis]
        )
        for axis in (0, 1)
    )
    return Camera(
        scale,
        (
            _rounded(view.left + view.width / 2 - scale * x, grid),
            _rounded(view.top + view.height / 2 + scale * y, grid),
        ),
    )


def _centre(low: float, high: float, seen: float, wanted: float) -> float:
    """The centre of the view nearest to `wanted` that shows nothing beyond the plan."""
    if seen >= high - low:
        return (low + high) / 2
    return min(max(wanted, low + seen / 2), high - seen / 2)


def _rounded(value: float, grid: float) -> float:
    return math.floor(value / grid + 0.5) * grid
