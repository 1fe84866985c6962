"""Where a clause leads: the interface between grounding and driving."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from enum import IntEnum

from numba import njit

from semnav_env.features.corridor import Corridor, Junction
from semnav_env.features.frames import FloatArray, Point, Pose, to_local, to_parent, wrap_angle
from semnav_env.features.scene import Door

PLACES_AHEAD = 2
"""A robot on a way that it knows heads for so many places farther on."""

BESIDE = 1.5
"""So far beside the end of such a way is still there, metres."""

STRAIGHT = 0.6
"""A way that turns by less leads straight on, radians."""


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
        corridor: the corridor in which the referent was found.
        junction: the junction at which to turn.
        onward: where the next clause begins; None for `pose`. The middle of the doorway that was
            crossed, or the mouth of the arm that was turned into.
        places: of the way there, from its begin on, if it is known; (x, y) in metres.
        wait: how long to stand still, seconds; of a STOP.
        beside: the door beside which it ends, of "until the second door".
    """

    kind: GoalKind
    pose: Pose
    door: Door | None = None
    distance_tolerance: float = math.inf
    heading_tolerance: float = math.pi
    because: str = ""
    corridor: Corridor | None = field(default=None, compare=False, repr=False)
    junction: Junction | None = field(default=None, compare=False, repr=False)
    onward: Pose | None = None
    places: tuple[Point, ...] = field(default=(), compare=False, repr=False)
    wait: float = 0.0
    beside: Door | None = field(default=None, compare=False, repr=False)

    def towards(self, pose: Pose) -> Goal:
        """The goal, or while the way there is long the next place on it."""
        if not self.places:
            return self
        apart = [math.dist(place, pose[:2]) for place in self.places]
        here = apart.index(min(apart))
        ahead = here + PLACES_AHEAD
        there = self._on_way(ahead)
        if ahead >= len(self.places) - 1:
            if self.kind is GoalKind.PASS:
                return self
            there = self.pose
        if abs(wrap_angle(self._on_way(here)[2] - there[2])) < STRAIGHT:
            there = _as_far_beside(there, to_local(self._on_way(here), pose[:2])[1])
        return replace(self, kind=GoalKind.SEEK, pose=there, door=None)

    def _on_way(self, index: int) -> Pose:
        """A place of the known way, or the one before the last, and the way's direction there."""
        index = min(index, len(self.places) - 2)
        (x, y), (bx, by) = self.places[index : index + 2]
        return x, y, math.atan2(by - y, bx - x)

    def reached_by(self, pose: Pose, share: float = 1.0) -> bool:
        """Whether `pose` lies within the tolerances, or within a `share` of them.

        At the end of a known way it is enough to be beside the goal: odometry may have drifted.
        """
        if self.places:
            along, beside = to_local(self.pose, pose[:2])
            return abs(along) <= share * self.distance_tolerance and abs(beside) <= BESIDE
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
            margin: how far beside the jambs still counts, and how far behind them the way must
                lead, metres; for a door that is not known exactly.
        """
        if self.door is None:
            return False
        (ax, ay), (bx, by) = self.door.start, self.door.end
        dx, dy = after[0] - before[0], after[1] - before[1]
        reach = abs(bx - ax) + abs(by - ay) + abs(dx) + abs(dy) + 2.0 * margin
        if abs(after[0] - ax) > reach or abs(after[1] - ay) > reach:
            return False  # too far away, as nearly always
        c, s = math.cos(self.pose[2]), math.sin(self.pose[2])
        line = ax + margin * c, ay + margin * s, bx + margin * c, by + margin * s
        share = _crossing(*line, *before[:2], *after[:2])
        forward = dx * c + dy * s > 0
        slack = margin / self.door.width
        return forward and -slack <= share <= 1 + slack


def _as_far_beside(there: Pose, beside: float) -> Pose:
    """The place beside one on a straight way, as far to its side as the robot is from it here.

    So a corridor is driven down where it is, however far odometry has drifted to a side.
    """
    x, y = to_parent(there, (0.0, beside if abs(beside) < BESIDE else 0.0))
    return x, y, there[2]


@njit(cache=True)
def first_crossed(doors: FloatArray, x1: float, y1: float, x2: float, y2: float) -> int:
    """The index of the first of `doors`, shape (n, 4), that a step crosses; -1 if none."""
    for i in range(len(doors)):
        share = _crossing(doors[i, 0], doors[i, 1], doors[i, 2], doors[i, 3], x1, y1, x2, y2)
        if 0.0 <= share <= 1.0:
            return i
    return -1


@njit(cache=True)
def _crossing(
    ax: float, ay: float, bx: float, by: float, x1: float, y1: float, x2: float, y2: float
) -> float:
    """Where the step from 1 to 2 crosses the line a-b, as a share of a-b; NaN if it does not."""
    dx, dy = bx - ax, by - ay
    before = dx * (y1 - ay) - dy * (x1 - ax)
    after = dx * (y2 - ay) - dy * (x2 - ax)
    if (before > 0.0) == (after > 0.0):
        return math.nan
    share = before / (before - after)
    x, y = x1 + share * (x2 - x1), y1 + share * (y2 - y1)
    return ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)
