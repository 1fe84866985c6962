"""People and leaves as bodies of the physics: solid, and never pushed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
import pymunk

from semnav_features.frames import FloatArray

if TYPE_CHECKING:
    from semnav_env.world.dynamics.moving import Moving


class Movers:
    """Kinematic bodies that follow the people and leaves of `Moving`.

    Args:
        space: the space in which they are put.
        moving: the people and leaves.
        seconds: time between two of its steps.
    """

    def __init__(self, space: pymunk.Space, moving: Moving, seconds: float) -> None:
        self._space, self._moving, self._seconds = space, moving, seconds
        self._people = [self._person(radius) for _, _, radius in moving.discs.tolist()]
        self._leaves = [_kinematic(space) for _ in moving.doors.leaves]
        for body, leaf in zip(self._leaves, moving.doors.leaves, strict=True):
            body.position = leaf.hinge
            _add(space, pymunk.Segment(body, (0.0, 0.0), (leaf.length, 0.0), 0.0))
        self._angles = np.full(len(self._leaves), np.nan)
        self.arrive()

    def _person(self, radius: float) -> pymunk.Body:
        body = _kinematic(self._space)
        _add(self._space, pymunk.Circle(body, radius))
        return body

    def add_person(self) -> None:
        """Make the person solid that was added to `Moving` last."""
        x, y, radius = self._moving.discs[-1].tolist()
        self._people.append(self._person(radius))
        self._people[-1].position = x, y

    def add_box(self, corners: FloatArray) -> None:
        """Make a box solid, corners in metres, shape (4, 2)."""
        _add(self._space, pymunk.Poly(self._space.static_body, corners.tolist()))

    def go(self) -> None:
        """Give every body the velocity that leads to its new place."""
        seconds = self._seconds
        for body, (x, y, _) in zip(self._people, self._moving.discs.tolist(), strict=True):
            here = body.position
            body.velocity = (x - here.x) / seconds, (y - here.y) / seconds
        for body, angle in self._turning():
            body.angular_velocity = (angle - body.angle) / seconds

    def arrive(self) -> None:
        """Put every body at its exact place, without the rounding of many substeps, and at rest."""
        for body, (x, y, _) in zip(self._people, self._moving.discs.tolist(), strict=True):
            body.position, body.velocity = (x, y), (0.0, 0.0)
        for body, angle in self._turning():
            body.angle, body.angular_velocity = angle, 0.0
        self._angles = self._moving.doors.angles.copy()

    def _turning(self) -> Iterator[tuple[pymunk.Body, float]]:
        """The leaves that have moved, and their directions now."""
        doors = self._moving.doors
        for i in np.flatnonzero(doors.angles != self._angles).tolist():
            yield self._leaves[i], doors.leaves[i].closed + float(doors.angles[i])


def _kinematic(space: pymunk.Space) -> pymunk.Body:
    body = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
    space.add(body)
    return body


def _add(space: pymunk.Space, shape: pymunk.Shape) -> None:
    shape.friction = 1.0
    space.add(shape)
