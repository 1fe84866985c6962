"""Decides whether a condition is met."""

from __future__ import annotations

from semnav_env.language.clauses import IfThere
from semnav_env.language.references import OTHER, DoorReference, Place, PlaceReference, Side
from semnav_env.mind.grounding.errors import GroundingError, UnclearError
from semnav_env.mind.grounding.find import find_door, named_doors
from semnav_env.mind.grounding.junctions import junctions_ahead
from semnav_env.mind.grounding.opposite import ORDINALS_OF_ONE, doors_opposite
from semnav_env.mind.grounding.search import Known, Searching
from semnav_env.mind.grounding.situation import Situation


def is_met(condition: IfThere, situation: Situation) -> Known[bool] | Searching:
    """Whether a condition is met, as far as this is known.

    That something is there is known as soon as it is seen. That nothing is there is known at the
    end of the corridor, or where there can be no more.
    """
    situation = situation.towards(condition.what)
    if isinstance(condition.what, DoorReference) and condition.what.side is Side.OPPOSITE:
        found = doors_opposite(condition.what, situation)
        if isinstance(found, Searching):
            return found
        there = bool(found.value) and condition.what.ordinal in ORDINALS_OF_ONE
        return Known(there is not condition.absent)
    if isinstance(condition.what, DoorReference) and condition.what.relation is not None:
        is_there = _is_related_there(condition.what, situation)
        if isinstance(is_there, Searching):
            return is_there
        return Known(is_there is not condition.absent)
    (count, more), wanted = _count(condition.what, situation), condition.what.ordinal
    from_start, all_known = wanted > OTHER, situation.seen_to_end or not more
    if (from_start or all_known) and count >= max(1, abs(wanted)):
        there = wanted != OTHER or count == 1
    elif all_known:
        there = False
    else:
        return situation.go_on(condition.what)
    return Known(there is not condition.absent)


def _is_related_there(what: DoorReference, situation: Situation) -> bool | Searching:
    """Whether a door beside or before something is there; of two that are equally near, one is."""
    try:
        found = find_door(what, situation)
    except UnclearError:
        return True
    except GroundingError:
        return False
    return found if isinstance(found, Searching) else True


def _count(what: DoorReference | PlaceReference, situation: Situation) -> tuple[int, bool]:
    """Number of things of this kind seen so far, and whether there may be more farther along."""
    if isinstance(what, DoorReference):
        doors, more = named_doors(what, situation)
        return len(doors), more
    if what.place is Place.END:
        return int(situation.seen_to_end), True
    rules = situation.rules.grounding
    return len(junctions_ahead(situation.corridor, what.place, rules=rules)), True
