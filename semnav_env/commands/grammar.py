"""The parser of a language: Lark's LALR(1) with the contextual lexer, and what its rules build."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

from lark import Lark, Token, Transformer, v_args
from lark.tree import Meta

from semnav_env.commands.clauses import (
    LAST,
    Approach,
    Clause,
    DoorReference,
    Follow,
    GoToDoor,
    Place,
    PlaceReference,
    Side,
    Stop,
    Turn,
    Turning,
)
from semnav_env.commands.language import Language


@dataclass(frozen=True, slots=True)
class FoundClause:
    """A clause and the stretch of text that says it."""

    clause: Clause
    start: int
    stop: int


class _Clauses(Transformer[Token, list[FoundClause]]):
    """Builds the value of each rule of the grammar, from the innermost outwards."""

    def __init__(self, language: Language) -> None:
        super().__init__()
        self._language = language

    def start(self, clauses: list[FoundClause]) -> list[FoundClause]:
        return clauses

    @v_args(meta=True)
    def clause(self, meta: Meta, clauses: list[Clause]) -> FoundClause:
        return FoundClause(clauses[0], meta.start_pos, meta.end_pos)

    def follow(self, until: list[PlaceReference | DoorReference | None]) -> Follow:
        return Follow(until[0])

    @v_args(inline=True)
    def turn(self, turning: Turning, at: PlaceReference | None) -> Turn:
        return Turn(turning, at)

    @v_args(inline=True)
    def turn_here(self, turning: Turning) -> Turn:
        return Turn(turning)

    @v_args(inline=True)
    def turn_at(self, at: PlaceReference, turning: Turning) -> Turn:
        return Turn(turning, at)

    @v_args(inline=True)
    def go_to(self, door: DoorReference) -> GoToDoor:
        return GoToDoor(door, Approach.TO)

    @v_args(inline=True)
    def go_through(self, door: DoorReference) -> GoToDoor:
        return GoToDoor(door, Approach.THROUGH)

    def stop(self, _: list[Token]) -> Stop:
        return Stop()

    @v_args(inline=True)
    def junction(self, ordinal: int | None, kind: Token) -> PlaceReference:
        return PlaceReference(Place[kind.type], ordinal or 1)

    def end(self, _: list[Token]) -> PlaceReference:
        return PlaceReference(Place.END)

    @v_args(inline=True)
    def door(self, ordinal: int | None, side: Side | None) -> DoorReference:
        return DoorReference(ordinal or 1, side)

    @v_args(inline=True)
    def nth(self, word: Token) -> int:
        return self._language.number(word)

    def last(self, _: list[Token]) -> int:
        return LAST

    @v_args(inline=True)
    def turning(self, word: Token) -> Turning:
        return Turning[word.type]

    @v_args(inline=True)
    def side(self, word: Token) -> Side:
        return Side[word.type]


def find_clauses(language: Language, text: str) -> list[FoundClause]:
    """The clauses of a normalised text, in order.

    Raises:
        lark.UnexpectedInput: the text is not a command.
    """
    return _Clauses(language).transform(_parser(language).parse(text))


@cache
def _parser(language: Language) -> Lark:
    return Lark(
        language.lark(),
        parser="lalr",
        lexer="contextual",
        propagate_positions=True,
        maybe_placeholders=True,
    )
