"""A door seen from one of its two sides."""

from __future__ import annotations

import math
from dataclasses import dataclass

from semnav_features.frames import FloatArray, Point, Pose, points_to_parent, to_local
from semnav_features.scene import Door


@dataclass(frozen=True, slots=True)
class DoorSide:
    """A door, and the side from which it is approached.

    Attributes:
        right: the jamb to the right of a robot that faces the door, metres.
        left: the jamb to its left.

    Raises:
        ValueError: the jambs are the same point, or are not finite.
    """

    right: Point
    left: Point

    def __post_init__(self) -> None:
        if not all(map(math.isfinite, (*self.right, *self.left))):
            raise ValueError(f"the jambs of the door are {self.right} and {self.left}; give metres")
        if self.width < 1e-6:
            raise ValueError(f"the door at {self.right} has no width; its jambs must be two points")

    @staticmethod
    def seen_from(door: Door, place: Point) -> DoorSide:
        """The side of a door on which a place lies.

        Args:
            door: its two jambs.
            place: (x, y) in metres, in the frame of the door.
        """
        side = DoorSide(door.start, door.end)
        return side if side.distance_before(place) >= 0.0 else side.opposite

    @property
    def opposite(self) -> DoorSide:
        """The other side of the same door."""
        return DoorSide(self.left, self.right)

    @property
    def middle(self) -> Point:
        """Middle of the opening, metres."""
        return (self.right[0] + self.left[0]) / 2, (self.right[1] + self.left[1]) / 2

    @property
    def width(self) -> float:
        """Distance between the jambs, metres."""
        return math.dist(self.right, self.left)

    @property
    def through(self) -> float:
        """The heading straight through the door, away from this side, radians."""
        dx, dy = self.left[0] - self.right[0], self.left[1] - self.right[1]
        return math.atan2(-dx, dy)

    @property
    def frame(self) -> Pose:
        """The frame in the middle of the opening, with x through the door."""
        return *self.middle, self.through

    def distance_before(self, place: Point) -> float:
        """Distance of a place before the line of the door, metres; negative behind it."""
        return -to_local(self.frame, place)[0]

    def before(self, along: FloatArray) -> FloatArray:
        """Points given by (distance before the door, distance to the left), shape (n, 2)."""
        return points_to_parent(self.frame, along * (-1.0, 1.0))
