"""Which doors count, on which side and in which order; and the goals of door clauses."""

from __future__ import annotations

import math
from dataclasses import dataclass

from semnav_env.commands.clauses import LAST, Approach, DoorReference, GoToDoor, Side
from semnav_env.features.frames import Point, Pose, to_local, wrap_angle
from semnav_env.features.hallway import BEHIND, SPACING, Hallway
from semnav_env.features.scene import Door, Scene
from semnav_env.grounding.goal import Goal, GoalKind
from semnav_env.grounding.situation import GroundingError, Situation
from semnav_env.grounding.words import ordinal_word, where

STAND_OFF = 0.9
"""How far before a door, and behind it, the robot's centre comes to stand, metres."""

PASSED_BY = 0.8
"""A stretch of a side has been looked at when the robot is this far past its start, metres."""


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
    because = f"the {ordinal_word(clause.door.ordinal)} door{where(clause.door.side)}"
    if clause.approach is Approach.THROUGH:
        goal = Goal(GoalKind.PASS, found.pose(STAND_OFF), found.door, because=because)
    else:
        goal = Goal(GoalKind.REACH, found.pose(-STAND_OFF), found.door, 0.7, 0.6, because)
    return goal.within(situation.hallway)


def find_door(reference: DoorReference, situation: Situation) -> CountedDoor | Goal:
    """The door that a reference names, or the goal of looking for it.

    Raises:
        GroundingError: the hallway ended before.
    """
    doors = doors_along(situation.scene, situation.hallway, reference.side)
    name = f"{ordinal_word(reference.ordinal)} door{where(reference.side)}"
    if reference.ordinal == LAST:
        if not situation.seen_to_end:
            return situation.seek(f"looking for the {name}")
        found = doors[-1] if doors else None
    else:
        found = doors[reference.ordinal - 1] if len(doors) >= reference.ordinal else None
    if found is None and situation.seen_to_end:
        raise GroundingError(f"no {name}: the hallway ended after {len(doors)}")
    if found is None:
        return situation.seek(f"looking for the {name}")
    unseen = _first_unseen(situation, reference.side, found.along)
    if not situation.complete and situation.progress < unseen + PASSED_BY < math.inf:
        return situation.seek(f"looking for doors before the {name}", unseen + PASSED_BY)
    return found


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
    ahead = [
        door
        for door in counted
        if door is not None and door.along >= 0.0 and side in (None, door.side)
    ]
    return sorted(ahead, key=lambda door: door.along)


def _first_unseen(situation: Situation, side: Side | None, until: float) -> float:
    """Where the first stretch before `until` begins that may still hide a door."""
    sides = {Side.LEFT: (True,), Side.RIGHT: (False,), Side.AHEAD: ()}
    lefts = (True, False) if side is None else sides[side]
    return min((situation.hallway.unseen(left, 0.0, until) for left in lefts), default=math.inf)


def _counted(door: Door, hallway: Hallway) -> CountedDoor | None:
    start, end = to_local(hallway.frame, door.start), to_local(hallway.frame, door.end)
    dx, dy = end[0] - start[0], end[1] - start[1]
    along, offset = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    normal = math.atan2(dx, -dy)
    if abs(dx) >= abs(dy):
        if not _is_on_the_side(start, end, hallway):
            return None
        side = Side.LEFT if offset > 0 else Side.RIGHT
        towards = math.copysign(math.pi / 2, offset)
    else:
        if abs(along - hallway.end) > 0.6 or min(abs(start[1]), abs(end[1])) > 1.2:
            return None
        side, towards = Side.AHEAD, 0.0
    if math.cos(normal - towards) < 0:
        normal += math.pi
    return CountedDoor(door, along, side, wrap_angle(hallway.frame[2] + normal))


def _is_on_the_side(start: Point, end: Point, hallway: Hallway) -> bool:
    """Whether a ray from the axis to the side meets the door first, somewhere along it."""
    for share in (0.15, 0.5, 0.85):
        along = start[0] + share * (end[0] - start[0])
        offset = start[1] + share * (end[1] - start[1])
        side = hallway.left if offset > 0 else hallway.right
        probe = round((along + BEHIND) / SPACING)
        if 0 <= probe < len(side) and abs(side[probe] - abs(offset)) < 0.25:
            return True
    return False
