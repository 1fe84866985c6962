"""A floor plan in three dimensions, and its faces."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import FloatArray, Point

NO_JAMB = -1
"""In `RaisedPlan.jambs`: the face belongs to no jamb."""


class FaceKind(IntEnum):
    """The kind of thing to which a face belongs; it determines how well stereo cameras match it."""

    WALL = 0
    FRAME = 1
    LEAF = 2
    FURNITURE = 3
    FLOOR = 4
    PERSON = 5


@dataclass(frozen=True)
class PlanWindow:
    """A pane in a wall of a plan; depth cameras see through it.

    Attributes:
        start: one end, (x, y) in metres; on the wall.
        end: the other end.
        sill: height of the lower edge, metres.
        head: height of the upper edge, metres.
    """

    start: Point
    end: Point
    sill: float = 0.9
    head: float = 2.0


@dataclass(frozen=True)
class Closet:
    """A piece of furniture that has a height of its own.

    Attributes:
        corners: of its outline, (x, y) in metres, counter-clockwise.
        height: metres.
    """

    corners: tuple[Point, ...]
    height: float = 2.0


class RaisedFace(NamedTuple):
    """A rectangle in space.

    Attributes:
        corners: in order around it, world frame, metres, shape (4, 3).
        kind: what it belongs to.
        jamb: 2 i for the start of door i of the plan, 2 i + 1 for its end, or `NO_JAMB`.
    """

    corners: FloatArray
    kind: FaceKind
    jamb: int = NO_JAMB


@dataclass(frozen=True, eq=False)
class RaisedPlan:
    """A floor plan in three dimensions; floor and ceiling extend around the sensor.

    Attributes:
        plan: the floor plan.
        corners: of each face in order around it, world frame, metres, shape (n, 4, 3).
        kinds: `FaceKind` of each face, shape (n,).
        jambs: 2 i and 2 i + 1 for the jambs of door i of the plan, else `NO_JAMB`, shape (n,).
        ceiling: height, metres.
        lintel: height, metres.
    """

    plan: FloorPlan
    corners: FloatArray
    kinds: NDArray[np.int64]
    jambs: NDArray[np.int64]
    ceiling: float
    lintel: float

    @cached_property
    def circles(self) -> FloatArray:
        """Circles in the plane around the faces: x, y and radius, metres, shape (n, 3)."""
        ground = self.corners[..., :2]
        low, high = ground.min(axis=1), ground.max(axis=1)
        return np.column_stack((0.5 * (low + high), 0.5 * np.hypot(*(high - low).T)))
