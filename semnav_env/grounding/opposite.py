"""Which door is the one opposite: the one that faces a door, or the robot."""

from __future__ import annotations

import math
from dataclasses import dataclass

from semnav_env.commands.references import LAST, OTHER, DoorReference, Side
from semnav_env.features.frames import Pose, compose, to_local
from semnav_env.features.kernels.probing import BODY_WIDTH
from semnav_env.features.scene import Door
from semnav_env.grounding.goal import Goal, SeekGoal
from semnav_env.grounding.situation import GroundingError, Situation, UnclearError
from semnav_env.grounding.surroundings import (
    doors_across,
    heading_between,
    heading_through,
    own_doorway,
    shared_width,
)

FROM_DOOR, FROM_ROBOT = 8.0, 5.0
"""Farther across than this no door is opposite a door, or opposite the robot, metres."""

STEPPED_OUT = 0.5
"""Who has come so far out of a doorway has seen what is opposite it, metres ..."""

STEP_OUT = 1.0
"""... so one looks from here."""

OF_ONE = (1, LAST, OTHER)
"""The ordinals that a single door can have."""

ROUND_ABOUT = {Side.AHEAD: 0.0, Side.LEFT: math.pi / 2, Side.RIGHT: -math.pi / 2}


@dataclass(frozen=True, slots=True)
class Look:
    """Where one looks straight across.

    Attributes:
        pose: from where and which way, in the scene's frame.
        side: on which side that is.
        door: from whose middle; None for the robot's own place.
    """

    pose: Pose
    side: Side
    door: Door | None = None

    @property
    def half_width(self) -> float:
        """Half of the width that is faced, metres."""
        return (BODY_WIDTH if self.door is None else self.door.width) / 2

    def faced(self, situation: Situation) -> Door | None:
        """The door that shares the most of this width; None if none does."""
        most = FROM_ROBOT if self.door is None else FROM_DOOR
        shares = {
            door: shared_width(door, self.pose, self.half_width)
            for door in doors_across(situation.scene, self.pose, self.door)
            if to_local(self.pose, door.midpoint)[0] <= most
        }
        best = max(shares, key=shares.__getitem__, default=None)
        return best if best is not None and shares[best] > 0.0 else None

    def is_done(self, situation: Situation) -> bool:
        """Whether there is nothing left to look at there."""
        if self.door is None:
            return self._is_looked_at(situation)
        out = to_local(self.pose, situation.pose[:2])[0]
        return out > STEPPED_OUT and situation.looks_along(self.pose[2])

    def _is_looked_at(self, situation: Situation) -> bool:
        """Whether a robot has seen what is on this side, for it looks ahead and sees walls aside.

        It turns to a gap on one side; gaps on both are a crossing.
        """
        if self.side is Side.AHEAD:
            return bool(situation.scene.walls)
        left = self.side is Side.LEFT
        one_gap = self._is_gap(situation, left) and not self._is_gap(situation, not left)
        return not one_gap or situation.looks_along(self.pose[2])

    def _is_gap(self, situation: Situation, left: bool) -> bool:
        """Whether some of a side, as wide as is faced, is no wall or not seen."""
        here = situation.corridor.along(self.pose[:2])
        width = (here - self.half_width, here, here + self.half_width)
        return any(math.isinf(situation.corridor.side_at(left, along)) for along in width)

    def goal(self, situation: Situation, what: object) -> Goal:
        """Turn there; or come out of the doorway to look."""
        if not situation.scene.walls:
            return SeekGoal(situation.begin, str(what))
        if not situation.looks_along(self.pose[2]):
            return situation.turn_to(self.pose[2], what)
        out = compose(self.pose, (STEP_OUT, 0.0, 0.0))
        return SeekGoal(out, str(what))


def find_opposite(reference: DoorReference, situation: Situation) -> tuple[Door, float] | Goal:
    """The door opposite and the heading through it, or the goal of looking for it.

    Raises:
        GroundingError: there is none.
        UnclearError: there are several.
    """
    if reference.ordinal not in OF_ONE:
        raise GroundingError(f"no {str(reference).removeprefix('the ')}: at most one is opposite")
    found = doors_opposite(reference, situation)
    if not isinstance(found, dict):
        return found
    if len(found) > 1:
        sides = " and ".join(sorted(look.side for look in found))
        raise UnclearError(f"{reference}: there is one {sides} there; say on which side")
    for look, door in found.items():
        return door, heading_through(door, look.pose[2])
    here = "this place" if _look(situation) is None else "that door"
    raise GroundingError(f"no door opposite: none faces {here}")


def doors_opposite(reference: DoorReference, situation: Situation) -> dict[Look, Door] | Goal:
    """The doors opposite, by the looks that meet them; or the goal of looking for them.

    Who was sent to a door, or past it, looks across from that door; who stands in a doorway looks
    on through it. Anyone else looks ahead and to both sides.
    """
    look = _look(situation)
    looks = _looks_round(situation) if look is None else [look]
    found = {each: door for each in looks if (door := each.faced(situation)) is not None}
    missing = [each for each in looks if not each.is_done(situation)]
    if found or situation.complete or not missing:
        return found
    return missing[0].goal(situation, reference)


def _look(situation: Situation) -> Look | None:
    """The look across from a door."""
    begin, door = situation.begin, situation.beside
    about = begin[2]
    if door is not None:
        about = heading_between(door.midpoint, begin[:2])
    else:
        door = own_doorway(situation.scene, begin)
    if door is None:
        return None
    return Look((*door.midpoint, heading_through(door, about)), Side.OPPOSITE, door)


def _looks_round(situation: Situation) -> list[Look]:
    axis = (*situation.begin[:2], situation.corridor.frame[2])
    return [Look(compose(axis, (0.0, 0.0, turn)), side) for side, turn in ROUND_ABOUT.items()]
