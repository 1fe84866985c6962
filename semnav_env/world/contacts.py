"""What a robot touches while a period is driven."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import pymunk

from semnav_env.features.frames import Contact, Point, Pose, to_local, wrap_angle

MOST_TOUCHES = 8
"""Of a step's touches only the first so many are looked at: substeps repeat them."""


@dataclass(frozen=True)
class Contacts:
    """What the robot touched during one step.

    Attributes:
        count: solid segments touched, summed over the substeps.
        impulse: sum of the magnitudes of the impulses it received, N s.
    """

    count: int = 0
    impulse: float = 0.0


class ContactLog:
    """Notes the contacts of a body, as a callback of the space.

    Args:
        body: of the robot.
    """

    def __init__(self, body: pymunk.Body) -> None:
        self._body = body
        self.clear()

    def clear(self) -> None:
        """Begin the next step."""
        self.impulses: list[float] = []
        self._places: list[tuple[Point, float]] = []

    def note(self, arbiter: pymunk.Arbiter, space: pymunk.Space, data: Any) -> None:
        """Called by the space for each pair of shapes that touch."""
        self.impulses.append(arbiter.total_impulse.length)
        first, second = arbiter.bodies
        other = second if first is self._body else first
        if other.body_type != pymunk.Body.STATIC or len(self._places) >= MOST_TOUCHES:
            return
        met = arbiter.contact_point_set
        inward = met.normal if first is self._body else -met.normal
        self._places += [((p.point_b.x, p.point_b.y), inward.angle) for p in met.points]

    @property
    def contacts(self) -> Contacts:
        """Of this step."""
        return Contacts(len(self.impulses), math.fsum(self.impulses))

    def touches(self, pose: Pose) -> list[Contact]:
        """Where a robot at a pose touches what cannot move, robot frame."""
        return [
            (*to_local(pose, place), wrap_angle(inward - pose[2])) for place, inward in self._places
        ]
