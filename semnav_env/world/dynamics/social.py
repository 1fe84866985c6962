"""Nearness of a robot and people: gaps, intrusions and times to collision."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.world.dynamics.body_row import (
    BODY_HEADING,
    BODY_VX,
    BODY_VY,
    BODY_X,
    BODY_Y,
    HALF_LENGTH,
    HALF_WIDTH,
)
from semnav_env.world.dynamics.nearby import nearest_on_body
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

PERSONAL_SPACE = 0.45
"""Gap between two bodies below which one intrudes on the other, metres: the intimate distance of E.
T. Hall, The hidden dimension (1966), chapter 10."""


@dataclass
class SocialRecord:
    """Nearness of robot and people over an episode.

    Attributes:
        intrusions: number of times that the gap to a person fell below `PERSONAL_SPACE`.
        intruding_seconds: for how long some gap was below it.
        least_gap: smallest gap between footprint and body, metres.
        least_seconds: smallest time to collision, s.
    """

    intrusions: int = 0
    intruding_seconds: float = 0.0
    least_gap: float = math.inf
    least_seconds: float = math.inf
    _near: NDArray[np.bool_] | None = field(init=False, repr=False, default=None)

    def begin(self) -> None:
        """Forget the last episode."""
        self.intrusions, self.intruding_seconds = 0, 0.0
        self.least_gap = self.least_seconds = math.inf
        self._near = None

    def note(
        self, body: FloatArray, discs: FloatArray, velocities: FloatArray, seconds: float
    ) -> None:
        """Record a time step.

        Args:
            body: the robot, see `nearest_on_body`.
            discs: x, y and radius of people, metres, shape (n, 3).
            velocities: velocities of people, m/s, shape (n, 2).
            seconds: length of the step.
        """
        if len(discs) == 0:
            return
        apart = gaps(body, discs)
        near = apart < PERSONAL_SPACE
        before = np.zeros_like(near) if self._near is None else self._near
        self.intrusions += int((near & ~before).sum())
        self.intruding_seconds += seconds * bool(near.any())
        self.least_gap = min(self.least_gap, float(apart.min()))
        soonest = float(times_to_collision(body, discs, velocities).min())
        self.least_seconds = min(self.least_seconds, soonest)
        self._near = near

    def outcome(self) -> dict[str, Any]:
        """The record as entries of `info` at the end of an episode."""
        return {
            "personal_space_intrusions": self.intrusions,
            "personal_space_seconds": self.intruding_seconds,
            "least_gap_to_people": self.least_gap,
            "least_time_to_collision": self.least_seconds,
        }


def for_json(outcome: dict[str, Any]) -> dict[str, Any]:
    """An outcome that JSON can hold: None in place of infinite values and NaN."""
    return {name: value if math.isfinite(value) else None for name, value in outcome.items()}


@kernel
def gaps(body: FloatArray, discs: FloatArray) -> FloatArray:
    """Distance between the robot's footprint and each person's body, metres, shape (n,).

    0 where they touch or overlap.

    Args:
        body: the robot, see `nearest_on_body`.
        discs: x, y and radius, metres, shape (n, 3).
    """
    found = np.empty(len(discs))
    for i in range(len(discs)):
        near_x, near_y = nearest_on_body(discs[i, 0], discs[i, 1], body)
        distance = math.hypot(discs[i, 0] - near_x, discs[i, 1] - near_y)
        found[i] = max(distance - discs[i, 2], 0.0)
    return found


@kernel
def times_to_collision(body: FloatArray, discs: FloatArray, velocities: FloatArray) -> FloatArray:
    """Time until each person's body meets the footprint if both keep their velocity, seconds.

    Both move straight on; the robot's turning is left out. The footprint grown by the radius of
    the disc is two rectangles and four discs; the first of them that the disc's centre enters
    says when. 0 where they overlap, infinite where they never meet.

    Args:
        body: the robot, see `nearest_on_body`.
        discs: x, y and radius, metres, shape (n, 3).
        velocities: velocities of people, m/s, shape (n, 2).
    """
    c, s = math.cos(body[BODY_HEADING]), math.sin(body[BODY_HEADING])
    found = np.empty(len(discs))
    for i in range(len(discs)):
        dx, dy, radius = discs[i, 0] - body[BODY_X], discs[i, 1] - body[BODY_Y], discs[i, 2]
        vx, vy = velocities[i, 0] - body[BODY_VX], velocities[i, 1] - body[BODY_VY]
        x, y, u, v = c * dx + s * dy, c * dy - s * dx, c * vx + s * vy, c * vy - s * vx
        half_x, half_y = body[HALF_LENGTH], body[HALF_WIDTH]
        best = min(
            _into_box(x, y, u, v, half_x + radius, half_y),
            _into_box(x, y, u, v, half_x, half_y + radius),
        )
        for k in range(4):
            corner_x, corner_y = half_x * (1 - 2 * (k % 2)), half_y * (1 - 2 * (k // 2))
            best = min(best, _into_disc(x - corner_x, y - corner_y, u, v, radius))
        found[i] = best
    return found


@kernel
def _into_box(x: float, y: float, u: float, v: float, half_x: float, half_y: float) -> float:
    """Time at which a point moving with (u, v) enters |x| <= half_x, |y| <= half_y, seconds."""
    first, last = 0.0, np.inf
    for place, speed, half in ((x, u, half_x), (y, v, half_y)):
        if abs(speed) < 1e-12:
            if abs(place) > half:
                return np.inf
        else:
            one, two = (-half - place) / speed, (half - place) / speed
            first, last = max(first, min(one, two)), min(last, max(one, two))
    return first if first <= last else np.inf


@kernel
def _into_disc(x: float, y: float, u: float, v: float, radius: float) -> float:
    """Time at which a point moving with (u, v) enters a disc around the origin, seconds."""
    outside = x * x + y * y - radius * radius
    if outside <= 0.0:
        return 0.0
    squared, towards = u * u + v * v, -(x * u + y * v)
    root = towards * towards - squared * outside
    if towards <= 0.0 or root < 0.0:
        return np.inf
    return outside / (towards + math.sqrt(root))
