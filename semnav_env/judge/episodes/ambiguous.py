"""Texts with several meanings, built from the cases in docs/guides/language.md.

Their meanings are written by hand and not taken from the grammar, so that they can test it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from semnav_env.language import (
    Approach,
    Clause,
    Command,
    DoorReference,
    Follow,
    GoBack,
    GoToDoor,
    Side,
    Turn,
    Turning,
)
from semnav_env.language.languages import language_of

Readings: TypeAlias = tuple[tuple[Clause, ...], ...]
"""All clauses that a text can stand for, one tuple for each meaning."""

Recipe: TypeAlias = Callable[[np.random.Generator, str], tuple[str, Readings]]
"""Makes a text and its readings from a random generator and the code of a language."""


SIDE_WORDS = {"en": ("left", "right"), "de": ("links", "rechts")}
"""Words for left and right by the code of the language."""


def ambiguous_text(
    first: Command | None, rng: np.random.Generator, code: str
) -> tuple[str, tuple[Command, ...]]:
    """A text and all its meanings.

    Args:
        first: an unambiguous command that is said before it; None for none.
        rng: source of randomness.
        code: code of the language.
    """
    text, readings = RECIPES[int(rng.integers(len(RECIPES)))](rng, code)
    before = () if first is None else first.clauses
    said = text
    if first is not None:
        said = first.say(code) + {"en": ", then ", "de": ", dann "}[code] + text
    return said, tuple(Command((*before, *reading)) for reading in readings)


def _bare_door(rng: np.random.Generator, code: str) -> tuple[str, Readings]:
    """Make a door without a verb: to it, or through it?"""
    ordinal, side = _ordinal(rng), int(rng.integers(2))
    door = DoorReference(ordinal, _SIDE[side])
    word = language_of(code).ordinal(ordinal)
    text = {
        "en": f"the {word} door on the {SIDE_WORDS['en'][side]}",
        "de": f"die {word} Tür {SIDE_WORDS['de'][side]}",
    }[code]
    return text, ((GoToDoor(door, Approach.TO),), (GoToDoor(door),))


def _back(rng: np.random.Generator, code: str) -> tuple[str, Readings]:
    """Make "go back": to the start, or around and down the corridor?"""
    text = {"en": "go back", "de": "geh zurück"}[code]
    return text, ((GoBack(),), (Turn(Turning.AROUND), Follow()))


def _quarter(rng: np.random.Generator, code: str) -> tuple[str, Readings]:
    """Make a turn without a side."""
    degrees = (45, 90, 135)[int(rng.integers(3))]
    text = {"en": f"turn {degrees} degrees", "de": f"dreh dich um {degrees} Grad"}[code]
    return text, ((Turn(Turning.LEFT, degrees=degrees),), (Turn(Turning.RIGHT, degrees=degrees),))


def _at_door(rng: np.random.Generator, code: str) -> tuple[str, Readings]:
    """Make a turn at a door: through it, or beside it?"""
    ordinal, side = _ordinal(rng), int(rng.integers(2))
    word = language_of(code).ordinal(ordinal)
    text = {
        "en": f"turn {SIDE_WORDS['en'][side]} at the {word} door",
        "de": f"bieg an der {word}n Tür {SIDE_WORDS['de'][side]} ab",
    }[code]
    beside = Follow(DoorReference(ordinal)), Turn(_TURNING[side])
    return text, (beside, (GoToDoor(DoorReference(ordinal, _SIDE[side])),))


def _comma_side(rng: np.random.Generator, code: str) -> tuple[str, Readings]:
    """Make a side behind a comma: which door, or where to turn behind it?"""
    ordinal, side = _ordinal(rng), int(rng.integers(2))
    word = language_of(code).ordinal(ordinal)
    text = {
        "en": f"take the {word} door, {SIDE_WORDS['en'][side]}",
        "de": f"nimm die {word} Tür, {SIDE_WORDS['de'][side]}",
    }[code]
    turned = GoToDoor(DoorReference(ordinal)), Turn(_TURNING[side])
    return text, (turned, (GoToDoor(DoorReference(ordinal, _SIDE[side])),))


def _counting(rng: np.random.Generator, code: str) -> tuple[str, Readings]:
    """Make a door after another one: counted from the start, or from that one?"""
    passed = 1 + int(rng.integers(2))
    ordinal = passed + 1 + int(rng.integers(2))
    language = language_of(code)
    first, second = language.ordinal(passed), language.ordinal(ordinal)
    text = {
        "en": f"go past the {first} door and go through the {second} door",
        "de": f"geh an der {first}n Tür vorbei und dann durch die {second} Tür",
    }[code]
    past = Follow(DoorReference(passed), past=True)
    anew, on = DoorReference(ordinal), DoorReference(ordinal - passed)
    return text, ((past, GoToDoor(anew)), (past, GoToDoor(on)))


RECIPES: tuple[Recipe, ...] = (_bare_door, _back, _quarter, _at_door, _comma_side, _counting)
"""All recipes; each is drawn equally often."""


_SIDE = (Side.LEFT, Side.RIGHT)
_TURNING = (Turning.LEFT, Turning.RIGHT)


def _ordinal(rng: np.random.Generator) -> int:
    return (1, 1, 2, 2, 3)[int(rng.integers(5))]
