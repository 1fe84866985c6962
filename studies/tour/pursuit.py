"""Follows a way on the believed pose alone: what a robot does that trusts its plan."""

from __future__ import annotations

import math

import numpy as np

from semnav_env.robots import SPOT
from semnav_features.frames import Contact, FloatArray, Point, Pose, Twist, to_local
from studies.tour.villa import SPACING

SPEED, YAW_GAIN = 0.7, 2.0
"""On a straight way, m/s; and of the heading, 1/s."""

AHEAD, LOOK_AHEAD = 0.3, 0.6
"""How far ahead on the way lie the place to drive to and the one to face, metres."""

AWAY_SPEED = 0.15
"""Of a step away from what is touched, m/s."""

WINDOW = 0.8
"""How far ahead on the way the robot may believe to be within one period, metres."""


class PlanPursuit:
    """Pure pursuit (Coulter 1992) for a robot that can also step sideways.

    Args:
        way: points `SPACING` apart, shape (n, 2).

    Attributes:
        reached: index of the point of the way that the robot believes to be at.
    """

    def __init__(self, way: FloatArray) -> None:
        self.way, self.reached = way, 0

    @property
    def is_done(self) -> bool:
        """Whether the robot believes to be at the end."""
        return self.reached >= len(self.way) - 2

    def twist(self, believed: Pose, touches: list[Contact]) -> Twist:
        """The next velocity, robot frame; it turns first where the way turns sharply.

        Args:
            believed: pose, world frame.
            touches: what the body touches; it steps away from that.
        """
        near = self.way[self.reached : self.reached + round(WINDOW / SPACING)]
        self.reached += int(np.hypot(*(near - believed[:2]).T).argmin())
        x, y = to_local(believed, self._ahead(AHEAD))
        face_x, face_y = to_local(believed, self._ahead(LOOK_AHEAD))
        turn = math.atan2(face_y, face_x)
        speed = SPEED * max(0.0, math.cos(min(2.0 * abs(turn), 0.5 * math.pi)))
        share = speed / max(math.hypot(x, y), 1e-6)
        limit = SPOT.max_turn_rate
        twist = share * x, share * y, float(np.clip(YAW_GAIN * turn, -limit, limit))
        for touch in touches:
            twist = _away(twist, touch)
        return twist

    def _ahead(self, distance: float) -> Point:
        x, y = self.way[min(self.reached + round(distance / SPACING), len(self.way) - 1)].tolist()
        return x, y


def _away(twist: Twist, touch: Contact) -> Twist:
    """The velocity without what drives the touching point on, and a step back."""
    (forward, left, turn), (x, y, into) = twist, touch
    c, s = math.cos(into), math.sin(into)
    back = max(0.0, c * forward + s * left) + AWAY_SPEED
    presses = turn * (s * x - c * y) > 0.0
    return forward - back * c, left - back * s, 0.0 if presses else turn
