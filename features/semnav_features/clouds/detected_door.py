"""The result of every detector of doors."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from semnav_features.elements import Door
from semnav_features.frames import FloatArray, Point, Pose, to_local, wrap_angle


@dataclass(frozen=True, slots=True, eq=False)
class DetectedDoor:
    """A door that was found where one was expected.

    Attributes:
        start: jamb that belongs to the expected door's start, (x, y) in metres, robot frame; in
            the middle of the wall, at the edge of the opening.
        end: the other jamb.
        confidence: how likely both are jambs of the expected door, 0 to 1.
        covariance: of (start x, start y, end x, end y), square metres, shape (4, 4). It includes
            the common error of both jambs: an error of the line through both moves both.
        start_seen: whether the start was found; if not, it was placed by the width of the
            expected door.
        end_seen: whether the end was found; one of the two always was.
    """

    start: Point
    end: Point
    confidence: float = 1.0
    covariance: FloatArray = field(default_factory=lambda: np.zeros((4, 4)))
    start_seen: bool = True
    end_seen: bool = True

    @property
    def midpoint(self) -> Point:
        """Middle of the opening, robot frame, metres."""
        return self.as_door().midpoint

    @property
    def width(self) -> float:
        """Distance between the jambs, metres."""
        return math.dist(self.start, self.end)

    @property
    def is_whole(self) -> bool:
        """Whether both jambs were found."""
        return self.start_seen and self.end_seen

    def as_door(self) -> Door:
        """The door of a scene, robot frame."""
        return Door(self.start, self.end, confidence=self.confidence)


def expect_door(door_world: Door, pose: Pose, pose_covariance: FloatArray) -> tuple[Door, float]:
    """The expected door and its standard deviation, as the detectors need them.

    Args:
        door_world: of the floor plan; anything with `start` and `end`.
        pose: believed pose, the same frame.
        pose_covariance: of x, y (square metres) and heading, shape (3, 3).

    Returns:
        The door in the robot frame, and the standard deviation of its jambs, metres: the larger
        one of the two jambs, along the axis in which it is largest.
    """
    spread = [_spread(pose, jamb, pose_covariance) for jamb in (door_world.start, door_world.end)]
    return Door(to_local(pose, door_world.start), to_local(pose, door_world.end)), max(spread)


def _spread(pose: Pose, jamb: Point, covariance: FloatArray) -> float:
    """Largest standard deviation of a jamb that a pose error displaces, metres.

    A turn by d moves a jamb at (dx, dy) from the robot by d (-dy, dx).
    """
    dx, dy = jamb[0] - pose[0], jamb[1] - pose[1]
    jacobian = np.array([[1.0, 0.0, -dy], [0.0, 1.0, dx]])
    return math.sqrt(float(np.linalg.eigvalsh(jacobian @ covariance @ jacobian.T)[-1]))


def frame_of(door: Door) -> Pose:
    """The frame of a door: origin in the middle, x from start to end.

    Raises:
        ValueError: jambs that are not finite, or in one place.
    """
    (x1, y1), (x2, y2) = door.start, door.end
    if not all(map(math.isfinite, (x1, y1, x2, y2))) or door.width <= 0.0:
        raise ValueError(
            f"the expected door {door.start} to {door.end} has no finite, wide opening"
        )
    return (*door.midpoint, wrap_angle(math.atan2(y2 - y1, x2 - x1)))
