"""Doors that are picked out by something else in the hallway: beside it, or before it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from semnav_env.language.references import DoorReference, DoorRelation, Side
from semnav_env.language.told import Told
from semnav_env.mind.grounding.counted_doors import CountedDoor, doors_along
from semnav_env.mind.grounding.errors import UnclearError
from semnav_env.mind.grounding.situation import Situation, one_on_each_side
from semnav_features.corridor import Junction
from semnav_features.scene import Door


class HallSpan(NamedTuple):
    """The part of a hallway that something takes up.

    Attributes:
        near: where it begins along the axis, metres.
        far: where it ends, metres.
        door: the door that it is, or that leads to it; None if it is no door.
        side: on which side that door is; None for a door across the hallway's end.
    """

    near: float
    far: float
    door: Door | None = None
    side: Side | None = None

    @staticmethod
    def of_junction(junction: Junction) -> HallSpan:
        """From the first edge of its openings to the last one."""
        return HallSpan(min(opening.near for opening in junction.openings), junction.far)

    def distance(self, door: CountedDoor) -> float:
        """Distance of the middle of a door along the hallway, metres; 0 within the span."""
        return max(self.near - door.along, door.along - self.far, 0.0)


def counted_side(reference: DoorReference, span: HallSpan) -> Side | None:
    """The side on which doors are counted: beside a door is on its side, if none is said."""
    is_beside = reference.relation is DoorRelation.AT
    return reference.side or (span.side if is_beside else None)


def related_doors(
    reference: DoorReference, span: HallSpan, situation: Situation
) -> Sequence[CountedDoor]:
    """The doors that a reference may name, in the order in which it counts them.

    Args:
        reference: to a door beside or before something.
        span: where that is.
        situation: of a robot in that hallway.
    """
    rules, side = situation.rules.grounding, counted_side(reference, span)
    doors = [
        door
        for door in doors_along(situation.scene, situation.corridor, side, rules)
        if door.door != span.door
    ]
    if reference.relation is DoorRelation.BEFORE:
        return [door for door in doors if door.along < span.near]
    near = [door for door in doors if span.distance(door) <= rules.beside_distance]
    return sorted(near, key=span.distance)


def decisive_stretch(
    reference: DoorReference, span: HallSpan, found: CountedDoor | None, situation: Situation
) -> tuple[float, float]:
    """From where to where a door may hide that would be counted before the found one, metres."""
    if reference.relation is DoorRelation.BEFORE:
        counted_on = found is not None and reference.ordinal > 0
        return 0.0, found.along if found is not None and counted_on else span.near
    reach = situation.rules.grounding.beside_distance if found is None else span.distance(found)
    return span.near - reach, span.far + reach


def check_nearest(
    reference: DoorReference,
    span: HallSpan,
    doors: Sequence[CountedDoor],
    index: int,
    situation: Situation,
) -> None:
    """Refuse to choose between doors that are equally near.

    Raises:
        UnclearError: says what would tell them apart.
    """
    chosen, least = doors[index], situation.rules.grounding.abreast_distance
    for other in doors[max(0, index - 1) : index + 2]:
        apart = abs(span.distance(other) - span.distance(chosen))
        if other is chosen or apart >= least:
            continue
        if other.side is not chosen.side:
            raise UnclearError(one_on_each_side(reference, (other.side, chosen.side)))
        raise UnclearError(
            Told("{what}: there are two, equally near; say before it or after it", what=reference)
        )
