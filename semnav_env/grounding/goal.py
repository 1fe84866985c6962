"""Where a clause leads: the interface between grounding and driving."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from enum import IntEnum

from semnav_env.features.frames import Pose, wrap_angle
from semnav_env.features.hallway import Hallway, Junction
from semnav_env.features.scene import Door


class GoalKind(IntEnum):
    """What reaching a goal means.

    SEEK: the referent has not been seen yet; drive towards `pose` and keep looking.
    REACH: be at `pose`, within the tolerances.
    PASS: cross `door`; `pose` lies behind it, heading away from it.
    STOP: stand still.
    """

    SEEK = 0
    REACH = 1
    PASS = 2
    STOP = 3


@dataclass(frozen=True, slots=True)
class Goal:
    """A place to be, in the frame of the scene it was grounded on.

    Attributes:
        kind: what reaching it means.
        pose: where the robot's centre should come to be, (x, y, heading).
        door: the doorway to cross or to stand before; its `name` only on a true scene.
        distance_tolerance: how far from `pose` still counts as there, metres.
        heading_tolerance: how far off its heading, radians; pi where the heading is free.
        because: what was understood, for the picture and the log.
        hallway: the hallway in which the referent was found.
        junction: the junction at which to turn.
    """

    kind: GoalKind
    pose: Pose
    door: Door | None = None
    distance_tolerance: float = math.inf
    heading_tolerance: float = math.pi
    because: str = ""
    hallway: Hallway | None = field(default=None, compare=False, repr=False)
    junction: Junction | None = field(default=None, compare=False, repr=False)

    def reached_by(self, pose: Pose, share: float = 1.0) -> bool:
        """Whether `pose` lies within the tolerances, or within a `share` of them."""
        distance = math.hypot(pose[0] - self.pose[0], pose[1] - self.pose[1])
        turn = abs(wrap_angle(pose[2] - self.pose[2]))
        return distance <= share * self.distance_tolerance and (
            self.heading_tolerance >= math.pi or turn <= share * self.heading_tolerance
        )

    def crossed_between(self, before: Pose, after: Pose, margin: float = 0.0) -> bool:
        """Whether the way from `before` to `after` leads forward through the goal's door.

        Args:
            before: a pose of the robot's centre.
            after: the next one.
            margin: how far beside the jambs still counts, metres.
        """
        if self.door is None:
            return False
        outward = math.cos(self.pose[2]), math.sin(self.pose[2])
        share = crossing(self.door, before, after)
        forward = (after[0] - before[0]) * outward[0] + (after[1] - before[1]) * outward[1] > 0
        slack = margin / self.door.width
        return share is not None and forward and -slack <= share <= 1 + slack

    def within(self, hallway: Hallway, junction: Junction | None = None) -> Goal:
        """The same goal, with the hallway and the junction it was found in."""
        return replace(self, hallway=hallway, junction=junction)


def crossing(door: Door, before: Pose, after: Pose) -> float | None:
    """Where the straight way between two poses crosses the line through a door's jambs.

    Returns:
        0 at the start jamb, 1 at the end jamb, less or more beside them; None if the way does
        not cross the line.
    """
    (x1, y1), (x2, y2) = door.start, door.end
    dx, dy = x2 - x1, y2 - y1
    side_before = dx * (before[1] - y1) - dy * (before[0] - x1)
    side_after = dx * (after[1] - y1) - dy * (after[0] - x1)
    if (side_before > 0) == (side_after > 0):
        return None
    share = side_before / (side_before - side_after)
    x = before[0] + share * (after[0] - before[0])
    y = before[1] + share * (after[1] - before[1])
    return ((x - x1) * dx + (y - y1) * dy) / (dx * dx + dy * dy)
