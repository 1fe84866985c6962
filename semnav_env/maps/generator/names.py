"""What the rooms of a generated office are called: numbers as on door plates, and functions."""

from __future__ import annotations

from collections.abc import Sequence

from numpy.random import Generator

from semnav_env.maps.generator.chance import chance
from semnav_env.maps.generator.lots import Lot

SMALL = ("printer room", "storage room", "server room", "toilets", "first aid room", "copy room")
USUAL = ("kitchen", "library", "archive", "laboratory", "workshop", "phone room", "mail room")
BIG = ("meeting room", "conference room", "canteen", "seminar room", "training room", "studio")
REPEATED = frozenset(("meeting room", "toilets", "storage room", "printer room", "laboratory"))
"""Of these a storey may have several, as of areas: "toilets 2"."""

AREAS = ("lounge", "reception", "coffee corner", "waiting area", "print corner")

SMALL_AREA, BIG_AREA = 10.5, 26.0
"""Square metres."""

NAMED = 0.35
"""Chance of a room to be called by what it is for."""

NUMBERED_STOREYS = 4


def name_rooms(rng: Generator, lots: Sequence[Lot]) -> tuple[str, ...]:
    """A name for each: "2.07", or what it is for; no two the same.

    The number counts the rooms along the corridors; areas without a front wall have no number.
    """
    storey = 1 + int(rng.integers(NUMBERED_STOREYS))
    names = [""] * len(lots)
    used: dict[str, int] = {}
    order = sorted(range(len(lots)), key=lambda i: (lots[i].corridor, lots[i].front.span))
    number = 0
    for index in order:
        lot, word = lots[index], _function(rng, lots[index])
        number += not lot.open
        suits = chance(rng, NAMED) and (word not in used or word in REPEATED)
        if lot.open or suits:
            names[index] = _numbered(word, used)
        else:
            names[index] = f"{storey}.{number:02d}"
    return tuple(names)


def _function(rng: Generator, lot: Lot) -> str:
    words: tuple[str, ...] = AREAS
    if not lot.open:
        words = SMALL if lot.area < SMALL_AREA else BIG if lot.area > BIG_AREA else USUAL
    return words[int(rng.integers(len(words)))]


def _numbered(word: str, used: dict[str, int]) -> str:
    """The second lounge is "lounge 2"."""
    used[word] = used.get(word, 0) + 1
    return word if used[word] == 1 else f"{word} {used[word]}"
