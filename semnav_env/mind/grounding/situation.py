"""The situation in which a clause is grounded: scene, start of the clause, robot's progress."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from functools import cached_property

from semnav_env.language.references import Distance, DoorReference, Side, Unit
from semnav_env.language.told import Told, told
from semnav_env.mind.grounding.goal import PassGoal
from semnav_env.mind.grounding.goal_check import looks_along
from semnav_env.mind.grounding.search import Searching
from semnav_env.mind.grounding.ways import Way
from semnav_env.rules import Rules
from semnav_features.corridor import Corridor, corridor_at
from semnav_features.frames import Pose, compose
from semnav_features.scene import Door, Scene


@dataclass(frozen=True)
class Situation:
    """The scene and the poses on which a clause is grounded.

    Attributes:
        scene: remembered or true walls and doors.
        begin: pose at which the clause began, in the scene's frame.
        pose: pose that the robot has reached since then, in the scene's frame. Its heading is the
            robot's heading, or the direction in which it had to look if it has done so since then.
        complete: whether the scene is complete, so that no search is needed.
        after_corridor: whether the clause before was "go down the hallway".
        way: the told or driven way, for a clause that needs one.
        beside: the door to which, but not through which, the clause before led.
        entry: the goal of the clause that led through a door last; None if none did.
        lookouts: poses at which the robot has looked for the referent, in the order of time.
        back: whether `begin` is turned around, see `towards`.
        wall: the side along whose wall to keep; None for none.
        inside: whether the robot has gone into the room that the clause names.
        searched_from: pose at which the search of the room began in which the robot is; None if it
            has searched none.
        rules: distances and tolerances.
    """

    scene: Scene
    begin: Pose
    pose: Pose
    complete: bool = False
    after_corridor: bool = False
    way: Way | None = None
    beside: Door | None = None
    entry: PassGoal | None = None
    lookouts: tuple[Pose, ...] = ()
    back: bool = False
    wall: Side | None = None
    inside: bool = False
    searched_from: Pose | None = None
    rules: Rules = field(default=Rules(), repr=False)

    @cached_property
    def corridor(self) -> Corridor:
        """The corridor along which the robot faced when the clause began."""
        return corridor_at(self.scene, self.begin)

    @cached_property
    def progress(self) -> float:
        """Distance along the corridor that the robot has reached, metres."""
        return self.corridor.along((self.pose[0], self.pose[1]))

    @property
    def seen_to_end(self) -> bool:
        """Whether the corridor has been seen to its end."""
        if self.complete:
            return True
        looked = not self.back or self.looks_along(self.begin[2])
        end = self.corridor.end - self.rules.grounding.seen_end_distance
        return looked and self.progress > end

    @property
    def last_stop(self) -> float:
        """Largest distance along the corridor to which a robot drives, metres."""
        return self.corridor.end - self.rules.grounding.end_margin

    def towards(self, reference: object) -> Situation:
        """The situation of a robot that faces the referent, turned around if it is behind."""
        return replace(self, begin=turned(self.begin), back=True) if is_behind(reference) else self

    def looks_along(self, heading: float) -> bool:
        """Whether the robot has inspected a direction."""
        return looks_along(self.pose, heading, self.rules.grounding.inspection_angle)

    def metres(self, distance: Distance) -> float:
        """A distance in metres; that of `SOME` is a rule."""
        is_some = distance.unit is Unit.SOME
        return self.rules.grounding.some_distance if is_some else distance.metres

    def turn_to(self, heading: float, what: object) -> Searching:
        """A search by turning on the spot, where the clause began."""
        return Searching(told(what), (*self.begin[:2], heading), on_the_spot=True)

    def go_on(self, what: object, at_most: float = math.inf) -> Searching:
        """A search along the corridor; first the robot turns to where the referent may be.

        Args:
            what: the referent in words.
            at_most: largest distance along the corridor, metres.
        """
        if self.back and not self.looks_along(self.begin[2]):
            return self.turn_to(self.begin[2], what)
        along = min(self.progress + self.rules.grounding.look_ahead, min(self.last_stop, at_most))
        return Searching(told(what), self.corridor.place(along), self.corridor)

    def has_come(self, at_most: float) -> bool:
        """Whether the robot has reached the lookout point of `go_on`."""
        lookout = min(self.last_stop, at_most)
        return self.progress > lookout - self.rules.grounding.lookout_distance


def is_behind(reference: object) -> bool:
    """Whether a reference is to a door behind the robot."""
    return isinstance(reference, DoorReference) and reference.side is Side.BEHIND


def one_on_each_side(reference: DoorReference, sides: Iterable[Side]) -> Told:
    """What a robot tells where a reference fits doors on two sides."""
    first, second = sorted(sides)
    say = "turn around first, and say" if is_behind(reference) else "say"
    template = f"{{what}}: there is one {{first}} and {{second}} there; {say} on which side"
    return Told(template, what=reference, first=first, second=second)


def turned(pose: Pose) -> Pose:
    """The pose turned around on the spot."""
    return compose(pose, (0.0, 0.0, math.pi))
