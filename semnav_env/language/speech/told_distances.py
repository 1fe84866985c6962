"""Reads amounts, and distances backwards or from a place; finds those that no command can say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby, pairwise

from semnav_env.language.references import SOME, Distance, PlaceOffset, Relation
from semnav_env.language.speech.items import JOINTS, Item, ItemKind, Noun
from semnav_env.language.speech.lexicon import SpeechLexicon
from semnav_env.language.speech.moves import landmark

AHEAD = 'in what distance? first say how far to go, for example "go 5 metres and turn left"'


_GOING = ("go", "continue")
"""Verbs beside "backwards" that say no more than it."""

_BESIDE_AMOUNTS = (ItemKind.SLIGHT, ItemKind.STRAIGHT, ItemKind.BACK, ItemKind.HERE)
"""Items beside which "a bit" is of the way."""


def problem_of_distance(items: Sequence[Item], words: Sequence[str]) -> tuple[str, int, int] | None:
    """The problem with "left in 5 metres", and the words' numbers."""
    for before, each in pairwise(items):
        if each.kind is ItemKind.DISTANCE and list(words[before.start : each.start]) == ["in"]:
            return AHEAD, before.start, each.stop
    return None


def with_amounts(items: Sequence[Item], words: Sequence[str], lexicon: SpeechLexicon) -> list[Item]:
    """The items, with "a bit" as a distance where a clause only says to go on, or backwards."""
    found: list[Item] = []
    for _, group in groupby(items, lambda item: item.kind in JOINTS):
        clause = list(group)
        goes_on = [_goes_on(i) or lexicon.find(words, i.start, "backwards") for i in clause]
        found += map(_as_amount, clause) if all(goes_on) and len(clause) > 1 else clause
    return found


def _goes_on(item: Item) -> bool:
    """Whether an item can stand in a clause that only says to go on."""
    if item.kind is ItemKind.VERB:
        return item.value in _GOING or item.value in ("back", "follow", "be")
    hall = item.kind is ItemKind.REF and item.value.kind == "hall"
    return hall or item.kind in _BESIDE_AMOUNTS


def _as_amount(item: Item) -> Item:
    is_slight = item.kind is ItemKind.SLIGHT
    return replace(item, kind=ItemKind.DISTANCE, value=SOME) if is_slight else item


def with_offsets(items: Sequence[Item], words: Sequence[str]) -> list[Item]:
    """The items, with one place for "a metre before the corner" and "a bit before the corner"."""
    found: list[Item] = []
    for item in items:
        accusative = item.kind is ItemKind.REF and words[item.start] in ("vor", "vors")
        offset = _offset(found[-1], item, accusative) if found else None
        if offset is None:
            found.append(item)
        else:
            noun = Noun("offset", offset=offset)
            found[-1:] = [Item(ItemKind.REF, found[-1].start, item.stop, noun, ("until",))]
    return found


def _offset(before: Item, item: Item, accusative: bool) -> PlaceOffset | None:
    """The place that a distance and a noun behind it say; None if they say none together.

    A German "vor" with an accusative says the place in front as well ("bis vor die Tür").
    """
    is_far = before.kind is ItemKind.DISTANCE and isinstance(before.value, Distance)
    if item.kind is not ItemKind.REF or before.stop != item.start:
        return None
    try:
        if ("before" in item.roles or accusative) and (is_far or before.kind is ItemKind.SLIGHT):
            far = before.value if is_far else SOME
            return PlaceOffset(far, Relation.BEFORE, landmark(item.value))
        if is_far and {"after", "past"} & set(item.roles):
            return PlaceOffset(before.value, Relation.AFTER, landmark(item.value))
    except ValueError:
        return None  # "after the end of the hallway"
    return None


def with_backing_up(
    items: Sequence[Item], words: Sequence[str], lexicon: SpeechLexicon
) -> list[Item]:
    """The items, with one verb for "reverse" in each clause that says how far.

    "Reverse" alone, and "reverse, then go two metres", turn the robot around.
    """
    found: list[Item] = []
    for is_joint, group in groupby(items, lambda item: item.kind in JOINTS):
        clause = list(group)
        backs_up = not is_joint and any(item.kind is ItemKind.DISTANCE for item in clause)
        found += _with_verb(clause, words, lexicon) if backs_up else clause
    return found


def _with_verb(
    clause: Sequence[Item], words: Sequence[str], lexicon: SpeechLexicon
) -> Sequence[Item]:
    for at in range(clause[0].start, clause[-1].stop):
        if found := lexicon.find(words, at, "backwards"):
            said = [item for item in clause if item.start < found[1] and item.stop > at]
            start = min([at, *(item.start for item in said)])
            stop = max([found[1], *(item.stop for item in said)])
            verb = Item(ItemKind.VERB, start, stop, "reverse")
            kept = [item for item in clause if item not in said and item.value not in _GOING]
            return sorted([*kept, verb], key=lambda item: item.start)
    return clause
