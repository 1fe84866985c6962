"""The meaning of the grammar rules for doors, places, distances and numbers.

All languages share it; see `clause_transformer`, which adds the rules for clauses.
"""

from __future__ import annotations

from lark import Token, Transformer, v_args

from semnav_env.commands.clause_readings import ClauseReadings
from semnav_env.commands.language import Language
from semnav_env.commands.references import (
    LAST,
    OTHER,
    Distance,
    DoorReference,
    Place,
    PlaceReference,
    Side,
    Unit,
)
from semnav_env.commands.rule_parts import (
    Parts,
    first_of,
    members,
    ordinal_in,
    side_in,
    whole_number,
)


class ReferentTransformer(Transformer[Token, list[ClauseReadings]]):
    """A Lark transformer: what a clause refers to.

    "The next one" is the next one of the kind that was named last, so the last door is kept.
    """

    def __init__(self, language: Language) -> None:
        super().__init__()
        self._language = language
        self._last_door: DoorReference | None = None

    def junction(self, parts: Parts) -> PlaceReference:
        self._last_door = None
        return PlaceReference(members(parts, Place)[0], ordinal_in(parts))

    def place(self, _: Parts) -> PlaceReference:
        return PlaceReference(Place.END)

    def counted_junctions(self, parts: Parts) -> PlaceReference:
        return PlaceReference(Place.INTERSECTION, whole_number(first_of(parts, float)))

    def door(self, parts: Parts) -> DoorReference:
        self._last_door = DoorReference(ordinal_in(parts), side_in(parts))
        return self._last_door

    room = door

    def door_again(self, parts: Parts) -> DoorReference:
        if self._last_door is None:
            raise ValueError("one of what? name the door")
        return DoorReference(ordinal_in(parts), side_in(parts) or self._last_door.side)

    def door_from_end(self, parts: Parts) -> DoorReference:
        ordinal = ordinal_in(parts)
        if ordinal <= OTHER:
            raise ValueError("one counts from the end with first, second, third ...")
        return DoorReference(-ordinal, side_in(parts))

    def last_door(self, parts: Parts) -> DoorReference:
        return DoorReference(LAST, side_in(parts))

    def counted_doors(self, parts: Parts) -> DoorReference:
        return DoorReference(whole_number(first_of(parts, float)), side_in(parts))

    def ahead(self, _: Parts) -> Side:
        return Side.AHEAD

    def distance(self, parts: Parts) -> Distance:
        amounts = [part for part in parts if isinstance(part, float)]
        return Distance(amounts[0] if amounts else 1.0, members(parts, Unit)[0])

    @v_args(inline=True)
    def number(self, words: Token) -> float:
        return float(self._language.number(words))

    @v_args(inline=True)
    def nth(self, words: Token) -> int:
        return self._language.counts[words]

    from_end = nth

    def other(self, _: Parts) -> int:
        return OTHER
