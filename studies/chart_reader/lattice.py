"""The words of a text as a lattice, and all spans of it that the lexicon knows."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

from rapidfuzz.distance import OSA

from semnav_env.language.languages import languages
from semnav_env.language.rooms import spoken_names
from studies.chart_reader.features import Features, features
from studies.chart_reader.lexicon import Lexicon, Node, lexicon_of, spelt_number, words_of

SLIP, COMPOUND, JOINED, BORROWED = 1.2, 0.1, 0.0, 0.5
"""Costs of a corrected word, of a compound, of a word that is written as two, and of a word of
another language."""

INSIDE_NAME, INSIDE_PREPOSITION = 0.8, 0.6
"""Costs of reading words of a name or of a preposition of several words as something else."""

LONG = frozenset(
    [
        "ROOMNAME",
        "NEAR",
        "BEFORE",
        "AFTER",
        "FRONT",
        "UNTIL",
        "PAST",
        "OPPOSITE",
        "OUTOF",
        "BETWEEN",
    ]
)
"""Symbols whose words are kept together."""

MOST_SLIPS = 3.0
"""The most that the corrections of a phrase may cost."""


class Edge(NamedTuple):
    """A span of a text that the lexicon knows.

    Attributes:
        stop: the number of the word behind it.
        symbol: of the grammar.
        features: what it says.
        cost: how unlikely it is.
    """

    stop: int
    symbol: str
    features: Features
    cost: float


class Lattice:
    """All spans of a text.

    Attributes:
        words: of the text.
        edges: by the number of their first word.
        unknown: for each word, whether it is unknown and like no known one.
    """

    def __init__(self, text: str, lexicon: Lexicon, rooms: Sequence[str] = ()) -> None:
        self.words = words_of(text)
        self._lexicon = lexicon
        self._names, self._name_words = _names(tuple(rooms), lexicon.language.code)
        self._arcs = [self._arcs_from(at) for at in range(len(self.words))]
        self._in_set: dict[tuple[str, int], tuple[tuple[int, float], ...]] = {}
        self._found: list[dict[tuple[int, str, Features], float]] = [{} for _ in self.words]
        for at in range(len(self.words)):
            self._spans(at, lexicon.root)
            self._spans(at, self._names)
            self._digits(at)
            if self.words[at].isalpha() and not self._knows(self.words[at]):
                self._borrow(at)
        self._decimals()
        self._favour_long_spans()
        self._favour_conditions()
        self.edges = [
            [Edge(stop, symbol, given, cost) for (stop, symbol, given), cost in found.items()]
            for found in self._found
        ]
        self.unknown = [
            not any(edge.stop == at + 1 for edge in row) for at, row in enumerate(self.edges)
        ]

    def _arcs_from(self, at: int) -> list[tuple[int, tuple[str, ...], float]]:
        """The words that may be meant from a word on: end, words and cost."""
        words, lexicon = self.words, self._lexicon
        word = words[at]
        found: list[tuple[int, tuple[str, ...], float]] = [(at + 1, (word,), 0.0)]
        for size in (1, 2, 3):
            heard = tuple(words[at : at + size])
            for meant, cost in lexicon.alternatives.get(heard, ()) if len(heard) == size else ():
                found.append((at + size, meant, cost))
        if words[at + 1 : at + 2] == ["'s"]:
            found.append((at + 2, (word + "s",), JOINED))
        if not word.isalpha() or word in self._name_words:
            return found
        for name in self._name_words:  # "Kuechentuer"
            rest = word.removeprefix(name) if len(name) > 3 else word
            ends = (end for end in (rest, rest[1:]) if rest != word and end in lexicon.nouns)
            found += [(at + 1, (name, end), COMPOUND) for end in ends]
        if word in lexicon.known:
            return found
        parts = lexicon.parts_of(word)
        found += [(at + 1, each, COMPOUND) for each in parts]
        for name in self._name_words:
            most = 1 + (len(word) > 7)
            if len(word) > 3 and OSA.distance(word, name, score_cutoff=most) <= most:
                found.append((at + 1, (name,), SLIP))
        if not parts and not _is_of_other(word, lexicon):
            found += [(at + 1, (each,), SLIP) for each in lexicon.meant_by(word)]
        return found

    def _spans(self, start: int, root: Node) -> None:
        for stop, node, cost in self._walk(start, root):
            for (symbol, given), own in node.entries.items():
                key = (stop, symbol, given)
                total = cost + own
                if total < self._found[start].get(key, 99.0):
                    self._found[start][key] = total

    def _walk(self, start: int, root: Node) -> list[tuple[int, Node, float]]:
        """All nodes that can be reached from a word: end, node and cost."""
        reached: list[tuple[int, Node, float]] = []
        waiting = [(start, root, 0.0)]
        while waiting:
            at, node, cost = waiting.pop()
            if node.entries and at > start:
                reached.append((at, node, cost))
            if at >= len(self.words) or cost > MOST_SLIPS:
                continue
            if node.words:
                for stop, words, more in self._arcs[at]:
                    following: Node | None = node
                    for word in words:
                        following = following.words.get(word) if following else None
                    if following:
                        waiting.append((stop, following, cost + more))
                if root is self._names and at > start and self.words[at] in ".-":
                    waiting.append((at + 1, node, cost))
            for name, following in node.sets.items():
                for stop, more in self._ends(name, at):
                    waiting.append((stop, following, cost + more))
        return reached

    def _ends(self, name: str, at: int) -> tuple[tuple[int, float], ...]:
        """Ends and costs of the phrases of a set."""
        if (name, at) not in self._in_set:
            self._in_set[name, at] = ()
            best: dict[int, float] = {}
            for stop, _, cost in self._walk(at, self._lexicon.sets[name]):
                best[stop] = min(cost, best.get(stop, 99.0))
            self._in_set[name, at] = tuple(best.items())
        return self._in_set[name, at]

    def _knows(self, word: str) -> bool:
        return word in self._lexicon.known or word in self._name_words

    def _borrow(self, at: int) -> None:
        """The spans of an unknown word in another language."""
        for code in languages():
            if code != self._lexicon.language.code:
                node = lexicon_of(code).root.words.get(self.words[at])
                for (symbol, given), cost in (node.entries if node else {}).items():
                    key = (at + 1, symbol, given)
                    self._found[at][key] = min(cost + BORROWED, self._found[at].get(key, 99.0))

    def _digits(self, at: int) -> None:
        word, found = self.words[at], self._found[at]
        if re.fullmatch(r"\d+(?:[.,]\d+)?", word):
            found[at + 1, "NUM", features({"n": float(word.replace(",", "."))})] = 0.0
        ordinal = re.fullmatch(r"(\d+)(?:st|nd|rd|th)", word)
        if ordinal and 0 < int(ordinal[1]) <= 20:
            found[at + 1, "ORD", features({"ord": int(ordinal[1])})] = 0.0
        if (
            self._lexicon.language.code == "de"
            and word.isdigit()
            and 0 < int(word) <= 20
            and self.words[at + 1 : at + 2] == ["."]
            and at + 2 < len(self.words)
        ):
            found[at + 2, "ORD", features({"ord": int(word)})] = 0.0

    def _decimals(self) -> None:
        """Numbers with a spoken decimal point: "one point five"."""
        for at, found in enumerate(self._found):
            for stop, whole, cost in self._numbers(at):
                points = self._found[stop] if stop < len(self.words) else {}
                for after, symbol, _ in list(points):
                    if symbol == "POINT":
                        for end, part, more in self._numbers(after):
                            value = float(f"{whole:g}.{part:g}") if part == int(part) else whole
                            found[end, "NUM", features({"n": value})] = cost + more

    def _numbers(self, at: int) -> list[tuple[int, float, float]]:
        found = self._found[at].items() if at < len(self.words) else ()
        return [(stop, given[0][1], c) for (stop, s, given), c in found if s == "NUM"]

    def _favour_conditions(self) -> None:
        """What begins with "if" is seldom anything but a condition."""
        for found in self._found:
            if any(symbol == "IF" for _, symbol, _ in found) and not any(
                symbol == "WHEN" for _, symbol, _ in found
            ):
                for key in found:
                    if key[1] in ("AT", "UNTIL", "AFTER", "PAST", "THEN"):
                        found[key] += INSIDE_NAME

    def _favour_long_spans(self) -> None:
        """The words of a room's name or of a long preposition are seldom anything else."""
        for start, found in enumerate(self._found):
            for (stop, symbol, _), cost in list(found.items()):
                more = INSIDE_NAME if symbol == "ROOMNAME" else INSIDE_PREPOSITION
                if symbol not in LONG or cost >= 1.0 or stop < start + 2 - (symbol == "ROOMNAME"):
                    continue
                for at in range(start, stop if symbol == "ROOMNAME" else start + 1):
                    for key in self._found[at]:
                        inside = key[0] <= stop and (at, key[0]) != (start, stop)
                        if inside and key[1] not in ("ROOMNAME", "DET"):
                            self._found[at][key] += more


def _is_of_other(word: str, lexicon: Lexicon) -> bool:
    """Whether another language has a word."""
    others = (code for code in languages() if code != lexicon.language.code)
    return any(word in lexicon_of(code).known for code in others)


@lru_cache(maxsize=64)
def _names(rooms: tuple[str, ...], code: str) -> tuple[Node, frozenset[str]]:
    """The tree of the names of rooms, and their words."""
    root, own = Node(), set[str]()
    spoken = spoken_names(rooms)
    prefix = {"en": ("room",), "de": ("raum", "zimmer")}[code]
    ends = Counter(match[0] for name in spoken.values() if (match := re.search(r"\d+$", name)))
    for said, name in spoken.items():
        end = re.search(r"\d+$", said)
        if end and end[0] != said and ends[end[0]] == 1:
            given = features({"bare": 1, "kind": "room", "name": name})
            root.add([end[0]], "ROOMNAME", given, 2.0)
    for said, name in _spelt(spoken, code):
        forms = {said, name.replace("_", " ")} | {f"{word} {said}" for word in prefix}
        for form in forms:
            words = [word for word in words_of(form) if word not in ".-"]
            bare = said.isdigit() and form == said
            given = features({"kind": "room", "name": name})
            if words:
                root.add(words, "ROOMNAME", given, 1.0 if bare else 0.0)
                own.update(word for word in words if word.isalpha())
    return root, frozenset(own)


def _spelt(names: dict[str, str], code: str) -> list[tuple[str, str]]:
    """Names with their numbers as figures and in words: "room two oh four"."""
    found = list(names.items())
    for said, name in names.items():
        number = re.search(r"\d+$", said)
        if number and len(number[0]) <= 4:
            digits, head = number[0], said[: number.start()]
            ones = [spelt_number(int(digit), code) for digit in digits]
            forms = {" ".join(ones), " ".join("oh" if o == "zero" else o for o in ones)}
            if int(digits) < 1000:
                forms.add(spelt_number(int(digits), code))
            if len(digits) == 3 and code == "en":
                forms.add(f"{ones[0]} {spelt_number(int(digits[1:]), code)}")
            if len(digits) == 3 and code == "de":
                forms.add(f"{ones[0]} {spelt_number(int(digits[1:]), code)}")
            found += [(head + form, name) for form in forms if head.strip()]
            found += [(form, name) for form in forms if not head.strip() and len(digits) > 1]
    return found
