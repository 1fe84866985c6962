"""Finds the numbers, sides and rooms that words stand for, misspelt ones too."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TypeAlias

from rapidfuzz.distance import OSA

from semnav_env.language.references import Side, to_half_metre
from semnav_env.language.vocabulary.lexicon import Lexicon
from semnav_env.language.vocabulary.numerals import read_number
from semnav_env.language.vocabulary.room_words import ROOM_WORDS
from semnav_env.language.vocabulary.typos import nearest_word

Words: TypeAlias = Sequence[str]
Lexica: TypeAlias = Sequence[Lexicon]
Names: TypeAlias = Mapping[tuple[str, ...], str]
"""The plain name of each room by the words that people say for it."""

LONGEST_NAME = 6
"""The most words of the name of a room."""

MIN_MISSPELT, TWO_SLIPS = 5, 9
"""The fewest letters of a name that is known with one slip, and with two."""

METRES = {"cm": 0.01, "inches": 0.0254, "feet": 0.3048, "yards": 0.9144}
"""Metres of a unit, by its kind in the lexicon."""

SIDE_WORDS = {
    **dict.fromkeys(("left", "links", "linke", "linken", "linker"), Side.LEFT),
    **dict.fromkeys(("right", "rechts", "rechte", "rechten", "rechter"), Side.RIGHT),
}
"""Words for a side that are known with a slip, and with more behind them: "Linksdrehung"."""

TENS = range(20, 100, 10)
"""Numbers before which an ordinal is a part of one: "twenty fifth"."""

_HALF_MINUTE = re.compile(r"half a minute|half minute|halbe minute|halben minute|halbminute")


def number_at(words: Words, at: int, lexicon: Lexicon) -> tuple[float, int] | None:
    """The number at a word and the place behind it: in metres or seconds, where a unit follows.

    Metres are rounded to the next half, as a command has no others.
    """
    for stop in range(at + 1, min(at + 3, len(words)) + 1):
        if _HALF_MINUTE.fullmatch(" ".join(words[at:stop])):
            return 30.0, stop
    found = lexicon.find(words, at, "ordinal") or read_number(words, at, lexicon)
    if found is None:
        minute = lexicon.find(words, at, "a")
        if minute is None or not lexicon.find(words, minute[1], "minutes"):
            return None
        return 60.0, minute[1]
    value, stop = float(found[0]), found[1]
    ones = lexicon.find(words, stop, "ordinal") if value in TENS else None
    if ones and 0 < float(ones[0]) < 10:
        return value + float(ones[0]), ones[1]
    for kind, _, _ in lexicon.matches(words, stop):
        match kind:
            case "minutes":
                return value * 60, stop
            case "metres" if value:
                return to_half_metre(value), stop
            case _ if kind in METRES:
                return to_half_metre(value * METRES[kind]), stop
    return value, stop


def side_at(words: Words, at: int, lexica: Lexica) -> tuple[Side, int] | None:
    """The side that the words at a place name, also begun, and the place behind them."""
    for lexicon in lexica:
        if found := lexicon.find(words, at, "side"):
            return Side(found[0]), found[1]
    word = words[at]
    if any(word in lexicon.words for lexicon in lexica):
        return None
    begun = next((side for known, side in SIDE_WORDS.items() if word.startswith(known)), None)
    return None if begun is None else (begun, at + 1)


def misspelt_side(words: Words, at: int, lexica: Lexica) -> tuple[str, int] | None:
    """The word for a side that one with a slip was meant to be, and the place behind it."""
    word = words[at]
    near = None if any(word in x.words for x in lexica) else nearest_word(word, SIDE_WORDS)
    return (near, at + 1) if near and near[0] == word[0] else None


def room_at(words: Words, at: int, names: Names, lexica: Lexica) -> tuple[str, int] | None:
    """The plain name of the room that the words at a place name, and the place behind them."""
    for stop in range(min(len(words), at + LONGEST_NAME), at, -1):
        name = names.get(tuple(words[at:stop]))
        if name and (not _is_number(words[at:stop], lexica) or _is_room_number(words, at, stop)):
            return name, stop
    if words[at].startswith('"') and len(words[at]) > 2:
        return words[at].strip('"'), at + 1
    number = words[at + 1 : at + 2]
    if not names and words[at] in ROOM_WORDS and number and number[0][0].isdigit():
        return number[0], at + 2  # any room is taken where none is known
    return _numbered(words, at, names, lexica)


def _numbered(words: Words, at: int, names: Names, lexica: Lexica) -> tuple[str, int] | None:
    """A room whose number is said in words: "room twenty one", "Raum eins null zwei"."""
    begins = words[at : at + 1]
    if not any(len(name) == 2 and name[0] == begins[0] and name[1].isdigit() for name in names):
        return None
    found, said, place = None, "", at + 1
    while place < min(len(words), at + LONGEST_NAME):
        each = next((n for x in lexica if (n := read_number(words, place, x))), None)
        if each is None or each[0] != int(each[0]):
            break
        said, place = said + str(int(each[0])), each[1]
        if name := names.get((begins[0], said)):
            found = name, place
    return found


def misspelt_room(words: Words, at: int, names: Names, lexica: Lexica) -> tuple[str, int] | None:
    """A room whose name has a slip, or is parted in another way: "libary", "bücher ei"."""
    for stop in range(min(len(words), at + 4), at, -1):
        said = "".join(words[at:stop])
        if len(said) < MIN_MISSPELT - 1 or all(_is_known(w, lexica) for w in words[at:stop]):
            continue
        if any(tuple(words[k:stop]) in names for k in range(at + 1, stop)):
            continue  # "my library" has no slip
        most = 2 if len(said) >= TWO_SLIPS else 1
        for name, plain in names.items():
            whole = "".join(name)
            if abs(len(whole) - len(said)) > most or len(whole) < MIN_MISSPELT:
                continue
            if OSA.distance(said, whole, score_cutoff=most) <= most and _digits(whole) == _digits(
                said
            ):
                return plain, stop
    return None


def _is_room_number(words: Words, at: int, stop: int) -> bool:
    """Whether a number is a room's: "to 3.05", "take me to 214", but not "three doors"."""
    behind = words[stop : stop + 1]
    return (
        stop == at + 1
        and len(words[at]) > 2
        and words[at][0].isdigit()
        and (not behind or not behind[0].isalpha() or behind[0] in ("and", "und", "then", "dann"))
    )


def _is_number(words: Words, lexica: Lexica) -> bool:
    return any(read_number(words, 0, lexicon) for lexicon in lexica)


def _is_known(word: str, lexica: Lexica) -> bool:
    return any(word in lexicon.words for lexicon in lexica)


def _digits(text: str) -> str:
    return "".join(filter(str.isdigit, text))
