"""Finds what asks the robot to drive backwards, which no command can say."""

from __future__ import annotations

from collections.abc import Sequence

from semnav_env.commands.speech.items import JOINTS, Item, ItemKind
from semnav_env.commands.speech.lexicon import SpeechLexicon

PROBLEM = "driving backwards is not understood: turn around first, then say how far to go"


def driven_backwards(
    items: Sequence[Item], words: Sequence[str], lexicon: SpeechLexicon
) -> tuple[str, int, int] | None:
    """The problem with "reverse two metres" and the words' numbers; None if nothing asks for it.

    "Reverse" alone, and "reverse, then go two metres", turn the robot around.
    """
    clause: list[Item] = []
    for item in [*items, None]:
        if item is not None and item.kind not in JOINTS:
            clause.append(item)
            continue
        if any(each.kind is ItemKind.DISTANCE for each in clause):
            span = range(clause[0].start, clause[-1].stop)
            for at in span:
                if found := lexicon.find(words, at, "backwards"):
                    return PROBLEM, at, found[1]
        clause = []
    return None
