"""Reads how a robot is to stand: "so that the wall is on your left"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from semnav_env.language.references import Side
from semnav_env.language.speech.items import Item, ItemKind, Noun
from semnav_env.language.speech.lexicon import SpeechLexicon
from semnav_env.language.speech.nouns import NounReader

_BETWEEN = ("filler", "here", "particle", "softener", "slight", "around", "det")
"""Classes of words between the verb and "so that"."""

_SMALL = ("filler", "facing word", "link", "softener", "be", "relative", "pronoun")
"""Classes of words of such a clause besides its noun and where that is."""

_ENDS = (Side.AHEAD, Side.BEHIND, Side.LEFT, Side.RIGHT)

MAX_BETWEEN = 5
"""The most words between the verb and "so that"."""


def read_facing(
    words: Sequence[str], at: int, lexicon: SpeechLexicon, nouns: NounReader
) -> Item | None:
    """What is to be where once the robot has turned; None if nothing is said of it at a word.

    The item is a noun with the role "faced"; its side is where the noun is to be.
    """
    orient = lexicon.find(words, at, "orient")
    if orient is None:
        return None
    here = orient[1]
    begin = lexicon.find(words, here, "so that")
    while begin is None and here < min(len(words), orient[1] + MAX_BETWEEN):
        step = _step(words, here, lexicon, _BETWEEN)
        if step is None and words[here] != ",":
            return None
        here = step or here + 1
        begin = lexicon.find(words, here, "so that")
    return None if begin is None else _placed(words, at, begin[1], lexicon, nouns)


def _placed(
    words: Sequence[str], start: int, here: int, lexicon: SpeechLexicon, nouns: NounReader
) -> Item | None:
    noun: Noun | None = None
    side: Side | None = None
    stop = here
    while here < len(words):
        read = nouns.read(here) if noun is None else None
        position = _position(words, here, lexicon, nouns) if side is None else None
        if position is not None and (read is None or position[1] >= read[1]):
            side, here = position
        elif read is not None and read[0].kind not in ("it", "one", "hall", "start"):
            noun, here = read
            if noun.side in _ENDS and (noun.kind in ("wall", "named") or noun.side in _ENDS[:2]):
                side, noun = noun.side, replace(noun, side=None)
        elif (step := _step(words, here, lexicon, _SMALL)) is not None:
            here = step
            stop = here if noun is not None and side is not None else stop
            continue
        else:
            break
        stop = here
    if noun is None or side is None:
        return None
    return Item(ItemKind.REF, start, stop, replace(noun, side=side), ("faced",))


def _step(
    words: Sequence[str], at: int, lexicon: SpeechLexicon, kinds: Sequence[str]
) -> int | None:
    found = [match for kind in kinds if (match := lexicon.find(words, at, kind))]
    return max((stop for _, stop in found), default=None)


def _position(
    words: Sequence[str], at: int, lexicon: SpeechLexicon, nouns: NounReader
) -> tuple[Side, int] | None:
    """Where something is: "straight ahead of you", "on your left", "links von dir"."""
    if (where := lexicon.find(words, at, "where")) and where[0] in ("ahead", "behind"):
        return Side(where[0]), where[1]
    return nouns._side_at(Noun("door"), at)
