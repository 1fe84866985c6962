"""A command: what the robot is told to do, clause by clause."""

from __future__ import annotations

from dataclasses import dataclass

from semnav_env.commands.clauses import Clause
from semnav_env.commands.language import Language, english

MAX_CLAUSES = 8
"""The most clauses a command can have."""


@dataclass(frozen=True, slots=True)
class Command:
    """Clauses to carry out in turn: "go down the hallway, turn left and go through the door".

    `str(command)` is canonical English and `parse(str(command)) == command`.

    Attributes:
        clauses: what to do one after the other, 1 to `MAX_CLAUSES`.

    Raises:
        ValueError: too few or too many clauses, or something that is none.
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
                raise ValueError(f"a clause is Follow, Turn, GoToDoor or Stop, not {clause!r}")
        if not 1 <= len(self.clauses) <= MAX_CLAUSES:
            raise ValueError(f"a command has 1 to {MAX_CLAUSES} clauses, not {len(self.clauses)}")

    def __str__(self) -> str:
        return self.say(english())

    def say(self, language: Language) -> str:
        """In the words of a language."""
        *first, last = (clause.say(language) for clause in self.clauses)
        joined = language.say("comma").join(first)
        return f"{joined}{language.say('and')}{last}" if first else last
