"""Words the command of an episode: canonically, in other words, or with a correction."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from numpy.random import Generator

from semnav_env.language import (
    Approach,
    Clause,
    Command,
    DoorReference,
    GoToDoor,
    IfThere,
    Side,
    Turn,
    Turning,
    paraphrases,
)
from semnav_env.language.command import may_count_on
from semnav_env.language.languages import language_of

PARAPHRASED_SHARE = 0.6
"""Share of the commands with other than canonical words."""

CORRECTED_SHARE = 0.18
"""Share of the commands with a slip of the tongue that is corrected."""

CORRECTION_WORDS = {"en": "no", "de": "nein"}
"""Words that begin a correction, by the code of the language."""


CORRECTED_DOORS = {
    "en": {"left": "the left one", "right": "the right one", "nth": "the {} one"},
    "de": {"left": "die linke", "right": "die rechte", "nth": "die {}"},
}
"""Words for the correct door in a correction: by its side, or by its ordinal."""


CORRECTED_TURNS = {
    "en": {"left": "left", "right": "right"},
    "de": {"left": "links", "right": "rechts"},
}
"""Words for the correct side of a turn in a correction."""


CLOSED_DOOR_PHRASES = {
    "en": "if {} is closed, take the next",
    "de": "falls {} geschlossen ist, nimm die nächste",
}
"""Phrases for the door behind a closed one; {} stands for the closed door."""


_OPPOSITE = {"left": "right", "right": "left"}


def worded(
    command: Command, language: str, rng: Generator, rooms: Sequence[str], *, closed: bool = False
) -> str | None:
    """Draw words with exactly the meaning of a command, given the names of the rooms.

    Args:
        command: the command to word; its last clause may be said wrongly first, then corrected.
        language: code of the language.
        rng: source of randomness.
        rooms: the names of the rooms there.
        closed: the last clause is to take the first door, but a closed one comes before it.

    Returns:
        None if no words were found.
    """
    text = command.say(language)
    draw = rng.random()
    if closed and draw < PARAPHRASED_SHARE:
        text = _but_for_a_closed_one(command, language) or text
    elif draw < CORRECTED_SHARE:
        corrected = _corrected(command, language, rng)
        if corrected and len(command.clauses) > 1 and may_count_on(*command.clauses[-2:]):
            return None  # "past the first door and from there to the third, no, the second"
        text = corrected or text
    elif draw < CORRECTED_SHARE + PARAPHRASED_SHARE:
        text = next(iter(paraphrases(command, rng, 1, language)), text)
    return text


def _but_for_a_closed_one(command: Command, language: str) -> str | None:
    """The command with "if the first door on the left is closed, take the next" as its end."""
    *before, last = command.clauses
    if not isinstance(last, GoToDoor) or last.approach is not Approach.THROUGH:
        return None
    said = f"{Command(tuple(before)).say(language)}, " if before else ""
    return said + CLOSED_DOOR_PHRASES[language].format(last.door.say(language_of(language)))


def _corrected(command: Command, language: str, rng: Generator) -> str | None:
    """The command with a slip in its last clause, and "no, the left one" behind it."""
    *before, last = command.clauses
    if any(isinstance(clause, IfThere) for clause in before):
        return None  # which of the clauses would that be?
    wrong, instead = _slip(last, language, rng)
    if wrong is None:
        return None
    said = Command((*before, wrong)).say(language)
    return f"{said}, {CORRECTION_WORDS[language]}, {instead}"


def _slip(clause: Clause, language: str, rng: Generator) -> tuple[Clause | None, str]:
    """A clause with another number or side, and how that is corrected."""
    match clause:
        case GoToDoor(DoorReference(ordinal, Side.LEFT | Side.RIGHT as side)) if rng.random() < 0.5:
            door = DoorReference(ordinal, Side(_OPPOSITE[side]))
            return replace(clause, door=door), CORRECTED_DOORS[language][side]
        case GoToDoor(DoorReference(ordinal, side)) if ordinal > 0:
            said = ordinal + 1 if ordinal == 1 or rng.random() < 0.5 else ordinal - 1
            nth = CORRECTED_DOORS[language]["nth"].format(language_of(language).ordinal(ordinal))
            return replace(clause, door=DoorReference(said, side)), nth
        case Turn(Turning.LEFT | Turning.RIGHT as way, _, None):
            return replace(clause, turning=Turning(_OPPOSITE[way])), CORRECTED_TURNS[language][way]
    return None, ""
