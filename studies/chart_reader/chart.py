"""Constituents of a text: a memoised chart over its lattice, with the rows of a grammar.

A row of a grammar is `SYMBOL = pattern | slot | cost | features`. The pattern has symbols, each
with alternatives (`A/B`) and a sign for how often it may stand (`?`, `*`, `+`). The features of the
parts are put together. A `!` in front of a symbol drops its features. If a slot is named, they are
nested: `slot = (...)`, or `slot.kind` if they have a kind.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Set
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

from studies.chart_reader.features import Features, merged, read_features
from studies.chart_reader.lattice import Lattice
from studies.chart_reader.lexicon import table_rows

MOST_COST = 8.0
"""The most that a constituent may cost."""

NOTHING: frozenset[str] = frozenset()

SKIPPED = {"HES": 0.0, "SOFT": 0.1, "FILL": 0.15}
"""Costs of words that may be left out within a constituent."""


@dataclass(frozen=True, eq=False)
class PatternItem:
    """A part of a pattern: its alternatives, and how often it may stand."""

    symbols: tuple[str, ...]
    may_lack: bool
    may_repeat: bool


@dataclass(frozen=True, eq=False)
class GrammarRow:
    """A row of a grammar; see the module."""

    items: tuple[PatternItem, ...]
    slot: str
    cost: float
    given: Features
    first: frozenset[str] = frozenset()


@dataclass(frozen=True, eq=False)
class Grammar:
    """The rows of a grammar by their symbols, and the words' symbols with which each can begin."""

    rows: dict[str, tuple[GrammarRow, ...]]
    first: dict[str, frozenset[str]]


@cache
def grammar_of(language: str) -> Grammar:
    """The rows by their symbols: those of all languages and those of one, by its name."""
    found: defaultdict[str, list[GrammarRow]] = defaultdict(list)
    for line in (*table_rows("grammar.txt"), *table_rows(f"{language}.txt")):
        symbol, row = line.split(" = ", 1)
        parts = [part.strip() for part in row.split("|")] + [""] * 3
        items = tuple(_item(word) for word in parts[0].split())
        found[symbol].append(
            GrammarRow(items, parts[1], float(parts[2] or 0), read_features(parts[3]))
        )
    first = _first_symbols(found)
    rows = {
        symbol: tuple(replace(row, first=_firsts(row, first)) for row in each)
        for symbol, each in found.items()
    }
    return Grammar(rows, {symbol: frozenset(each) for symbol, each in first.items()})


def _first_symbols(rows: dict[str, list[GrammarRow]]) -> dict[str, set[str]]:
    """The symbols of words with which each symbol can begin."""
    first: dict[str, set[str]] = {symbol: {symbol} for symbol in rows}
    size = -1
    while size != (size := sum(map(len, first.values()))):
        for symbol, each in rows.items():
            for row in each:
                first[symbol] |= _firsts(row, first)
    return first


def _firsts(row: GrammarRow, first: Mapping[str, Set[str]]) -> frozenset[str]:
    found: set[str] = set()
    for item in row.items:
        for symbol in item.symbols:
            plain = symbol.lstrip("!")
            found |= first.get(plain, {plain})
        if not item.may_lack:
            break
    return frozenset(found)


def _item(word: str) -> PatternItem:
    sign = word[-1] if word[-1] in "?*+" else ""
    symbols = tuple(word.rstrip("?*+").split("/"))
    return PatternItem(symbols, sign in ("?", "*"), sign in ("*", "+"))


class Chart:
    """The constituents of a text, found when they are asked for.

    Attributes:
        lattice: of the text.
        at: for each word its spans by their symbols: end, features, cost.
    """

    def __init__(self, lattice: Lattice, grammar: Grammar) -> None:
        self.lattice = lattice
        self._grammar = grammar
        self.at: list[dict[str, list[tuple[int, Features, float]]]] = []
        for row in lattice.edges:
            spans: defaultdict[str, list[tuple[int, Features, float]]] = defaultdict(list)
            for stop, symbol, given, cost in row:
                spans[symbol].append((stop, given, cost))
            self.at.append(dict(spans))
        self._symbols = [frozenset(spans) for spans in self.at]
        self._skips = [
            [(stop, cost + SKIPPED[s]) for s in SKIPPED for stop, _, cost in spans.get(s, ())]
            for spans in self.at
        ]
        self._found: dict[tuple[str, int], tuple[tuple[int, Features, float], ...]] = {}
        self._tails: dict[tuple[Any, ...], dict[tuple[int, Features], float]] = {}

    def find(self, symbol: str, start: int) -> tuple[tuple[int, Features, float], ...]:
        """End, features and cost of each constituent of a symbol that begins at a word."""
        if start >= len(self.at):
            return ()
        key = (symbol, start)
        known = self._found.get(key)
        if known is not None:
            return known
        if symbol[0] == "!":
            best: dict[tuple[int, Features], float] = {}
            for stop, _, cost in self.find(symbol[1:], start):
                best[stop, ()] = min(cost, best.get((stop, ()), 99.0))
        elif symbol in self._grammar.rows:
            self._found[key] = ()  # no constituent begins with itself
            best = self._constituents(symbol, start)
            for stop, given, cost in self.at[start].get(symbol, ()):
                best[stop, given] = min(cost, best.get((stop, given), 99.0))
        else:
            best = {(stop, given): cost for stop, given, cost in self.at[start].get(symbol, ())}
        found = tuple((stop, given, cost) for (stop, given), cost in best.items())
        self._found[key] = found
        return found

    def _constituents(self, symbol: str, start: int) -> dict[tuple[int, Features], float]:
        best: dict[tuple[int, Features], float] = {}
        for row in self._grammar.rows[symbol]:
            if row.first.isdisjoint(self._symbols[start]):
                continue
            for (stop, parts), cost in self._match(row, 0, start, False).items():
                if stop == start:
                    continue
                given = merged(_in_slot(parts, row.slot), row.given)
                total = cost + row.cost
                if given is not None and total < best.get((stop, given), MOST_COST):
                    best[stop, given] = total
        return best

    def _match(
        self, row: GrammarRow, index: int, start: int, again: bool
    ) -> dict[tuple[int, Features], float]:
        """Ends and features of a pattern from an item on; again: that item stands already."""
        if index == len(row.items):
            return {(start, ()): 0.0}
        key = (row, index, start, again)
        if key in self._tails:
            return self._tails[key]
        item = row.items[index]
        best: dict[tuple[int, Features], float] = {}
        if item.may_lack or again:
            best.update(self._match(row, index + 1, start, False))
        for middle, first, cost in self._first(item, start):
            following = index if item.may_repeat else index + 1
            for (stop, rest), more in self._match(row, following, middle, item.may_repeat).items():
                both = merged(first, rest)
                if both is not None and cost + more < best.get((stop, both), MOST_COST):
                    best[stop, both] = cost + more
        if (index or again) and start < len(self.at):
            for middle, cost in self._skips[start]:
                for (stop, rest), more in self._match(row, index, middle, again).items():
                    if stop > middle and cost + more < best.get((stop, rest), MOST_COST):
                        best[stop, rest] = cost + more
        self._tails[key] = best
        return best

    def _first(self, item: PatternItem, start: int) -> Iterator[tuple[int, Features, float]]:
        if start >= len(self.at):
            return
        here, first = self._symbols[start], self._grammar.first
        for symbol in item.symbols:
            if symbol in here or not here.isdisjoint(
                first.get(symbol.lstrip("!"), NOTHING | {symbol.lstrip("!")})
            ):
                yield from self.find(symbol, start)


def _in_slot(parts: Features, slot: str) -> Features:
    if not slot:
        return parts
    kind = dict(parts).get("kind")
    return ((f"{slot}.{kind}" if kind else slot, parts),)
