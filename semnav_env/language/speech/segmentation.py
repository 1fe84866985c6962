"""Finds the clauses of a text, with or without punctuation: the cheapest way to part its items."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from semnav_env.language.clause_readings import (
    ClauseReadings,
    Readings,
)
from semnav_env.language.command import MAX_CLAUSES
from semnav_env.language.speech.clause_items import (
    PREFIXES,
    correcting,
    is_only_noun,
    on_premise,
    otherwise_of,
    read_clause,
)
from semnav_env.language.speech.items import JOINTS, Item, ItemKind
from semnav_env.language.speech.moves import NoMeaningError

MAX_ITEMS_OF_CLAUSE = 14
"""The most items of a clause."""

CLAUSE_COST, UNJOINED_COST, VERB_JOINT_COST = 0.3, 0.5, 0.1
"""Costs of a clause; of its not being parted from that before; and of that if a verb begins it."""

CLOSE = 0.2
"""Two ways to part a text are about equally good if their costs differ by no more than this."""

MAX_PARTS = 2 * MAX_CLAUSES
"""The most parts into which a text is parted; more are no command."""

WAYS = 3
"""Ways to part the beginning of a text that are kept for each place in it."""


MAX_SKIPPED = 3.0
"""The highest cost of what is left out of a text; with more it is rather no command."""

SKIPPED = {
    **{ItemKind.UNKNOWN: 1.0, ItemKind.PARTICLE: 0.6, ItemKind.HERE: 0.3, ItemKind.BUT: 0.3},
    **{ItemKind.BEFORE_IT: 1.5, ItemKind.IN: 1.0, ItemKind.STRAIGHT: 0.8, ItemKind.FROM_THERE: 1.0},
}
"""Costs of leaving out items that say little, by their kind."""


def cost_of_skipping(item: Item) -> float | None:
    """The cost of leaving out an item; None if it says too much to be left out."""
    if item.kind is ItemKind.VERB:
        return 0.8 if item.value in ("go", "reach", "find", "continue") else None
    if item.kind is ItemKind.REF:
        return 1.0 if item.value.kind in ("it", "hall") else None
    return SKIPPED.get(item.kind)


@dataclass(frozen=True)
class Parting:
    """A way to part the beginning of a text into clauses.

    Attributes:
        cost: the lower the better.
        clauses: with their readings.
    """

    cost: float
    clauses: tuple[ClauseReadings, ...]


class ClauseSegmentation:
    """Parts items into clauses.

    Args:
        items: of a text.
        loose: items that say little may be left out; what is left is to be asked about.

    Attributes:
        items: of a text.
        problem: why no robot can do what a clause says, if that is why it has no reading.
        reached: the item up to which the text could be parted.
    """

    def __init__(self, items: Sequence[Item], loose: bool = False) -> None:
        self.items = tuple(items)
        self._loose = loose
        self.problem: tuple[str, int, int] | None = None
        self.reached = 0
        self._ways: list[list[Parting]] = []
        self._readings: dict[tuple[int, int], tuple[Readings, float, bool, bool] | None] = {}

    def best(self) -> list[Parting]:
        """The cheapest partings of all items, the best first; none if there is no way."""
        ways = self._ways = [[] for _ in range(len(self.items) + 1)]
        ways[0] = [Parting(0.0, ())]
        for start in range(len(self.items)):
            if not ways[start]:
                continue
            self.reached = max(self.reached, start)
            if self._loose:
                self._skip(ways, start)
            begin = self._behind_joints(start)
            if begin == len(self.items):
                self._add(ways[begin], ways[start], None)
            for stop in range(begin + 1, min(len(self.items), begin + MAX_ITEMS_OF_CLAUSE) + 1):
                found = self._clause(begin, stop)
                if start == begin > 0 and self._belongs_before(begin, stop):
                    continue
                if found is not None:
                    self.reached = max(self.reached, stop)
                    self._add(ways[stop], ways[start], self._priced(found, start, begin, stop))
        return ways[-1]

    def _skip(self, ways: list[list[Parting]], start: int) -> None:
        """Leave out an item that says little, at a cost."""
        cost = cost_of_skipping(self.items[start])
        if cost is not None:
            for way in ways[start]:
                if way.cost + cost <= MAX_SKIPPED + CLAUSE_COST * len(way.clauses):
                    self._add(ways[start + 1], [way], Parting(cost, ()))

    def beginnings(self) -> Iterator[Parting]:
        """The best parting of each beginning of the items, the longest first."""
        return (ways[0] for ways in reversed(self._ways) if ways and ways[0].clauses)

    def _belongs_before(self, begin: int, stop: int) -> bool:
        """Whether a clause that nothing parts from the one before can be none of its own."""
        before, items = self.items[begin - 1], self.items[begin:stop]
        bare = all(item.kind in (ItemKind.SIDE, ItemKind.STRAIGHT) for item in items)
        straight = items[0].kind is ItemKind.STRAIGHT and before.kind is ItemKind.REF
        if _is_time(items):
            stops = before.kind is ItemKind.VERB and {"stop", "wait"} & set(before.value.split())
            return not stops  # "drive for 5 minutes" does not say to wait
        only_noun = is_only_noun(items) and not _is_turn_noun(items[0])
        return only_noun or straight or (bare and before.kind is not ItemKind.OUT)

    def _behind_joints(self, at: int) -> int:
        while at < len(self.items) and self._is_joint(at):
            at += 1
        return at

    def _is_joint(self, at: int) -> bool:
        """Whether an item says nothing at the beginning of a clause; "da hinfahren" is one."""
        if self.items[at].kind is ItemKind.HERE:
            return self.items[at + 1 : at + 2] == () or not _is_bare_go(self.items[at + 1])
        return self.items[at].kind in (*JOINTS, ItemKind.BUT, ItemKind.COULD_YOU)

    def _priced(
        self, found: tuple[Readings, float, bool, bool], start: int, begin: int, stop: int
    ) -> Parting:
        readings, cost, anew, in_any_case = found
        if start == begin and begin > 0:
            starts = self.items[begin].kind in (ItemKind.VERB, ItemKind.IN, *PREFIXES)
            cost += VERB_JOINT_COST if starts else UNJOINED_COST
        clause = ClauseReadings(
            readings, self.items[begin].start, self.items[stop - 1].stop, anew, in_any_case
        )
        return Parting(cost + CLAUSE_COST, (clause,))

    @staticmethod
    def _add(there: list[Parting], here: list[Parting], clause: Parting | None) -> None:
        for way in here:
            if len(way.clauses) == MAX_PARTS:
                continue
            more = clause or Parting(0.0, ())
            there.append(Parting(way.cost + more.cost, (*way.clauses, *more.clauses)))
        there.sort(key=lambda way: way.cost)
        kept: dict[tuple[Readings, ...], Parting] = {}
        for way in there:
            kept.setdefault(tuple(each.readings for each in way.clauses), way)
        there[:] = list(kept.values())[:WAYS]

    def _clause(self, start: int, stop: int) -> tuple[Readings, float, bool, bool] | None:
        key = start, stop
        if key not in self._readings:
            self._readings[key] = self._read(start, stop)
        return self._readings[key]

    def _read(self, start: int, stop: int) -> tuple[Readings, float, bool, bool] | None:
        """Readings, cost and adverbs of the clause between two items; None if there is none."""
        items = list(self.items[start:stop])
        anew = in_any_case = otherwise = corrects = False
        while items and items[0].kind in PREFIXES:
            prefix = items.pop(0).kind
            anew = anew or prefix is ItemKind.FROM_THERE
            in_any_case = in_any_case or prefix is ItemKind.IN_ANY_CASE
            otherwise = otherwise or prefix is ItemKind.OTHERWISE
            corrects = corrects or prefix is ItemKind.NO
            while items and items[0].kind in JOINTS:
                items.pop(0)
        try:
            found = self._conditional(items)
            if found is None:
                return None
            readings, cost = found
            if otherwise:
                readings = otherwise_of(readings)
            if corrects:
                readings = correcting(readings)
        except NoMeaningError:
            return None
        except ValueError as error:
            self.problem = self.problem or (str(error), items[0].start, items[-1].stop)
            return None
        return readings, cost, anew, in_any_case

    def _conditional(self, items: list[Item]) -> tuple[Readings, float] | None:
        """A clause with a condition before or behind it, or without one."""
        if items and items[0].kind is ItemKind.IF:
            rest = items[1:]
            while rest and rest[0].kind in JOINTS:
                rest.pop(0)
            inner = read_clause(rest)
            if inner is None:
                return None
            return on_premise(items[0].value, inner[0]), inner[1]
        if items and items[-1].kind is ItemKind.IF:
            rest = items[:-1]
            while rest and rest[-1].kind in JOINTS:
                rest.pop()
            inner = read_clause(rest)
            if inner is None:
                return None
            if items[-1].value.noun is None and items[-1].value.state == "closed":
                return None
            return on_premise(items[-1].value, inner[0]), inner[1]
        return read_clause(items)


def _is_time(items: Sequence[Item]) -> bool:
    """Whether a clause only says how long, or in which time."""
    kinds = {item.kind for item in items}
    return ItemKind.SECONDS in kinds <= {ItemKind.SECONDS, ItemKind.PARTICLE, ItemKind.IN}


def _is_turn_noun(item: Item) -> bool:
    """Of "First crossing left, next one right": a place with a side says to turn."""
    is_noun = item.kind is ItemKind.REF and item.value.kind in ("intersection", "corner")
    return is_noun and item.value.side is not None


def _is_bare_go(item: Item) -> bool:
    return item.kind is ItemKind.VERB and item.value == "go"


def close(partings: Sequence[Parting]) -> Iterator[Parting]:
    """The best parting and those that are about as good."""
    return (way for way in partings if way.cost <= partings[0].cost + CLOSE)
