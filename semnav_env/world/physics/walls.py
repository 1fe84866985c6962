"""Makes the walls of a floor plan in a space, hundreds at once.

Pymunk makes an object in Python for each shape, with tables of what belongs to what, which takes
several times as long as Chipmunk's own work. Nobody asks which wall is which; therefore walls are
made as Chipmunk's shapes alone, in the order of the segments, and freed with their space.
"""

from __future__ import annotations

from typing import Any
from weakref import finalize

import pymunk
from pymunk import cp, ffi

from semnav_features.frames import FloatArray

WALL_FRICTION = 1.0
"""Friction of a wall; what counts is its product with that of the robot."""


def add_walls(space: pymunk.Space, segments: FloatArray) -> None:
    """Make segments solid, shape (n, 4): x1, y1, x2, y2 in metres.

    They behave as Pymunk's segments on the space's static body, to the last bit, but are not among
    `space.shapes`. Pymunk takes all of them for one and the same shape.
    """
    inner, body = space._space, space.static_body._body
    any_wall = ffi.new_handle(pymunk.Segment(space.static_body, (0.0, 0.0), (0.0, 0.0), 0.0))
    walls = []
    for x1, y1, x2, y2 in segments.tolist():
        wall = cp.cpSegmentShapeNew(body, (x1, y1), (x2, y2), 0.0)
        cp.cpShapeSetFriction(wall, WALL_FRICTION)
        cp.cpShapeSetUserData(wall, any_wall)
        cp.cpSpaceAddShape(inner, wall)
        walls.append(wall)
    finalize(space, _free, walls, inner, body, any_wall).atexit = False


def _free(walls: list[Any], inner: Any, *kept: Any) -> None:
    """Free the walls of a space that is gone; what they belong to is kept until this is done."""
    for wall in walls:
        cp.cpSpaceRemoveShape(inner, wall)
        cp.cpShapeFree(wall)
