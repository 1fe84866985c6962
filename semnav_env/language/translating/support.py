"""Checks that the words of a text support a translation, before the robot asks about it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from semnav_env.language.clauses import Follow, GoBack, Leave, Pace, Stop
from semnav_env.language.command import Command, reference_of
from semnav_env.language.finding_clauses import AskName, GoToPerson
from semnav_env.language.references import PlaceReference
from semnav_env.language.vocabulary.lexicon import Lexicon
from semnav_env.language.vocabulary.recognition import lexicon_for, recognised
from semnav_env.language.vocabulary.room_words import SUPPORTING

_COUNTED = ("one", "ordinal", "another")
_KINDS = ((GoBack, "back"), (Leave, "leave"), (GoToPerson, "person"), (AskName, "person"))
NEEDED = {
    "door": ("noun door", "noun room", "noun doorway", "number", "it", "after that", *_COUNTED),
    "intersection": ("noun intersection", "noun turning", *_COUNTED),
    "corner": ("noun corner", "one"),
    "t_junction": ("noun t_junction", "noun intersection"),
    "end": ("noun end", "noun wall", "noun hall", "to end", "end until", "at end", "verb cross"),
    "turning": ("noun turning", "noun hall", "noun intersection", "verb turn", *_COUNTED),
    "back": ("back", "verb return", "verb back", "noun start", "noun way back", "start where"),
    "person": ("person",),
    "leave": ("verb leave", "verb exit", "noun room", "noun door", "noun area", "out", "prep out"),
}
"""For each thing that a command names, the classes of phrases of which a text must have one."""


@dataclass(frozen=True)
class TextSupport:
    """The evidence in the words of a text.

    Attributes:
        words: of the text without values and rooms.
        lexicon: of its language, with words of others where it has some.
    """

    words: tuple[str, ...]
    lexicon: Lexicon

    @classmethod
    def of(cls, words: Sequence[str]) -> TextSupport:
        """The evidence in some words, whose language is recognised."""
        each = tuple(part for word in words for part in word.split(" "))
        return cls(each, lexicon_for(each, recognised(each)))

    @cached_property
    def classes(self) -> frozenset[str]:
        """The classes of all phrases in the text, with their values and without."""
        said = f" {' '.join(self.words)} "
        found = {
            kind for kind, row in SUPPORTING.items() if any(f" {each} " in said for each in row)
        }
        for at in range(len(self.words)):
            for kind, value, _ in self.lexicon.matches(self.words, at):
                found |= {kind, f"{kind} {value}"}
        return frozenset(found)

    def speaks_of(self, command: Command) -> bool:
        """Whether a command has something to do, of all of which the text speaks."""
        idle = all(
            isinstance(clause, Stop | Pace) or clause == Follow() for clause in command.clauses
        )
        return not idle and all(self.classes & set(NEEDED[name]) for name in _named(command))


def _named(command: Command) -> set[str]:
    """The features that a command names, by the keys of `NEEDED`."""
    found: set[str] = set()
    for clause in command.clauses:
        what = reference_of(clause)
        if what is not None:
            found.add(what.place.value if isinstance(what, PlaceReference) else "door")
        found |= {name for kind, name in _KINDS if isinstance(clause, kind)}
    return found
