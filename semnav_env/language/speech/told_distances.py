"""Reads amounts and distances that are driven backwards; finds those that no command can say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby, pairwise

from semnav_env.language.references import SOME
from semnav_env.language.speech.items import JOINTS, Item, ItemKind
from semnav_env.language.speech.lexicon import SpeechLexicon

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
        goes_on = (_goes_on(i) or lexicon.find(words, i.start, "backwards") for i in clause)
        found += map(_as_amount, clause) if all(goes_on) else clause
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
