"""Finds the referent of a reference in a situation: a door, a junction, or a pose to look from."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from semnav_env.language.clauses import Turning
from semnav_env.language.references import (
    ENTRY,
    OTHER,
    DoorReference,
    DoorRelation,
    Place,
    PlaceReference,
    RoomReference,
    Side,
)
from semnav_env.language.told import Told, told
from semnav_env.mind.grounding.counted_doors import CountedDoor, doors_along
from semnav_env.mind.grounding.door_geometry import heading_through
from semnav_env.mind.grounding.errors import GroundingError, UnclearError
from semnav_env.mind.grounding.junctions import junctions_ahead
from semnav_env.mind.grounding.search import Known, Searching
from semnav_env.mind.grounding.situation import Situation, one_on_each_side
from semnav_features.corridor import Junction

if TYPE_CHECKING:
    from semnav_env.mind.grounding.related_doors import HallSpan

MISSING = "no {what:bare}"
"""Beginning of what a robot tells of a referent that is not there."""


def find_door(reference: DoorReference, situation: Situation) -> Known[CountedDoor] | Searching:
    """Find the door that a reference names.

    Args:
        reference: a reference to a door.
        situation: of a robot that looks towards it, see `Situation.towards`.

    Raises:
        GroundingError: the corridor ended before such a door.
        UnclearError: the side is open and doors on both fit, or the robot has come through no door.
    """
    if reference.ordinal == ENTRY:
        from semnav_env.mind.grounding.behind import find_entry  # few commands need it

        return Known(find_entry(reference, situation))
    if reference.side is Side.OPPOSITE:
        return _find_opposite(reference, situation)
    if reference.relation is not None:
        return _find_related(reference, situation)
    doors, more = named_doors(reference, situation)
    if more and reference.ordinal <= OTHER and not situation.seen_to_end:
        return situation.go_on(reference)
    index = _index(reference, len(doors))
    if not 0 <= index < len(doors):
        if not more:
            raise GroundingError(
                Told(f"{MISSING}: there is {{count}}", what=reference, count=len(doors))
            )
        if situation.seen_to_end:
            raise _missing(told(reference), len(doors))
        return situation.go_on(reference)
    door = doors[index]
    if situation.complete:
        _check_order(reference, doors, index, situation)
    elif more and not (situation.back and situation.seen_to_end):
        side = None if situation.back else reference.side
        if _may_hide_a_door(situation, side, door.along):
            return situation.go_on(Told("doors before {what:dative}", what=reference), door.along)
    return Known(door)


def named_doors(
    reference: DoorReference, situation: Situation
) -> tuple[Sequence[CountedDoor], bool]:
    """The doors that a reference may name, in order, and whether there may be more farther along.

    Args:
        reference: to a door on any side but opposite.
        situation: of a robot that looks towards it.
    """
    if not situation.back:
        rules = situation.rules.grounding
        return doors_along(situation.scene, situation.corridor, reference.side, rules), True
    from semnav_env.mind.grounding.behind import doors_behind  # few commands need it

    return doors_behind(situation)


def find_junction(
    reference: PlaceReference | None, turning: Turning | None, situation: Situation
) -> Known[Junction] | Searching:
    """Find the junction that a reference names.

    Only junctions that open to the side of the turn count. Without a reference it is the next one
    of any kind. Whether a junction is a corner can depend on an opening that is hard to see.
    Therefore, at the end of a corridor without a junction of this kind, the robot takes another
    kind that leads to the same side.

    Raises:
        GroundingError: there is no such place.
    """
    place = None if reference is None else reference.place
    ordinal = 1 if reference is None else reference.ordinal
    corridor, rules = situation.corridor, situation.rules.grounding
    junctions = junctions_ahead(corridor, place, turning, rules)
    if not junctions and situation.seen_to_end and not situation.complete:
        junctions = junctions_ahead(corridor, None, turning, rules)
    counted = ordinal > 0 or situation.seen_to_end
    if counted and len(junctions) >= abs(ordinal):
        return Known(junctions[ordinal - 1 if ordinal > 0 else ordinal])
    name = junction_name(reference)
    if turning is not None:
        name = Told("{place} that leads {turning}", place=name, turning=turning)
    if situation.seen_to_end:
        raise _missing(name, len(junctions))
    return situation.go_on(name)


def junction_name(reference: PlaceReference | None) -> Told:
    """The words of a reference for a junction; without a reference it is the next junction."""
    return Told("the next junction") if reference is None else told(reference)


def _find_opposite(
    reference: DoorReference, situation: Situation
) -> Known[CountedDoor] | Searching:
    from semnav_env.mind.grounding import opposite  # few commands need it

    if reference.ordinal not in opposite.ORDINALS_OF_ONE:
        raise GroundingError(Told(f"{MISSING}: at most one is opposite", what=reference))
    found = opposite.doors_opposite(reference, situation)
    if isinstance(found, Searching):
        return found
    if len(found.value) > 1:
        raise UnclearError(one_on_each_side(reference, [view.side for view in found.value]))
    for view, door in found.value.items():
        outward = heading_through(door, view.pose[2])
        return Known(CountedDoor(door, 0.0, Side.OPPOSITE, outward))
    here = "this place" if opposite.view_from_door(situation) is None else "that door"
    raise GroundingError(Told(f"no door opposite: none faces {here}"))


def _find_related(reference: DoorReference, situation: Situation) -> Known[CountedDoor] | Searching:
    """Find a door beside or before something, once no nearer one can be hidden."""
    from semnav_env.mind.grounding import related_doors as related  # few commands need it

    if isinstance(reference.to, RoomReference):
        from semnav_env.mind.grounding.room_hallway import hallway_of

        hallway = hallway_of(reference, situation)
        if isinstance(hallway, Searching):
            return hallway
        situation = hallway
    span = _span_of(reference, situation)
    if isinstance(span, Searching):
        return span
    doors = related.related_doors(reference, span.value, situation)
    index = _index(reference, len(doors))
    found = doors[index] if 0 <= index < len(doors) else None
    start, until = related.decisive_stretch(reference, span.value, found, situation)
    side = related.counted_side(reference, span.value)
    if not situation.complete and _may_hide_a_door(situation, side, until, start):
        return situation.go_on(
            Told(f"doors {reference.relation} {{what:dative}}", what=reference.to), until
        )
    if found is None:
        there = "there are" if len(doors) != 1 else "there is"
        told_there = Told(f"{MISSING}: {there} {{count}}", what=reference, count=len(doors))
        raise GroundingError(told_there)
    if situation.complete and reference.relation is DoorRelation.AT:
        related.check_nearest(reference, span.value, doors, index, situation)
    elif situation.complete:
        _check_order(reference, doors, index, situation)
    return Known(found)


def _span_of(reference: DoorReference, situation: Situation) -> Known[HallSpan] | Searching:
    """Where that lies along the hallway to which a door has a relation."""
    from semnav_env.mind.grounding.related_doors import HallSpan  # few commands need it

    to, end = reference.to, situation.corridor.end
    if isinstance(to, RoomReference):
        from semnav_env.mind.grounding.room_hallway import room_span

        return Known(room_span(reference, situation))
    if isinstance(to, DoorReference):
        door = find_door(to, situation)
        if isinstance(door, Searching):
            return door
        counted = door.value
        side = None if counted.side is Side.AHEAD else counted.side
        return Known(HallSpan(counted.along, counted.along, counted.door, side))
    if to is not None and to.place is Place.END:
        return situation.go_on(to) if math.isinf(end) else Known(HallSpan(end, end))
    found = find_junction(to, None, situation)
    return found if isinstance(found, Searching) else Known(HallSpan.of_junction(found.value))


def _index(reference: DoorReference, count: int) -> int:
    """Index of the named door among `count` doors in the order of travel; out of range if none.

    Raises:
        UnclearError: "the other door", of several.
    """
    if reference.ordinal == OTHER:
        if count > 1:
            raise UnclearError(
                Told("{what}: there are {count}; say which", what=reference, count=count)
            )
        return 0
    return reference.ordinal - 1 if reference.ordinal > 0 else count + reference.ordinal


def _check_order(
    reference: DoorReference, doors: Sequence[CountedDoor], index: int, situation: Situation
) -> None:
    """Refuse to choose between doors without an order along the corridor."""
    chosen, rules = doors[index], situation.rules.grounding
    for other in doors[max(0, index - 1) : index + 2]:
        straight = other.side is Side.BEHIND and abs(other.off - chosen.off) < rules.behind_angle
        if other is not chosen and straight:
            raise UnclearError(
                Told("{what}: two there are equally nearly straight behind", what=reference)
            )
        abreast = abs(other.along - chosen.along) < rules.abreast_distance
        if abreast and other.side is not chosen.side:
            raise UnclearError(one_on_each_side(reference, (other.side, chosen.side)))


def _may_hide_a_door(
    situation: Situation, side: Side | None, until: float, after: float = 0.0
) -> bool:
    """Whether a part of the side between the robot, or `after`, and `until` is still unseen."""
    if situation.has_come(until):
        return False  # what cannot be seen from there, no looking will show
    start, corridor = max(after, 0.0, situation.progress), situation.corridor
    for left, own_side in ((True, Side.LEFT), (False, Side.RIGHT)):
        if side in (None, own_side) and math.isfinite(corridor.unseen(left, start, until)):
            return True
    return False


def _missing(what: Told, count: int) -> GroundingError:
    """The error for a missing referent: "no third door: the hallway ended after 2".

    Args:
        what: was looked for.
        count: how many of the kind there are.
    """
    there = "ended after {count}" if count else "has none"
    return GroundingError(Told(f"{MISSING}: the hallway {there}", what=what, count=count))
