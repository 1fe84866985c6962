"""Which doors count, on which side and in which order; and the goals of door clauses."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from semnav_env.commands.clauses import Approach, GoToDoor
from semnav_env.commands.references import OTHER, DoorReference, Side
from semnav_env.features.frames import Point, Pose, compose, to_local, wrap_angle
from semnav_env.features.hallway import Hallway, doorway_at
from semnav_env.features.scene import Door, Scene
from semnav_env.grounding.goal import Goal, GoalKind
from semnav_env.grounding.situation import GroundingError, Situation
from semnav_env.grounding.surroundings import doors_around

STAND_OFF = 0.9
"""How far before a door, and behind it, the robot's centre comes to stand, metres."""

OUT_OF_DOORWAY = 1.0
"""How far a robot that stands in a doorway drives out of it before it turns, metres."""

ON_THE_SIDE = 0.25
"""So near to the side of a hallway a door lies on it, metres."""

AT_THE_END = 0.6
"""So near to the end of a hallway a door lies ahead, metres."""

ABREAST = 0.3
"""Doors so close along the hallway are not one before the other, metres."""


@dataclass(frozen=True, slots=True)
class CountedDoor:
    """A door of a hallway.

    Attributes:
        door: in the scene's frame.
        along: where its middle lies along the hallway's axis, metres.
        side: on which side of the axis, or ahead.
        outward: the heading that leads through it, away from the hallway, scene frame.
    """

    door: Door
    along: float
    side: Side
    outward: float

    def pose(self, beyond: float) -> Pose:
        """The pose on the door's axis `beyond` its line (negative: before it), facing outward."""
        x, y = self.door.midpoint
        c, s = math.cos(self.outward), math.sin(self.outward)
        return x + beyond * c, y + beyond * s, self.outward


def ground_door(clause: GoToDoor, situation: Situation) -> Goal:
    """The goal of "go through the second door on the right"."""
    found = find_door(clause.door, situation)
    if isinstance(found, Goal):
        return found
    if clause.approach is Approach.TO:
        goal = Goal(GoalKind.REACH, found.pose(-STAND_OFF), found.door, 0.7, 0.6)
    else:
        goal = Goal(GoalKind.PASS, found.pose(STAND_OFF), found.door, onward=found.pose(0.0))
    return replace(goal, because=str(clause.door), hallway=situation.hallway)


def ground_leave(situation: Situation) -> Goal:
    """The goal of "leave the room": back through the doorway that the robot has just come by.

    Who has not come by one leaves by the only door in view.

    Raises:
        GroundingError: there is none, or there are several.
    """
    inward = situation.begin
    door = doorway_at(situation.scene, inward)
    if door is None:  # it has turned around behind it
        inward = compose(situation.begin, (OUT_OF_DOORWAY, 0.0, math.pi))
        door = doorway_at(situation.scene, inward)
    if door is None:
        around = doors_around(situation.scene, situation.begin)
        if not around and not situation.complete:
            return _turn_round(situation)
        if len(around) != 1:
            raise GroundingError(
                "leave the room: by which door? say which, or enter the room first"
            )
        door = around[0]
        inward = (*door.midpoint, wrap_angle(_leading_away(door, situation.begin) + math.pi))
    outward = wrap_angle(inward[2] + math.pi)
    line = CountedDoor(door, 0.0, Side.BEHIND, outward)
    because = "leave the room"
    return Goal(GoalKind.PASS, line.pose(STAND_OFF), door, because=because, onward=line.pose(0.0))


def _turn_round(situation: Situation) -> Goal:
    """Turn round to look for the door of the room; never done, for it is no end in itself."""
    behind = compose(situation.begin, (0.0, 0.0, math.pi))
    because = "looking for the door of the room"
    return Goal(GoalKind.REACH, behind, None, 0.0, 0.0, because)


def _leading_away(door: Door, pose: Pose) -> float:
    """The heading through a door for one who comes from a pose."""
    (ax, ay), (bx, by) = door.start, door.end
    left = (bx - ax) * (pose[1] - ay) - (by - ay) * (pose[0] - ax) > 0.0
    return math.atan2(by - ay, bx - ax) + (-math.pi / 2 if left else math.pi / 2)


def find_door(reference: DoorReference, situation: Situation) -> CountedDoor | Goal:
    """The door that a reference names, or the goal of looking for it.

    Raises:
        GroundingError: the hallway ended before, or the side is open and doors on both fit.
    """
    check_side(reference)
    doors = doors_along(situation.scene, situation.hallway, reference.side)
    if reference.ordinal <= OTHER and not situation.seen_to_end:
        return situation.seek(reference)
    index = _index(reference, len(doors))
    if not 0 <= index < len(doors):
        if situation.seen_to_end:
            raise situation.missing(str(reference), len(doors))
        return situation.seek(reference)
    if situation.complete:
        _check_order(reference, doors, index)
    elif _may_hide_a_door(situation, reference.side, doors[index].along):
        return situation.seek(f"doors before {reference}", doors[index].along)
    return doors[index]


def check_side(reference: DoorReference) -> None:
    """Refuse a side on which no doors are found.

    Raises:
        GroundingError: it is one.
    """
    if reference.side in (Side.BEHIND, Side.OPPOSITE):
        raise GroundingError(
            f"{reference}: only doors to the left, to the right and ahead are found"
        )


def _index(reference: DoorReference, count: int) -> int:
    """Which of `count` doors in the order of travel is meant; negative or too high if none.

    Raises:
        GroundingError: "the other door", of several.
    """
    if reference.ordinal == OTHER:
        if count > 1:
            raise GroundingError(f"{reference}: there are {count}; say which")
        return 0
    return reference.ordinal - 1 if reference.ordinal > 0 else count + reference.ordinal


def doors_along(scene: Scene, hallway: Hallway, side: Side | None = None) -> list[CountedDoor]:
    """The doors that open onto a hallway ahead of its frame, in the order of travel.

    A door counts while at least half of its opening is still ahead. A door that runs with the
    hallway belongs to the side it lies on, if it is what one sees when looking there from the
    axis; one that runs across it and ends it lies ahead.

    Args:
        scene: the doors, in the frame of the hallway.
        hallway: whose frame stands where the counting begins.
        side: count only the doors there.
    """
    counted = [_counted(door, hallway) for door in scene.doors]
    ahead = [door for door in counted if door is not None and side in (None, door.side)]
    return sorted(ahead, key=lambda door: door.along)


def _check_order(reference: DoorReference, doors: list[CountedDoor], index: int) -> None:
    """Refuse to choose between doors that are not one before the other."""
    for other in doors[max(0, index - 1) : index + 2]:
        facing = abs(other.along - doors[index].along) < ABREAST
        if facing and other.side is not doors[index].side:
            sides = " and ".join(sorted((other.side, doors[index].side)))
            raise GroundingError(f"{reference}: there is one {sides} there; say on which side")


def _may_hide_a_door(situation: Situation, side: Side | None, until: float) -> bool:
    """Whether a stretch of the side ahead of the robot and before `until` is still unseen."""
    lefts = {Side.LEFT: (True,), Side.RIGHT: (False,), Side.AHEAD: (), None: (True, False)}
    start = max(0.0, situation.progress)
    return any(math.isfinite(situation.hallway.unseen(left, start, until)) for left in lefts[side])


def _counted(door: Door, hallway: Hallway) -> CountedDoor | None:
    start, end = to_local(hallway.frame, door.start), to_local(hallway.frame, door.end)
    dx, dy = end[0] - start[0], end[1] - start[1]
    along, offset = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    if along < 0.0:
        return None
    if abs(dx) < abs(dy):
        at_end = abs(along - hallway.end) <= AT_THE_END and abs(offset) <= hallway.half_width
        side, towards = Side.AHEAD if at_end else None, 0.0
    else:
        beside = Side.LEFT if offset > 0 else Side.RIGHT
        side = beside if _is_on_the_side(start, end, hallway) else None
        towards = math.copysign(math.pi / 2, offset)
    if side is None:
        return None
    normal = math.atan2(dx, -dy)
    if math.cos(normal - towards) < 0:
        normal += math.pi
    return CountedDoor(door, along, side, wrap_angle(hallway.frame[2] + normal))


def _is_on_the_side(start: Point, end: Point, hallway: Hallway) -> bool:
    """Whether a ray from the axis to the side meets the door first, somewhere along it."""
    for share in (0.15, 0.5, 0.85):
        along = start[0] + share * (end[0] - start[0])
        offset = start[1] + share * (end[1] - start[1])
        if abs(hallway.side_at(offset > 0, along) - abs(offset)) < ON_THE_SIDE:
            return True
    return False
