"""The cheapest ways to part a text into bags of slots, with marks between them."""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple, TypeAlias

from studies.chart_reader.chart import Chart
from studies.chart_reader.features import Features, merged
from studies.chart_reader.frames import LIGHT, fitting
from studies.chart_reader.lexicon import table_rows

Entry: TypeAlias = "Features | str"
"""A bag of slots, or a mark."""

WIDTH = 40
"""The most hypotheses at a word."""

JOIN = {"": 0.0, "COMMA": 0.35, "AND": 0.7, "STOP": 1.2, "THEN": 2.5}
"""Costs of going on with a clause behind what parts clauses."""

CLOSE = {"": 1.4, "COMMA": 0.15, "AND": 0.1, "STOP": 0.0, "THEN": 0.0}
"""Costs of beginning a clause there."""

BEFORE_VERB = 0.5
"""Cost of beginning a clause at a verb without anything that parts it."""

MARKS = {
    "NO": ("no", 0.4),
    "NOT": ("not", 0.1),
    "INSTEAD": ("not", 0.1),
    "BUT": ("but", 0.1),
    "OTHERWISE": ("else", 0.0),
    "ANYCASE": ("any", 0.0),
    "OR": ("or", 0.1),
    "FROMTHERE": ("from there", 0.1),
    "BEFORETHAT": ("before", 0.1),
    "AFTERDO": ("before", 0.4),
    "BEFOREDO": ("later", 0.4),
}
"""Symbols that stand between bags, with their mark and cost."""

PROTECTED = frozenset(("ORD", "SIDE", "NUM", "NOT", "NO", "OR", "UNIT", "UNLESS", "ROOMNAME"))
"""Symbols of words that are no filler, though a phrase of fillers may have them."""

FREE = ("HES", "SOFT", "FILL", "GREET", "ASIDE", "HANDOVER")
"""Symbols of phrases that may be left out as a whole."""

NO_FRAME, NO_FRAME_FRAGMENT = 4.0, 2.0
"""Costs of a bag that no frame takes, and of one that may change another bag."""

FRAGMENT = frozenset(
    [
        "num",
        "aft",
        "obj",
        "be",
        "side",
        "at",
        "on",
        "past",
        "to",
        "into",
        "in",
        "within",
        "dist",
        "angle",
        "secs",
        "until",
        "front",
        "frontit",
    ]
)

LONGEST_ASIDE = 8


class Trace(NamedTuple):
    """How a hypothesis was found: the last step's tags and those before it."""

    before: Trace | None
    tags: tuple[str, ...]


class Hypothesis(NamedTuple):
    """Bags and marks that read a whole text, their cost, and how they were found."""

    cost: float
    entries: tuple[Entry, ...]
    trace: Trace | None


@cache
def skip_costs() -> dict[str, float]:
    """What leaving out a word costs, by its symbol."""
    return {symbol: float(cost) for symbol, cost in (r.split() for r in table_rows("skips.txt"))}


def hypotheses(chart: Chart) -> list[Hypothesis]:
    """The ways to read a text, the cheapest first."""
    beam = _Beam(chart)
    for at in range(len(chart.at)):
        beam.extend(at)
    return beam.finished()


class _Beam:
    """Hypotheses by the number of words that they have read."""

    def __init__(self, chart: Chart) -> None:
        self._chart = chart
        self._states: list[dict[tuple[Any, ...], tuple[float, Trace | None]]] = [
            {} for _ in range(len(chart.at) + 1)
        ]
        self._put(0, 0.0, (), (), "STOP", None)

    def _put(
        self,
        at: int,
        cost: float,
        entries: tuple[Entry, ...],
        bag: Features,
        parted: str,
        trace: Trace | None,
    ) -> None:
        key = (entries, bag, parted)
        known = self._states[at].get(key)
        if known is None or cost < known[0]:
            self._states[at][key] = (cost, trace)

    def extend(self, at: int) -> None:
        """Read on from the hypotheses that stand before a word."""
        ranked = sorted(self._states[at].items(), key=lambda pair: pair[1][0])[:WIDTH]
        if not ranked:
            return
        chart, spans = self._chart, self._chart.at[at]
        parts = [(*each, _slot_tags(each[1])) for each in chart.find("C", at)]
        conditions, contexts = chart.find("COND", at), chart.find("CTX", at)
        skips = self._skips(at)
        for (entries, bag, parted), (cost, trace) in ranked:
            closing, closed, tags = _closed(entries, bag)
            for stop, given, more, slots in parts:
                self._join(stop, cost + more, entries, bag, parted, given, slots, trace)
                if bag:
                    verb = given[0][0] == "V"
                    begin = BEFORE_VERB if verb and not parted else CLOSE[parted]
                    how = (f"begin:{parted}{':verb' if verb else ''}", *tags, *slots)
                    self._put(
                        stop, cost + more + closing + begin, closed, given, "", Trace(trace, how)
                    )
            for stop, given, more in conditions:
                total = cost + more + closing + 0.3 * CLOSE[parted]
                how = ("condition", *tags, *_slot_tags(given))
                self._put(stop, total, (*closed, given), (), "COMMA", Trace(trace, how))
            for stop, _, more in contexts:
                self._put(stop, cost + more, entries, bag, "COMMA", Trace(trace, ("context",)))
            for symbol in ("COMMA", "AND", "THEN", "STOP"):
                for stop, _, more in spans.get(symbol, ()):
                    between = max((parted, symbol), key=list(JOIN).index)
                    self._put(stop, cost + more, entries, bag, between, trace)
            for symbol, (mark, own) in MARKS.items():
                for stop, _, more in spans.get(symbol, ()):
                    total = cost + more + closing + own
                    how = (f"mark:{mark}", *tags)
                    self._put(stop, total, (*closed, mark), (), "STOP", Trace(trace, how))
            for stop, more, name in skips:
                self._put(stop, cost + more, entries, bag, parted, Trace(trace, (f"skip:{name}",)))
            if parted in ("COMMA", "STOP", "THEN"):
                self._aside(at, cost, entries, bag, parted, trace)

    def _join(
        self,
        stop: int,
        cost: float,
        entries: tuple[Entry, ...],
        bag: Features,
        parted: str,
        given: Features,
        slots: tuple[str, ...],
        trace: Trace | None,
    ) -> None:
        """Put a constituent into the bag."""
        names = {name for name, _ in bag}
        if (names & {name for name, _ in given}) - LIGHT:
            return
        if entries and entries[-1] == "not" and bag and parted:
            return
        both = merged(bag, given)
        if both is not None:
            both = _without_light(both)
            how = (f"join:{parted}", *slots) if bag else slots
            self._put(
                stop, cost + (JOIN[parted] if bag else 0.0), entries, both, "", Trace(trace, how)
            )

    def _skips(self, at: int) -> list[tuple[int, float, str]]:
        """Ways to leave out words: end, cost and name."""
        spans, costs = self._chart.at[at], skip_costs()
        single = {
            s for s, row in spans.items() if any(stop == at + 1 and c <= 0.5 for stop, _, c in row)
        }
        found = [
            (stop, costs[symbol] + cost + self._hidden(at, stop), symbol)
            for symbol in FREE
            for stop, _, cost in spans.get(symbol, ())
        ]
        if single & {"COMMA", "STOP"}:
            return found
        heavy = max(
            ((costs.get(symbol, costs["other"]), symbol) for symbol in single - set(FREE)),
            default=None,
        )
        if heavy is None and not single:
            heavy = (costs["unknown"], "unknown")
        if heavy is not None:
            found.append((at + 1, heavy[0], heavy[1]))
        return found

    def _hidden(self, start: int, stop: int) -> float:
        """What fillers hide: words that are more than fillers."""
        costs = skip_costs()
        if stop > start + 1:
            return 0.0
        hidden = {s: 0.3 * costs[s] for s in self._chart.at[start] if s in PROTECTED}
        if "V" in self._chart.at[start]:
            hidden["V"] = 0.4
        return max(hidden.values(), default=0.0)

    def _aside(
        self,
        at: int,
        cost: float,
        entries: tuple[Entry, ...],
        bag: Features,
        parted: str,
        trace: Trace | None,
    ) -> None:
        """Leave out a remark up to the next comma or full stop."""
        for start, _, _ in self._chart.at[at].get("ASIDE", ()):
            stop = start
            while (
                stop < len(self._chart.at) and not {"COMMA", "STOP"} & self._chart.at[stop].keys()
            ):
                stop += 1
            inside = {symbol for spans in self._chart.at[start:stop] for symbol in spans}
            if stop - start <= LONGEST_ASIDE and not inside & (PROTECTED | {"NDOOR", "NPLACE"}):
                total = cost + 1.6 + 0.25 * (stop - start)
                self._put(stop, total, entries, bag, parted, Trace(trace, ("aside",)))

    def finished(self) -> list[Hypothesis]:
        """The hypotheses that have read all words."""
        found: dict[tuple[Entry, ...], tuple[float, Trace | None]] = {}
        for (entries, bag, _), (cost, trace) in self._states[-1].items():
            closing, closed, tags = _closed(entries, bag)
            if closed and cost + closing < found.get(closed, (99.0, None))[0]:
                found[closed] = (cost + closing, Trace(trace, tags))
        ranked = sorted(found.items(), key=lambda pair: pair[1][0])
        return [Hypothesis(cost, entries, trace) for entries, (cost, trace) in ranked]


STRAIGHT_MATTERS = frozenset(("at.place", "into.place", "uturn", "back"))
"""Slots beside which "straight" says something."""


def _without_light(bag: Features) -> Features:
    """A bag without slots that say nothing beside its others."""
    names = {name for name, _ in bag}
    content = names - LIGHT - {"V"}
    if content:
        useless = {"here", "it", "sameside"}
        if content != {"side"}:
            useless.add("along")
            if not content & STRAIGHT_MATTERS:
                useless.add("str")
    else:
        useless = {"along"} if "str" in names else set()
    return tuple(pair for pair in bag if pair[0] not in useless) if useless & names else bag


def _closed(
    entries: tuple[Entry, ...], bag: Features
) -> tuple[float, tuple[Entry, ...], tuple[str, ...]]:
    """Cost, entries and tags if the bag is complete."""
    if not bag:
        return 0.0, entries, ()
    found = fitting(bag)
    if entries and entries[-1] == "not":
        return (found[0][0] if found else 0.2), (*entries, bag), ("denied",)
    if found:
        return found[0][0], (*entries, bag), ()
    names = {name.partition(".")[0] for name, _ in bag}
    if names & FRAGMENT:
        return NO_FRAME_FRAGMENT, (*entries, bag), ("fragment",)
    return NO_FRAME, (*entries, bag), ("no frame",)


NOUN_TAGS = frozenset(
    [
        "ell",
        "bare",
        "after",
        "atend",
        "before",
        "near",
        "opposite",
        "count",
        "afterit",
        "side",
        "ord",
        "came",
        "sameside",
        "fromend",
        "doorway",
        "room",
        "numbered",
        "door",
        "nxt",
        "wall",
    ]
)


def _slot_tags(given: Features) -> tuple[str, ...]:
    """What a constituent is, for the ranker."""
    tags = []
    for name, value in given:
        tags.append(f"S:{name}:{value}" if name == "V" else f"S:{name}")
        if isinstance(value, tuple):
            own = {inner.partition(".")[0] for inner, _ in value}
            tags += [f"N:{inner}" for inner in sorted(own & NOUN_TAGS)]
    return tuple(tags)


def tags_of(trace: Trace | None) -> dict[str, float]:
    """How often each tag stands in a trace."""
    found: dict[str, float] = {}
    while trace is not None:
        for tag in trace.tags:
            found[tag] = found.get(tag, 0.0) + 1.0
        trace = trace.before
    return found
