"""Which doors count, on which side and in which order."""

from __future__ import annotations

import math
from dataclasses import dataclass

from semnav_env.commands.references import OTHER, DoorReference, Side
from semnav_env.features.corridor import Corridor
from semnav_env.features.frames import Point, Pose, to_local, wrap_angle
from semnav_env.features.scene import Door, Scene
from semnav_env.grounding.goal import Goal
from semnav_env.grounding.opposite import find_opposite
from semnav_env.grounding.situation import (
    GroundingError,
    Situation,
    UnclearError,
    is_behind,
    turned,
)
from semnav_env.grounding.surroundings import (
    bearing,
    doors_around,
    heading_between,
    heading_through,
    own_doorway,
)

STAND_OFF = 0.9
"""How far before a door, and behind it, the robot's centre comes to stand, metres."""

OUT_OF_DOORWAY = 1.0
"""How far a robot that stands in a doorway drives out of it before it turns, metres."""

ON_THE_SIDE = 0.25
"""So near to the side of a corridor a door lies on it, metres."""

AT_THE_END = 0.6
"""So near to the end of a corridor a door lies ahead, metres."""

ABREAST = 0.3
"""Doors so close along the corridor are not one before the other, metres."""

AS_STRAIGHT = math.radians(6.0)
"""Doors whose directions differ by less are as straight behind one as the other."""

CORRIDOR = 3.0
"""No corridor is wider, metres; what is wider has a wall behind one, as a room has."""


@dataclass(frozen=True, slots=True)
class CountedDoor:
    """A door of a corridor.

    Attributes:
        door: in the scene's frame.
        along: where its middle lies along the corridor's axis, metres.
        side: on which side of the axis, or ahead.
        outward: the heading that leads through it, away from the corridor, scene frame.
        off: how far it lies off straight behind, radians; only of doors that are ordered by it.
    """

    door: Door
    along: float
    side: Side
    outward: float
    off: float = 0.0

    def pose(self, beyond: float) -> Pose:
        """The pose on the door's axis `beyond` its line (negative: before it), facing outward."""
        x, y = self.door.midpoint
        c, s = math.cos(self.outward), math.sin(self.outward)
        return x + beyond * c, y + beyond * s, self.outward


def find_door(reference: DoorReference, situation: Situation) -> CountedDoor | Goal:
    """The door that a reference names, or the goal of looking for it.

    Args:
        reference: to a door.
        situation: of one who looks towards it, see `Situation.towards`.

    Raises:
        GroundingError: the corridor ended before.
        UnclearError: the side is open and doors on both fit.
    """
    if reference.side is Side.OPPOSITE:
        found = find_opposite(reference, situation)
        if not isinstance(found, tuple):
            return found
        door, outward = found
        return CountedDoor(door, 0.0, Side.OPPOSITE, outward)
    doors, counted_on = doors_named(reference, situation)
    if counted_on and reference.ordinal <= OTHER and not situation.seen_to_end:
        return situation.seek(reference)
    index = _index(reference, len(doors))
    if not 0 <= index < len(doors):
        if not counted_on:
            raise GroundingError(f"no {str(reference).removeprefix('the ')}: there is {len(doors)}")
        if situation.seen_to_end:
            raise situation.missing(str(reference), len(doors))
        return situation.seek(reference)
    side = None if situation.back else reference.side
    if situation.complete:
        _check_order(reference, doors, index)
    elif situation.back and situation.seen_to_end:
        return doors[index]
    elif counted_on and _may_hide_a_door(situation, side, doors[index].along):
        return situation.seek(f"doors before {reference}", doors[index].along)
    return doors[index]


def doors_named(reference: DoorReference, situation: Situation) -> tuple[list[CountedDoor], bool]:
    """The doors that a reference may name, in order, and whether there may be more farther on.

    Behind one who stands in a doorway is only that door. In a room, where it is wider than
    `CORRIDOR`, those in view are that lie more behind than beside, the one most nearly straight
    behind first; elsewhere those that one would come by on turning around, if there are any.

    Args:
        reference: to a door on any side but opposite.
        situation: of one who looks towards it.
    """
    if not situation.back:
        return doors_along(situation.scene, situation.corridor, reference.side), True
    scene, begin, corridor = situation.scene, situation.begin, situation.corridor
    doorway = own_doorway(scene, turned(begin))
    if doorway is not None:
        outward = heading_through(doorway, begin[2])
        return [CountedDoor(doorway, 0.0, Side.BEHIND, outward)], False
    if corridor.half_width <= CORRIDOR / 2:
        doors = doors_along(scene, corridor)
        if doors or not situation.seen_to_end:
            return doors, True
    elif not situation.complete and not situation.looks_along(begin[2]):
        return [], True
    straight = _straight_behind(scene, (*begin[:2], corridor.frame[2]))
    return straight, not straight


def _straight_behind(scene: Scene, pose: Pose) -> list[CountedDoor]:
    """The doors around that lie more ahead of a pose, which is turned around, than beside it.

    What they are ordered by is no way along a corridor but how far they are off straight ahead.
    """
    seen = ((bearing(pose, door), door) for door in doors_around(scene, pose))
    return [
        CountedDoor(door, ahead, Side.BEHIND, heading_through(door, heading), off)
        for off, door in sorted(seen, key=lambda each: each[0])
        if off < math.pi / 4
        for heading in [heading_between(pose[:2], door.midpoint)]
        for ahead in [to_local(pose, door.midpoint)[0]]
    ]


def _index(reference: DoorReference, count: int) -> int:
    """Which of `count` doors in the order of travel is meant; negative or too high if none.

    Raises:
        UnclearError: "the other door", of several.
    """
    if reference.ordinal == OTHER:
        if count > 1:
            raise UnclearError(f"{reference}: there are {count}; say which")
        return 0
    return reference.ordinal - 1 if reference.ordinal > 0 else count + reference.ordinal


def doors_along(scene: Scene, corridor: Corridor, side: Side | None = None) -> list[CountedDoor]:
    """The doors that open onto a corridor ahead of its frame, in the order of travel.

    A door counts while at least half of its opening is still ahead. A door that runs with the
    corridor belongs to the side it lies on, if it is what one sees when looking there from the
    axis; one that runs across it and ends it lies ahead.

    Args:
        scene: the doors, in the frame of the corridor.
        corridor: whose frame stands where the counting begins.
        side: count only the doors there.
    """
    counted = [_counted(door, corridor) for door in scene.doors]
    ahead = [door for door in counted if door is not None and side in (None, door.side)]
    return sorted(ahead, key=lambda door: door.along)


def _check_order(reference: DoorReference, doors: list[CountedDoor], index: int) -> None:
    """Refuse to choose between doors that are not one before the other."""
    chosen = doors[index]
    for other in doors[max(0, index - 1) : index + 2]:
        straight = other.side is Side.BEHIND and abs(other.off - chosen.off) < AS_STRAIGHT
        if other is not chosen and straight:
            raise UnclearError(f"{reference}: two there are equally nearly straight behind")
        if abs(other.along - chosen.along) < ABREAST and other.side is not chosen.side:
            sides = " and ".join(sorted((other.side, chosen.side)))
            say = "turn around first, and say" if is_behind(reference) else "say"
            raise UnclearError(f"{reference}: there is one {sides} there; {say} on which side")


def _may_hide_a_door(situation: Situation, side: Side | None, until: float) -> bool:
    """Whether a stretch of the side ahead of the robot and before `until` is still unseen."""
    if situation.has_come(until):
        return False  # what cannot be seen from there, no looking will show
    lefts = {Side.LEFT: (True,), Side.RIGHT: (False,), Side.AHEAD: (), None: (True, False)}
    start = max(0.0, situation.progress)
    return any(math.isfinite(situation.corridor.unseen(left, start, until)) for left in lefts[side])


def _counted(door: Door, corridor: Corridor) -> CountedDoor | None:
    start, end = to_local(corridor.frame, door.start), to_local(corridor.frame, door.end)
    dx, dy = end[0] - start[0], end[1] - start[1]
    along, offset = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    if along < 0.0:
        return None
    if abs(dx) < abs(dy):
        at_end = abs(along - corridor.end) <= AT_THE_END and abs(offset) <= corridor.half_width
        side, towards = Side.AHEAD if at_end else None, 0.0
    else:
        beside = Side.LEFT if offset > 0 else Side.RIGHT
        side = beside if _is_on_the_side(start, end, corridor) else None
        towards = math.copysign(math.pi / 2, offset)
    if side is None:
        return None
    normal = math.atan2(dx, -dy)
    if math.cos(normal - towards) < 0:
        normal += math.pi
    return CountedDoor(door, along, side, wrap_angle(corridor.frame[2] + normal))


def _is_on_the_side(start: Point, end: Point, corridor: Corridor) -> bool:
    """Whether a ray from the axis to the side meets the door first, somewhere along it."""
    for share in (0.15, 0.5, 0.85):
        along = start[0] + share * (end[0] - start[0])
        offset = start[1] + share * (end[1] - start[1])
        if abs(corridor.side_at(offset > 0, along) - abs(offset)) < ON_THE_SIDE:
            return True
    return False
