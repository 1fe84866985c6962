"""Names of the rooms of a generated office: numbers as on door plates, and functions."""

from __future__ import annotations

from collections.abc import Sequence

from numpy.random import Generator

from semnav_env.world.maps.generator.chance import chance
from semnav_env.world.maps.generator.lots import Lot

SMALL_ROOM_NAMES = (
    "printer room",
    "storage room",
    "server room",
    "toilets",
    "first aid room",
    "copy room",
)
"""Names of small rooms."""

ROOM_NAMES = ("kitchen", "library", "archive", "laboratory", "workshop", "phone room", "mail room")
"""Names of rooms of a usual size."""

BIG_ROOM_NAMES = (
    "meeting room",
    "conference room",
    "canteen",
    "seminar room",
    "training room",
    "studio",
)
"""Names of big rooms."""

REPEATED_NAMES = frozenset(
    ("meeting room", "toilets", "storage room", "printer room", "laboratory")
)
"""Names that several rooms of a storey may have, numbered as in "toilets 2"."""

AREA_NAMES = ("lounge", "reception", "coffee corner", "waiting area", "print corner")
"""Names of open areas."""


SMALL_AREA = 10.5
"""Floor area below which a room is small, square metres."""

BIG_AREA = 26.0
"""Floor area above which a room is big, square metres."""

NAMED_CHANCE = 0.35
"""Probability that a room is named by its function and not by a number."""

NUMBERED_STOREYS = 4
"""Number of storeys that room numbers come from: 101 to 4xx."""


def name_rooms(rng: Generator, lots: Sequence[Lot]) -> tuple[str, ...]:
    """A unique name for each lot: a number such as "2.07", or the function of the room.

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
        suits = chance(rng, NAMED_CHANCE) and (word not in used or word in REPEATED_NAMES)
        if lot.open or suits:
            names[index] = _numbered(word, used)
        else:
            names[index] = f"{storey}.{number:02d}"
    return tuple(names)


def _function(rng: Generator, lot: Lot) -> str:
    words: tuple[str, ...] = AREA_NAMES
    if not lot.open:
        words = (
            SMALL_ROOM_NAMES
            if lot.area < SMALL_AREA
            else BIG_ROOM_NAMES
            if lot.area > BIG_AREA
            else ROOM_NAMES
        )
    return words[int(rng.integers(len(words)))]


def _numbered(word: str, used: dict[str, int]) -> str:
    """Number repeated names: the second lounge is "lounge 2"."""
    used[word] = used.get(word, 0) + 1
    return word if used[word] == 1 else f"{word} {used[word]}"
