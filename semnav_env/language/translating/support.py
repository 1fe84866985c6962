"""Checks that the words of a text support a translation, before the robot asks about it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from semnav_env.language.clauses import Follow, GoBack, Leave, Pace, Stop
from semnav_env.language.command import Command, reference_of
from semnav_env.language.references import PlaceReference
from semnav_env.language.vocabulary.lexicon import Lexicon, parts_of
from semnav_env.language.vocabulary.recognition import lexicon_for, recognised

_COUNTED = ("one", "ordinal", "another")
NEEDED = {
    "door": ("noun door", "noun room", "noun doorway", "number", "it", "after that", *_COUNTED),
    "intersection": ("noun intersection", "noun turning", *_COUNTED),
    "corner": ("noun corner", "one"),
    "t_junction": ("noun t_junction", "noun intersection"),
    "end": ("noun end", "noun wall", "noun hall", "to end", "end until", "at end", "verb cross"),
    "turning": ("noun turning", "noun hall", "noun intersection", "verb turn", *_COUNTED),
    "back": ("back", "verb return", "verb back", "noun start", "noun way back", "start where"),
    "leave": ("verb leave", "verb exit", "noun room", "noun door", "noun area", "out", "prep out"),
}
"""For each thing that a command names, the classes of phrases of which a text must have one."""

FORBIDDING = ("not", "or")
"""Classes of phrases that forbid something or leave a choice: the translator often takes the
forbidden thing, or one of two, for the wanted one."""

UNCOVERING = ("beyond", "greeting", "aside")
"""Classes of phrases that do not explain a word for something that no robot can do or see."""

MIN_THING = 5
"""The fewest letters of a thing at the end of a compound, such as "salto"."""


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
        """The command of some words, whose language is recognised."""
        each = tuple(part for word in words for part in word.split(" "))
        return cls(each, lexicon_for(each, recognised(each)))

    @cached_property
    def is_impossible(self) -> bool:
        """Whether they name something that no robot can do or see."""
        covered: set[int] = set()
        for at in range(len(self.words)):
            for kind, _, stop in self.lexicon.matches(self.words, at):
                covered.update(range(at, stop) if kind not in UNCOVERING else ())
        beyond = [
            at for at in range(len(self.words)) if self.lexicon.find(self.words, at, "beyond")
        ]
        return any(at not in covered for at in beyond) or any(map(self._is_thing, self.words))

    def _is_thing(self, word: str) -> bool:
        """Whether an unknown word ends with a thing: "Rückwärtssalto"."""
        if word in self.lexicon.words or len(parts_of(word, self.lexicon)) > 1:
            return False
        things = self.lexicon.of_class("beyond") - self.lexicon.words
        return any(word.endswith(thing) for thing in things if len(thing) >= MIN_THING)

    @cached_property
    def classes(self) -> frozenset[str]:
        """The classes of all phrases in the text, with their values and without."""
        found: set[str] = set()
        for at in range(len(self.words)):
            for kind, value, _ in self.lexicon.matches(self.words, at):
                found |= {kind, f"{kind} {value}"}
        return frozenset(found)

    @property
    def is_forbidding(self) -> bool:
        """Whether they forbid something, or leave a choice."""
        return not self.classes.isdisjoint(FORBIDDING)

    @cached_property
    def leaves_open(self) -> bool:
        """Whether they forbid something or leave a choice, and name nothing instead behind it.

        What is not there in a condition ("if you do not see a door") is not forbidden.
        """
        places = [
            (at, kind)
            for at in range(len(self.words))
            for kind, _, _ in self.lexicon.matches(self.words, at)
        ]
        instead = max((at for at, kind in places if kind == "but"), default=-1)
        case = min((at for at, kind in places if kind == "if"), default=len(self.words))
        forbids = any(kind == "not" and instead < at < case for at, kind in places)
        return forbids or any(kind == "or" for _, kind in places)

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
        found |= {"back"} if isinstance(clause, GoBack) else set()
        found |= {"leave"} if isinstance(clause, Leave) else set()
    return found
