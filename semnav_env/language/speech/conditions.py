"""Reads conditions: "if there is no door on the left", "falls die Tür links offen ist"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from semnav_env.language.references import Side
from semnav_env.language.speech.items import Item, ItemKind, Noun
from semnav_env.language.speech.lexicon import SpeechLexicon
from semnav_env.language.speech.nouns import NounReader


@dataclass(frozen=True, slots=True)
class Premise:
    """What a condition asks for.

    Attributes:
        noun: a door or a place; None for the door that was named before ("if it is closed").
        absent: it asks for something that is not there, or for a closed door.
        state: "open", "closed" or "".
    """

    noun: Noun | None
    absent: bool
    state: str = ""


def read_condition(
    words: Sequence[str], at: int, lexicon: SpeechLexicon, nouns: NounReader
) -> Item | None:
    """The condition that begins at a word; None if none does."""
    unless = lexicon.find(words, at, "unless")
    begin = unless or lexicon.find(words, at, "if")
    inverted = asked = None
    if begin is None and (at == 0 or not words[at - 1][0].isalpha()):
        begin = asked = lexicon.find(words, at, "if there")
        if asked is None:
            begin = inverted = lexicon.find(words, at, "if start")
    if begin is None:
        return None
    here, noun, side = begin[1], None, None
    absent, state, exists, pronoun = unless is not None, "", asked is not None, False
    at_end = False
    stop = here
    while here < len(words):
        found = _longest(words, here, lexicon)
        read = nouns.read(here) if noun is None else None
        if (
            read
            and read[1] >= (found[1] if found else 0)
            and read[0].kind not in ("it", "one", "wall", "start")
        ):
            noun, here = read
            if noun.kind == "named" and (door := lexicon.find(words, here, "noun")):
                here = door[1] if door[0] == "door" else here  # "the kitchen door"
            stop = here
            continue
        if found is None:
            break
        kind, end, value = found
        if kind == "absent":
            absent = not absent
        elif kind in ("is open", "is closed"):
            state = kind[3:]
        elif kind == "exists":
            exists = True
        elif kind == "pronoun":
            pronoun = True
        elif kind == "at end":
            at_end = True
        elif kind == "side" and noun is None:
            side = Side(value)
        elif kind != "filler" and kind != "here":
            break
        here = end
        if kind != "filler":
            stop = here
        if state and (noun or pronoun):
            break
    if noun == Noun("door") and state and nouns.memory.names_door():
        noun, pronoun = None, True  # "into the first door; if the door is closed, ..."
    if noun is None and not (pronoun and state):
        return None
    if noun is not None and noun.kind == "named" and not (state or absent):
        return None  # "when you see the kitchen" is a place
    if inverted and not state:
        return None
    if asked:
        then = _then(words, stop, lexicon)
        shown = noun is not None and noun.definite and not absent
        if then is None or (shown and words[then - 1] == "?"):
            return None  # "do you see the two doors? take the first"
        stop = then
    if not (exists or state or absent):
        return None
    if noun is not None and side is not None and noun.side is None:
        noun = Noun(noun.kind, noun.ordinal, side, noun.name)
    if noun is not None and at_end:
        noun = replace(noun, at_end=True)
    closed = state == "closed"
    return Item(ItemKind.IF, at, stop, Premise(noun, absent is not closed, state))


def _then(words: Sequence[str], at: int, lexicon: SpeechLexicon) -> int | None:
    """Where what depends on an inverted condition begins: "is there a door? then ..."."""
    if at + 1 >= len(words) or words[at] not in (",", "?"):
        return None
    kinds = ("then", "verb", "around alone", "back")
    return at + 1 if any(lexicon.find(words, at + 1, kind) for kind in kinds) else None


CLASSES = (
    "at end",
    "absent",
    "is open",
    "is closed",
    "exists",
    "here",
    "pronoun",
    "side",
    "filler",
)


def _longest(words: Sequence[str], at: int, lexicon: SpeechLexicon) -> tuple[str, int, str] | None:
    """The class, end and value of the longest phrase that a condition may have at a word."""
    found = [
        (kind, stop, value) for kind, value, stop in lexicon.matches(words, at) if kind in CLASSES
    ]
    if side := next((f for f in found if f[0] == "side"), None):
        return side
    return min(found, key=lambda each: (-each[1], CLASSES.index(each[0])), default=None)
