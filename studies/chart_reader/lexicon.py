"""The phrases of a language with the symbols and features that they may have."""

from __future__ import annotations

import json
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from functools import cache
from importlib.resources import files
from itertools import product
from pathlib import Path
from typing import Any

from rapidfuzz.distance import OSA
from rapidfuzz.process import extract

from semnav_env.language.language import Language
from semnav_env.language.languages import languages
from studies.chart_reader.features import Features, features, read_features

TABLES = Path(__file__).parent / "tables"

_WORD = re.compile(
    r"\d+(?:[.,]\d+)+|\d+(?:st|nd|rd|th)\b|<\w+>|[^\W\d_<>]+(?:'(?!s\b)[^\W\d_]+)*|'s\b|'n\b|\d+|[^\s\"'()_]"
)
_SET = re.compile(r"<\w+>")
_FOLDED = {"’": "'", "‘": "'", "ä": "ae", "ö": "oe", "ü": "ue", "ß": "ss", "“": '"', "„": '"'}

NOUNS = {"NDOOR", "NHALL", "NPLACE", "NTURN", "NEND", "NWALL", "NSTART"}
"""Symbols of nouns that may be the last part of a compound."""

NEVER_MEANT = {"HES", "FILL", "SOFT", "ASIDE", "GREET", "HANDOVER", "BEYOND", "FINITE", "NAREA"}
"""Symbols of words to which no misspelt word is corrected."""

MAX_COMPOUND_NUMBER = 360


def words_of(text: str) -> list[str]:
    """The words, numbers and signs of a text, in small letters without accents."""
    folded = "".join(_FOLDED.get(letter, letter) for letter in text.casefold())
    return _WORD.findall(re.sub(r"(?<=[a-z])-(?=[a-z])", " ", folded))


class Node:
    """A node of the tree of phrases.

    Attributes:
        words: the nodes behind each word.
        sets: the nodes behind each set of phrases ("<when>").
        entries: symbol, features and cost of the phrases that end here.
    """

    __slots__ = ("entries", "sets", "words")

    def __init__(self) -> None:
        self.words: dict[str, Node] = {}
        self.sets: dict[str, Node] = {}
        self.entries: dict[tuple[str, Features], float] = {}

    def add(self, phrase: Iterable[str], symbol: str, given: Features, cost: float = 0.0) -> None:
        """Put a phrase into the tree that begins here."""
        node = self
        for word in phrase:
            children = node.sets if word.startswith("<") and len(word) > 1 else node.words
            node = children.setdefault(word, Node())
        node.entries[symbol, given] = min(cost, node.entries.get((symbol, given), cost))


class Lexicon:
    """The phrases of a language.

    Attributes:
        root: of the tree of all phrases.
        sets: the root of the phrases of each set.
        known: all words.
        meant: the words to which a misspelt one may be corrected.
        alternatives: words that may stand for others, with their cost.
    """

    def __init__(self, language: Language) -> None:
        self.language = language
        self.root = Node()
        self.sets: defaultdict[str, Node] = defaultdict(Node)
        self.known: set[str] = set()
        self.meant: set[str] = set()
        self.alternatives: defaultdict[tuple[str, ...], list[tuple[tuple[str, ...], float]]]
        self.alternatives = defaultdict(list)
        self._parts: dict[str, dict[str, tuple[str, ...]]] = {}
        self._read_phrases()
        self._read_numbers()
        self._read_own()
        numbers = {w for w, node in self.root.words.items() if _has(node, "NUM")}
        self.meant -= numbers  # a number is never made up
        self._spelt: dict[str, tuple[str, ...]] = {}

    def meant_by(self, word: str) -> tuple[str, ...]:
        """The known words that an unknown one may be a slip of."""
        if word not in self._spelt:
            most = 0 if len(word) < 3 else 1 if len(word) < 7 else 2
            found = (
                extract(word, self.meant, scorer=OSA.distance, score_cutoff=most, limit=6)
                if most
                else ()
            )
            self._spelt[word] = tuple(
                each for each, slips, _ in found if slips == min(s for _, s, _ in found)
            )
        return self._spelt[word]

    def parts_of(self, word: str) -> tuple[tuple[str, ...], ...]:
        """The known words of which an unknown compound is made."""
        found: list[tuple[str, ...]] = []
        for first in self._prefixes["separable"]:
            rest = word.removeprefix(first)
            if rest != word:
                verbs = (verb for verb in (rest, rest.removeprefix("zu")) if verb in self._verbs)
                found += [(verb, first) for verb in verbs]
        for first in self._prefixes["compound"]:
            rest = word.removeprefix(first)
            if rest != word and rest in self.nouns:
                found.append((rest,))
        return tuple(found)

    def _read_phrases(self) -> None:
        file = files("semnav_env.language.speech") / f"{self.language.name}.json"
        table: dict[str, str] = json.loads(file.read_text("utf-8"))
        self._macros = {key: row.split("|") for key, row in table.items() if key.startswith("<")}
        self._prefixes = {
            key: sorted(map(_plain, table.get(key, "").split("|")), key=len, reverse=True)
            for key in ("separable", "compound")
        }
        for name, row in self._macros.items():
            for phrase in row:
                for words in self._spelt_out(phrase):
                    self.sets[_plain(name)].add(words, "", ())
                    self.known.update(words)
                    self.meant.update(w for w in words if len(w) > 3 and w.isalpha())
        for line in table_rows("classes.txt"):
            name, symbol = line.split(" = ")
            symbol, _, given = symbol.partition(" ")
            for phrase in filter(None, table.get(name, "").split("|")):
                self.add(phrase, symbol, read_features(given))
        self._verbs = {w for w, node in self.root.words.items() if _has(node, "V")}
        self.nouns = {w for w, node in self.root.words.items() if _is_noun(node)}

    def _read_numbers(self) -> None:
        for n, row in enumerate(self.language.ordinals, 1):
            for phrase in row:
                given = {"ord": n} | ({"nxt": 1} if phrase[:2] in ("ne", "nä") else {})
                self.add(phrase, "ORD", features(given))
        for n, row in enumerate(self.language.from_end, 1):
            for phrase in row:
                self.add(phrase, "ORD", features({"ord": -n}))
        for phrase, value in self.language.numbers.items():
            if not phrase.startswith(("first ", "next ", "ersten ", "naechsten ")):
                self.add(phrase, "NUM", features({"n": value}))
        for phrase, n in spoken_numbers(self.language.code):
            self.add(phrase, "NUM", features({"n": n}))

    def _read_own(self) -> None:
        for line in table_rows(f"{self.language.name}_words.txt"):
            if line.startswith("~"):
                heard, meant, cost = (part.strip() for part in line[1:].split(">"))
                for each in heard.split("|"):
                    self.alternatives[tuple(words_of(each))].append(
                        (tuple(words_of(meant)), float(cost))
                    )
                continue
            symbol, row = line.split(" = ", 1)
            symbol, _, given = symbol.partition(" ")
            if symbol.startswith("-"):
                for phrase in row.split("|"):
                    self._remove(phrase, symbol[1:])
                continue
            for phrase in row.split("|"):
                self.add(phrase, symbol, read_features(given))

    def add(self, phrase: str, symbol: str, given: Features) -> None:
        """Add a phrase with the symbol and features that it may have."""
        for words in self._spelt_out(phrase):
            self.root.add(words, symbol, given)
            self.known.update(words)
            if symbol not in NEVER_MEANT:
                self.meant.update(w for w in words if len(w) > 2 and w.isalpha())

    def _remove(self, phrase: str, symbol: str) -> None:
        for words in self._spelt_out(phrase):
            node: Any = self.root
            for word in words:
                node = node and (node.sets if word.startswith("<") else node.words).get(word)
            if node:
                for key in [key for key in node.entries if key[0] == symbol]:
                    del node.entries[key]

    def _spelt_out(self, phrase: str) -> Iterator[list[str]]:
        """The words of a phrase; a set that is part of a word is spelt out."""
        words = [self._forms(word) for word in phrase.split()]
        for form in product(*words):
            yield [word for part in form for word in words_of(part)]

    def _forms(self, word: str) -> list[str]:
        found = _SET.search(word)
        if found is None or found.group() == word:
            return [word]
        rest = (word[: found.start()], word[found.end() :])
        return [
            form
            for each in self._members(found.group())
            for form in self._forms(f"{rest[0]}{each}{rest[1]}")
        ]

    def _members(self, name: str) -> list[str]:
        return [form for each in self._macros[name] for form in self._forms_of_set(each)]

    def _forms_of_set(self, text: str) -> list[str]:
        found = _SET.search(text)
        if found is None:
            return [text]
        return [
            form
            for each in self._members(found.group())
            for form in self._forms_of_set(text[: found.start()] + each + text[found.end() :])
        ]


def _has(node: Node, symbol: str) -> bool:
    return any(each == symbol for each, _ in node.entries)


def _is_noun(node: Node) -> bool:
    return any(symbol in NOUNS for symbol, _ in node.entries)


def _plain(text: str) -> str:
    return " ".join(words_of(text))


def table_rows(name: str) -> Iterator[str]:
    """The lines of a table without empty ones and comments."""
    lines = (line.strip() for line in (TABLES / name).read_text("utf-8").splitlines())
    return (line for line in lines if line and not line.startswith("#"))


_ONES = {
    "en": "zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen "
    "fifteen sixteen seventeen eighteen nineteen",
    "de": "null ein zwei drei vier fünf sechs sieben acht neun zehn elf zwölf dreizehn vierzehn "
    "fünfzehn sechzehn siebzehn achtzehn neunzehn",
}
_TENS = {
    "en": "_ ten twenty thirty forty fifty sixty seventy eighty ninety",
    "de": "_ zehn zwanzig dreißig vierzig fünfzig sechzig siebzig achtzig neunzig",
}


def spelt_number(n: int, code: str) -> str:
    """A whole number below 1000 in words."""
    ones, tens = _ONES[code].split(), _TENS[code].split()
    if n >= 100:
        rest = spelt_number(n % 100, code) if n % 100 else ""
        hundred = " hundred " if code == "en" else "hundert"
        return (ones[n // 100] + hundred + rest).strip()
    if n < 20:
        return "eins" if code == "de" and n == 1 else ones[n]
    if n % 10 == 0:
        return tens[n // 10]
    return (
        f"{tens[n // 10]} {ones[n % 10]}" if code == "en" else f"{ones[n % 10]}und{tens[n // 10]}"
    )


def spoken_numbers(code: str) -> Iterator[tuple[str, int]]:
    """All numbers up to a full turn in words."""
    for n in range(1, MAX_COMPOUND_NUMBER + 1):
        yield spelt_number(n, code), n
        if code == "en" and n > 100 and n % 100:
            yield spelt_number(n, code).replace("hundred ", "hundred and "), n
        if code == "de" and 100 <= n < 200:
            yield spelt_number(n, code).removeprefix("ein"), n


@cache
def lexicon_of(code: str) -> Lexicon:
    """The lexicon of a language, read at the first call."""
    return Lexicon(languages()[code])
