"""What a robot touches while a period is driven."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
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

    What is said is of the last control period; it is forgotten at the first contact of a later one.

    Args:
        body: of the robot.
        record: of its drive; `touches` is 0 at the start of a control period and is counted here.
    """

    def __init__(self, body: pymunk.Body, record: np.ndarray) -> None:
        self._body, self._count = body, record["touches"]
        self._impulses: list[float] = []
        self._places: list[tuple[Point, float]] = []

    def note(self, arbiter: pymunk.Arbiter, space: pymunk.Space, data: Any) -> None:
        """Called by the space for each pair of shapes that touch."""
        if not self._count[0]:
            self._impulses, self._places = [], []
        self._count[0] += 1
        self._impulses.append(arbiter.total_impulse.length)
        if len(self._places) >= MOST_TOUCHES:
            return
        first, second = arbiter.bodies
        other = second if first is self._body else first
        if other.body_type != pymunk.Body.STATIC:
            return
        met = arbiter.contact_point_set
        inward = met.normal if first is self._body else -met.normal
        self._places += [((p.point_b.x, p.point_b.y), inward.angle) for p in met.points]

    @property
    def in_contact(self) -> bool:
        """Whether anything was touched."""
        return bool(self._count[0])

    @property
    def contacts(self) -> Contacts:
        """How often and how hard."""
        if not self.in_contact:
            return Contacts()
        return Contacts(len(self._impulses), math.fsum(self._impulses))

    def touches(self, pose: Pose) -> list[Contact]:
        """Where a robot at a pose touches what cannot move, robot frame."""
        return [
            (*to_local(pose, place), wrap_angle(inward - pose[2]))
            for place, inward in (self._places if self.in_contact else ())
        ]
