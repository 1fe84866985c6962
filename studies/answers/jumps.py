"""What of a corridor jumps when a clause has another answer in another view of the plan."""

from __future__ import annotations

import math
from collections.abc import Iterator
from enum import StrEnum
from typing import NamedTuple

from semnav_env.mind.grounding.counted_doors import doors_along
from semnav_features.corridor import Corridor, corridor_at
from semnav_features.frames import Pose, to_local, wrap_angle
from semnav_features.scene import Door, StillScene

TURN, SHIFT = math.radians(2.5), 0.3
"""An axis is another one if it turns by more than this, or lies farther aside; and ends, widths,
edges of arms are others if they differ by more, radians and metres."""

AT_DOOR = 0.5
"""Distance along the corridor from the middle of a door within which an end or an arm is its,
metres."""


class Jump(StrEnum):
    """What is another one."""

    AXIS = "the direction of the axis"
    WAY = "the passage that the axis lies in, or its width"
    DOOR = "whether an opening is a door"
    END = "the end"
    ARM = "an arm"
    COUNT = "which doors the corridor counts"
    PLACE = "the place in the arm, or how far something is"


class View(NamedTuple):
    """A scene, and where a clause begins there."""

    scene: StillScene
    begin: Pose

    @property
    def corridor(self) -> Corridor:
        """The corridor there."""
        return corridor_at(self.scene, self.begin)


class Arm(NamedTuple):
    """An opening along the axis of one of two corridors, metres."""

    left: bool
    near: float
    far: float


def jumps(one: View, other: View) -> frozenset[Jump]:
    """What differs between two views of the corridor in which a clause begins."""
    here, there = one.corridor, other.corridor
    ahead, aside = to_local(here.frame, there.frame[:2])
    if abs(wrap_angle(here.frame[2] - there.frame[2])) > TURN:
        return frozenset((Jump.AXIS,))
    if max(abs(aside), abs(here.half_width - there.half_width)) > SHIFT:
        return frozenset((Jump.WAY,))
    ends = here.end, there.end + ahead
    until = min(ends)
    places = [*_unlike(_arms(here, 0.0, until), _arms(there, ahead, until))]
    found = {Jump.ARM} if places else set()
    if ends[0] != ends[1] and not abs(ends[0] - ends[1]) < SHIFT:
        found.add(Jump.END)
        places.append(until)
    if any(_is_at(place, door, here) for place in places for door in _in_one(one, other)):
        found = {Jump.DOOR}
    elif not found and _counted(one) != _counted(other):
        found = {Jump.DOOR if [*_in_one(one, other)] else Jump.COUNT}
    return frozenset(found or {Jump.PLACE})


def _arms(corridor: Corridor, ahead: float, until: float) -> list[Arm]:
    """The openings that begin before both corridors end, seen from the first one."""
    openings = [each for junction in corridor.junctions for each in junction.openings]
    arms = [Arm(each.left, each.near + ahead, min(each.far + ahead, until)) for each in openings]
    return [arm for arm in arms if arm.near < until - SHIFT]


def _unlike(arms: list[Arm], others: list[Arm]) -> Iterator[float]:
    """The middles of arms that only one of two corridors has."""
    for some, rest in ((arms, others), (others, arms)):
        for arm in some:
            if not any(_same(arm, each) for each in rest):
                yield (arm.near + arm.far) / 2


def _same(one: Arm, other: Arm) -> bool:
    differences = abs(one.near - other.near), abs(one.far - other.far)
    return one.left is other.left and max(differences) < SHIFT


def _in_one(one: View, other: View) -> Iterator[Door]:
    """The doors that count in one of two scenes only."""
    for scene, beside in ((one.scene, other.scene), (other.scene, one.scene)):
        names = {door.name for door in beside.doors}
        yield from (door for door in scene.doors if door.name not in names)


def _is_at(place: float, door: Door, corridor: Corridor) -> bool:
    along, aside = to_local(corridor.frame, door.midpoint)
    return abs(along - place) < AT_DOOR and abs(aside) < corridor.half_width + 2 * AT_DOOR


def _counted(view: View) -> list[str | None]:
    return [each.door.name for each in doors_along(view.scene, view.corridor)]
