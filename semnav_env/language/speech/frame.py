"""The items of one clause, whatever their order, and what is common to all clauses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from semnav_env.language.clause_readings import (
    IntoDoorway,
    Readings,
    Step,
    Steps,
)
from semnav_env.language.clauses import (
    Approach,
    Follow,
    GoToDoor,
    GoToRoom,
    Turning,
)
from semnav_env.language.references import (
    Place,
    PlaceReference,
    Side,
)
from semnav_env.language.speech.items import Item, ItemKind, Noun
from semnav_env.language.speech.moves import (
    MentionError,
    NoMeaningError,
    is_door,
    landmark,
    moves,
)

KNOWN_VERBS = frozenset(
    {
        *(
            "go",
            "continue",
            "follow",
            "be",
            "pass",
            "cross",
            "turn",
            "make",
            "take",
            "enter",
            "find",
        ),
        *("leave", "exit", "return", "back", "stop", "wait", "face", "wall", "keep", "in", "out"),
        *("along", "past", "reach", "away", "count", "let", "search", "reverse"),
    }
)

END = PlaceReference(Place.END)


@dataclass(frozen=True)
class ClauseFrame:
    """The items of a clause.

    Attributes:
        items: in the order in which they stand.
    """

    items: tuple[Item, ...]

    @cached_property
    def verbs(self) -> frozenset[str]:
        """Classes of its verbs; a German verb can say more ("hineinfahren")."""
        return frozenset(word for item in self.of(ItemKind.VERB) for word in item.value.split())

    @cached_property
    def refs(self) -> tuple[Item, ...]:
        """What it names."""
        return self.of(ItemKind.REF)

    @cached_property
    def sides(self) -> tuple[Turning, ...]:
        """The sides in it that belong to no noun."""
        return tuple(Turning(item.value.value) for item in self.of(ItemKind.SIDE))

    def of(self, *kinds: ItemKind) -> tuple[Item, ...]:
        """Its items of some kinds."""
        return tuple(item for item in self.items if item.kind in kinds)

    def has(self, *kinds: ItemKind) -> bool:
        """Whether it has an item of these kinds."""
        return any(item.kind in kinds for item in self.items)

    @property
    def goes_in(self) -> bool:
        """Whether it says to go in, or through."""
        return self.has(ItemKind.IN) or "in" in self.verbs

    @property
    def goes_out(self) -> bool:
        """Whether it says to go out."""
        return self.has(ItemKind.OUT) or bool(self.verbs & {"out", "exit"})

    @property
    def particles(self) -> frozenset[str]:
        """German particles, such as "vorbei"."""
        found = {item.value for item in self.of(ItemKind.PARTICLE)}
        return frozenset(found | ({"past"} if "past" in self.verbs else set()))

    def roles(self, item: Item) -> frozenset[str]:
        """What the preposition of a noun may say, with the particles of the clause."""
        roles = set(item.roles)
        if "past" in self.particles and roles & {"at", "to", "near", ""}:
            return frozenset({"past"})
        if "over" in roles:
            roles |= {"past"}
        return frozenset(roles)


def replace_items(frame: ClauseFrame, *kinds: ItemKind) -> ClauseFrame:
    """The frame without the items of some kinds."""
    return ClauseFrame(tuple(item for item in frame.items if item.kind not in kinds))


def without_articles(frame: ClauseFrame) -> ClauseFrame:
    """The frame with "a right" as "right"."""
    sides = (ItemKind.SIDE,)
    return ClauseFrame(
        tuple(
            replace(i, roles=()) if i.kind in sides and "a" in i.roles else i for i in frame.items
        )
    )


def distances_of(frame: ClauseFrame) -> Steps:
    """The steps of the distances of a clause."""
    return tuple(Follow(item.value) for item in frame.of(ItemKind.DISTANCE))


def to_end(frame: ClauseFrame) -> Steps:
    """The step of "all the way", if a clause says so."""
    return (Follow(END),) if frame.has(ItemKind.TO_END) else ()


def contexts_of(frame: ClauseFrame) -> tuple[Steps, list[Item]]:
    """The steps of "after ..." and "between ..." and the other nouns of a clause."""
    steps: list[Step] = []
    rest: list[Item] = []
    for item in frame.refs:
        roles = frame.roles(item)
        door = is_door(item.value)
        if item.value.offset is not None:
            if any(is_door(other.value) for other in frame.refs):
                raise NoMeaningError("a door off a place")
            steps.append(Follow(item.value.offset))
            continue
        if "opposite" in roles:
            steps.append(Follow(landmark(item.value)))
            others = [r for r in frame.refs if r is not item and is_door(r.value)]
            if (
                len(others) != 1
                or others[0].value.ordinal not in (None, 1)
                or others[0].value.side not in (None, Side.OPPOSITE)
            ):
                raise NoMeaningError("what is opposite")
            faced = replace(others[0].value, side=Side.OPPOSITE)
            rest = [
                replace(r, value=faced) if r is others[0] else r
                for r in frame.refs
                if r is not item
            ]
            return tuple(steps), rest
        if frame.verbs == {"be"} and door and "after" in roles and len(frame.refs) == 1:
            rest.append(replace(item, roles=("through",)))  # "I am behind the last door"
        elif "between" in roles or (
            "after" in roles and (not door or len(frame.refs) > 1 or "past" not in roles)
        ):
            steps += _passed(item.value, between="between" in roles)
        else:
            rest.append(item)
    if steps and not frame.verbs - {"be"}:  # "it's two doors past the kitchen"
        rest = [replace(item, value=replace(item.value, counted=False)) for item in rest]
    return tuple(steps), rest


def _passed(noun: Noun, *, between: bool = False) -> Steps:
    if noun.kind == "it":
        return ()
    place = landmark(replace(noun, ordinal=1) if between and noun.counted else noun)
    if place == END:
        raise NoMeaningError("past the end")
    return (Follow(place, past=True),)


def check_destinations(steps: Sequence[Step]) -> None:
    """Refuse clauses that lead to two places at once."""
    ends = [isinstance(step, GoToDoor | GoToRoom | IntoDoorway) for step in steps]
    rest = steps[ends.index(True) + 1 :] if True in ends else ()
    if sum(ends) > 1 or any(step != Follow(END) for step in rest):
        raise NoMeaningError("two destinations")


def before_turn(item: Item, frame: ClauseFrame) -> Steps:
    """The steps of a noun that stands before a turn or a door."""
    if item.value.kind == "hall" and item.value.ordinal is None:
        return ()
    return moves(
        item.value,
        frame.roles(item) or frozenset({"at"}) if not is_door(item.value) else frame.roles(item),
        frozenset({"go"}),
    )


def moves_or_mention(noun: Noun, roles: frozenset[str], frame: ClauseFrame) -> Readings:
    """The readings of a noun; a door that is only mentioned has two."""
    try:
        return (moves(noun, roles, frame.verbs - {"turn"}),)
    except MentionError as mention:
        if frame.goes_in:
            return ((GoToDoor(mention.door),),)
        return (GoToDoor(mention.door, Approach.TO),), (GoToDoor(mention.door),)


def goes_around(frame: ClauseFrame) -> bool:
    """Of "Um die Ecke herum": the particle belongs to the noun."""
    return any("around" in item.roles for item in frame.refs) and "turn" not in frame.verbs
