"""A door seen from one of its two sides."""

from __future__ import annotations

import math
from dataclasses import dataclass

from semnav_features.frames import FloatArray, Point, Pose, middle_of, points_to_parent, to_local
from semnav_features.scene import Door

MIN_DOOR_WIDTH = 1e-6
"""Width below which the jambs of a door are the same point, metres."""


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
        if self.width < MIN_DOOR_WIDTH:
            raise ValueError(f"the door at {self.right} has no width; its jambs must be two points")

    @staticmethod
    def seen_from(door: Door, place: Point) -> DoorSide:
        """The side of a door on which a place lies.

        Args:
            door: its two jambs.
            place: (x, y) in metres, in the frame of the door.
        """
        return DoorSide(*jambs_from(door.start, door.end, place))

    @property
    def opposite(self) -> DoorSide:
        """The other side of the same door."""
        return DoorSide(self.left, self.right)

    @property
    def middle(self) -> Point:
        """Middle of the opening, metres."""
        return middle_of(self.right, self.left)

    @property
    def width(self) -> float:
        """Distance between the jambs, metres."""
        return math.dist(self.right, self.left)

    @property
    def through(self) -> float:
        """The heading straight through the door, away from this side, radians."""
        return self.frame[2]

    @property
    def frame(self) -> Pose:
        """The frame in the middle of the opening, with x through the door."""
        return doorway_frame(self.right, self.left)

    def distance_before(self, place: Point) -> float:
        """Distance of a place before the line of the door, metres; negative behind it."""
        return -to_local(self.frame, place)[0]

    def before(self, along: FloatArray) -> FloatArray:
        """Points given by (distance before the door, distance to the left), shape (n, 2)."""
        return points_to_parent(self.frame, along * (-1.0, 1.0))


def doorway_frame(right: Point, left: Point) -> Pose:
    """The frame in the middle between two jambs, with x through the door, see `DoorSide.frame`.

    Kernels call this function and the next one, too.
    """
    x, y = middle_of(right, left)
    return x, y, math.atan2(-(left[0] - right[0]), left[1] - right[1])


def jambs_from(start: Point, end: Point, place: Point) -> tuple[Point, Point]:
    """The right and the left jamb of a door for a robot at a place, metres."""
    if -to_local(doorway_frame(start, end), place)[0] >= 0.0:
        return start, end
    return end, start
