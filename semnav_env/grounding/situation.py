"""What a clause is grounded on: a scene, where the clause began, and how far the robot is."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

from semnav_env.commands.references import DoorReference, Side
from semnav_env.features.corridor import Corridor, corridor_at
from semnav_env.features.frames import Pose, compose
from semnav_env.features.scene import Door, Scene
from semnav_env.grounding.goal import Goal, ReachGoal, SeekGoal
from semnav_env.grounding.ways import Way

LOOK_AHEAD = 4.0
"""How far ahead of the robot the goal of a search lies, metres."""

END_MARGIN = 1.0
"""How far before the end of a corridor the robot's centre stops, metres."""

THERE = 0.45
"""So near the place to look from a robot has come to it, metres."""

AT_END = END_MARGIN + THERE
"""Within this distance of its end a corridor has been seen to its end, metres."""

LOOKED_AT = math.radians(40.0)
"""Who is turned by less from a direction has looked there, radians."""


class GroundingError(ValueError):
    """The referent of a clause cannot be there; the message says what is."""


class UnclearError(GroundingError):
    """More must be said: several things fit a clause, or something else is meant by it."""


@dataclass(frozen=True)
class Situation:
    """What a clause is grounded on.

    Attributes:
        scene: remembered or true walls and doors.
        begin: where the clause began, in the scene's frame.
        pose: how far the robot has come since then, in the scene's frame; and which way it looks
            now, or has looked since then if that is where to look.
        complete: the scene holds everything there is.
        after_corridor: the clause before was "go down the hallway".
        way: that was pointed out or driven, for a clause that needs one.
        beside: the door that the clause before led to, and not through.
        back: `begin` is turned around, see `towards`.
    """

    scene: Scene
    begin: Pose
    pose: Pose
    complete: bool = False
    after_corridor: bool = False
    way: Way | None = None
    beside: Door | None = None
    back: bool = False

    @cached_property
    def corridor(self) -> Corridor:
        """The corridor that the robot looked along when the clause began."""
        return corridor_at(self.scene, self.begin)

    @cached_property
    def progress(self) -> float:
        """How far along the corridor the robot has come, metres."""
        return self.corridor.along((self.pose[0], self.pose[1]))

    @property
    def seen_to_end(self) -> bool:
        """Whether nothing of the corridor is left to be looked at."""
        looked = not self.back or self.looks_along(self.begin[2])
        return self.complete or (looked and self.progress > self.corridor.end - AT_END)

    def towards(self, reference: object) -> Situation:
        """The same for one who turns to what is spoken of: around, if that is behind."""
        return replace(self, begin=turned(self.begin), back=True) if is_behind(reference) else self

    def looks_along(self, heading: float) -> bool:
        """Whether the robot is turned that way by now."""
        return looks_along(self.pose, heading)

    def turn_to(self, heading: float, what: object) -> Goal:
        """Turn on the spot to look for something; never done, for it is no end in itself."""
        pose = (*self.begin[:2], heading)
        return ReachGoal(pose, 0.0, 0.0, f"looking for {what}")

    def seek(self, what: object, at_most: float = math.inf) -> Goal:
        """Go on along the corridor and keep looking for something; first turn to where it may be.

        Args:
            what: is being looked for.
            at_most: how far along the corridor to go, metres.
        """
        if self.back and not self.looks_along(self.begin[2]):
            return self.turn_to(self.begin[2], what)
        along = min(self.progress + LOOK_AHEAD, self._farthest(at_most))
        pose = self.corridor.place(along)
        return SeekGoal(pose, str(what), corridor=self.corridor)

    def has_come(self, at_most: float) -> bool:
        """Whether the robot has gone as far as `seek` would lead it."""
        return self.progress > self._farthest(at_most) - THERE

    def _farthest(self, at_most: float) -> float:
        return min(self.corridor.end - END_MARGIN, at_most)

    def missing(self, what: str, count: int) -> GroundingError:
        """The error for something that is not there: "no third door: the hallway ended after 2".

        Args:
            what: was looked for, beginning with "the".
            count: how many of the kind there are.
        """
        there = f"ended after {count}" if count else "has none"
        return GroundingError(f"no {what.removeprefix('the ')}: the hallway {there}")


def is_behind(reference: object) -> bool:
    """Whether a reference is to a door behind the robot."""
    return isinstance(reference, DoorReference) and reference.side is Side.BEHIND


def looks_along(pose: Pose, heading: float) -> bool:
    """Whether one is turned to a heading, more or less."""
    return math.cos(pose[2] - heading) > math.cos(LOOKED_AT)


def turned(pose: Pose) -> Pose:
    """The pose of one who has turned around."""
    return compose(pose, (0.0, 0.0, math.pi))
