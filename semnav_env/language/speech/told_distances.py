"""Finds distances that no command can say: backwards, or up to a turn that is named first."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from semnav_env.language.speech.items import JOINTS, Item, ItemKind
from semnav_env.language.speech.lexicon import SpeechLexicon

BACKWARDS = "driving backwards is not understood: turn around first, then say how far to go"
AHEAD = 'in what distance? first say how far to go, for example "go 5 metres and turn left"'


def problem_of_distance(
    items: Sequence[Item], words: Sequence[str], lexicon: SpeechLexicon
) -> tuple[str, int, int] | None:
    """The problem with "reverse two metres" or "left in 5 metres", and the words' numbers.

    "Reverse" alone, and "reverse, then go two metres", turn the robot around.
    """
    for before, each in pairwise(items):
        if each.kind is ItemKind.DISTANCE and list(words[before.start : each.start]) == ["in"]:
            return AHEAD, before.start, each.stop
    clause: list[Item] = []
    for item in [*items, None]:
        if item is not None and item.kind not in JOINTS:
            clause.append(item)
            continue
        if any(each.kind is ItemKind.DISTANCE for each in clause):
            for at in range(clause[0].start, clause[-1].stop):
                if found := lexicon.find(words, at, "backwards"):
                    return BACKWARDS, at, found[1]
        clause = []
    return None
