"""A command: the clauses that a robot is to carry out, and how they depend on each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise
from typing import TYPE_CHECKING

from semnav_env.language.clause_kinds import CLAUSE_KINDS
from semnav_env.language.clauses import Clause, Follow, GoToRoom, IfThere, Pace
from semnav_env.language.declarations import field_names
from semnav_env.language.references import DoorReference, PlaceOffset, PlaceReference, RoomReference

if TYPE_CHECKING:
    from semnav_env.language.language import Language

MAX_CLAUSES = 8
"""The most clauses of a command; it fixes the shape of its tokens."""


@dataclass(frozen=True, slots=True)
class Command:
    """Clauses to carry out one after the other: "go down the hallway, turn left and stop".

    `str(command)` is canonical English, and `parse(str(command)) == command`. The same holds for
    `command.say(language)` in every language.

    Attributes:
        clauses: 1 to `MAX_CLAUSES` of them, in order.

    Raises:
        ValueError: there are too few or too many clauses, something else among them, or nothing
            but a pace.
    """

    clauses: tuple[Clause, ...]

    def __post_init__(self) -> None:
        if not isinstance(self.clauses, tuple):
            kind = type(self.clauses).__name__
            raise ValueError(
                f"a command holds a tuple of clauses, not {kind}; text goes to parse()"
            )
        for clause in self.clauses:
            if not isinstance(clause, Clause):
                kinds = ", ".join(CLAUSE_KINDS)
                raise ValueError(f"a clause is one of {kinds}, OwnClause, not {clause!r}")
        if not 1 <= len(self.clauses) <= MAX_CLAUSES:
            raise ValueError(f"a command has 1 to {MAX_CLAUSES} clauses, not {len(self.clauses)}")
        if all(isinstance(clause, Pace) for clause in self.clauses):
            raise ValueError("a command says what to do, and not only how fast")
        links_of(self.clauses)

    def __str__(self) -> str:
        return self.say()

    def say(self, language: str | Language = "en") -> str:
        """In the words of a language.

        Args:
            language: "en", "de" or a loaded one.

        Raises:
            ValueError: there is no such language.
        """
        from semnav_env.language.languages import language_of  # read when first spoken

        return "".join(self.parts(language_of(language)))

    def parts(self, spoken: Language) -> list[str]:
        """The words of the clauses, and between each two of them the words that join them."""
        said = [self.clauses[0].say(spoken)]
        links = links_of(self.clauses)
        last = len(self.clauses) - 2
        for index, (before, clause) in enumerate(pairwise(self.clauses)):
            link = links[index + 1]
            plain = link in (Link.NEXT, Link.ALSO)
            is_last = link is Link.ALSO or (plain and index == last)
            joint = spoken.say("and" if is_last else "comma")
            anew = plain and may_count_on(before, clause)
            adverb = spoken.say("from_there" if anew else link.value) if anew or not plain else ""
            said += [joint + adverb, clause.say(spoken)]
        return said


class Link(Enum):
    """How a clause depends on those before it; the value is the phrase of a language for it.

    `NEXT` and `ALSO`, which comes after another clause for the same case, need no phrase. What
    depends on a condition ends with it, or where "otherwise" or "in any case" is said.
    """

    NEXT = "next"
    THEN = "in_that_case"
    ALSO = "also"
    OTHERWISE = "otherwise"
    IN_ANY_CASE = "in_any_case"


def links_of(clauses: Sequence[Clause]) -> list[Link]:
    """How each clause depends on those before it.

    Raises:
        ValueError: a condition is not followed by the clauses that depend on it.
    """
    links: list[Link] = []
    expected: list[Link] = []
    for clause in clauses:
        link = expected.pop(0) if expected else Link.NEXT
        links.append(link)
        if not isinstance(clause, IfThere):
            continue
        if link in (Link.THEN, Link.OTHERWISE, Link.ALSO):
            raise ValueError("a condition cannot depend on another one")
        expected = [Link.THEN, *[Link.ALSO] * (clause.then - 1)]
        if clause.otherwise:
            expected += [Link.OTHERWISE, *[Link.ALSO] * (clause.otherwise - 1)]
        expected.append(Link.IN_ANY_CASE)
    if expected and expected != [Link.IN_ANY_CASE]:
        raise ValueError("a condition is followed by what to do then, and otherwise if it says so")
    return links


def reference_of(clause: Clause) -> DoorReference | PlaceReference | None:
    """The door or place to which a clause refers; None if there is none."""
    return next(
        (v for v in _places_of(clause) if isinstance(v, DoorReference | PlaceReference)), None
    )


def _places_of(clause: Clause) -> Iterator[object]:
    """The values of a clause's fields; of a place that lies off another, that other place.

    What a door is beside or before comes after the door.
    """
    for name in field_names(type(clause)):
        value = getattr(clause, name)
        place = value.place if isinstance(value, PlaceOffset) else value
        yield place
        if isinstance(place, DoorReference) and place.to is not None:
            yield place.to


def room_of(clause: Clause) -> str | None:
    """The plain name of the room that a clause names; None if it names none."""
    if isinstance(clause, GoToRoom):
        return clause.name
    return next((v.name for v in _places_of(clause) if isinstance(v, RoomReference)), None)


def may_count_on(before: Clause, clause: Clause) -> bool:
    """Whether a listener may count on: "past the first door, then through the second".

    That is so if a clause leads to or past the nth of a kind, and the next one names a later one of
    the same kind. It can be counted from where the first clause began, or anew from there.
    """
    first, second = reference_of(before), reference_of(clause)
    if not isinstance(before, Follow) or first is None or type(first) is not type(second):
        return False
    if any(isinstance(c, Follow) and isinstance(c.until, PlaceOffset) for c in (before, clause)):
        return False
    assert second is not None
    same = _kind(first) == _kind(second)
    return same and 0 < first.ordinal < second.ordinal


def _kind(reference: DoorReference | PlaceReference) -> object:
    return reference.side if isinstance(reference, DoorReference) else reference.place
