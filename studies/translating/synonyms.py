"""Says a text with other phrases of the same class, so that the network meets more words."""

from __future__ import annotations

import json
import re
from functools import cache
from importlib.resources import files

import numpy as np

from semnav_env.language.language import Language
from semnav_env.language.languages import english, language_of
from semnav_env.language.normalise import normalise
from semnav_env.language.vocabulary.lexicon import Lexicon, lexicon_of
from semnav_env.language.words import pieces

SWAPPED = frozenset(
    {
        *("verb go", "verb continue", "verb follow", "verb pass", "verb cross", "verb turn"),
        *("verb take", "verb enter", "verb find", "verb leave", "verb exit", "verb return"),
        *("verb stop", "verb wait", "verb face", "verb wall", "around alone", "straight", "to end"),
        *("noun hall", "noun door", "noun doorway", "noun turning", "noun intersection"),
        *("noun corner", "noun t_junction", "noun end", "noun wall", "noun start", "end until"),
        *("prep to", "prep into", "prep past", "prep after", "prep until", "prep at", "prep along"),
        *("could you", "filler", "otherwise", "from there", "is open", "is closed", "be", "no"),
        *("adj next", "adj last", "adj nearest", "where ahead", "where behind", "back"),
    }
)
"""Classes of which a phrase may stand for another one."""

SHARE = 0.25
"""Share of the phrases that are swapped."""

_SET = re.compile(r"<[^>]+>")
_SIDED = re.compile(r"left|right|link|recht")
"""Phrases with a side are not drawn, as texts are mirrored."""


@cache
def _table(name: str) -> dict[str, list[str]]:
    text = (files("semnav_env.language.vocabulary") / f"{name}.json").read_text("utf-8")
    return {key: row.split("|") for key, row in json.loads(text).items()}


def _drawn(phrase: str, table: dict[str, list[str]], rng: np.random.Generator) -> str:
    """A phrase with its sets filled at random."""
    while found := _SET.search(phrase):
        row = table[found[0]]
        phrase = phrase.replace(found[0], row[int(rng.integers(len(row)))], 1)
    return phrase


def drawn_phrase(kind: str, code: str, rng: np.random.Generator) -> str:
    """A phrase of a class in a language."""
    table = _table(language_of(code).name)
    return _drawn(table[kind][int(rng.integers(len(table[kind])))], table, rng)


def with_synonyms(text: str, code: str, rng: np.random.Generator) -> str:
    """A text in which phrases of one meaning are swapped for others of their class.

    Args:
        text: as it was written.
        code: of its language.
        rng: draws what is swapped.
    """
    language = language_of(code)
    lexicon, table = lexicon_of(language), _table(language.name)
    words = [piece.text for piece in pieces(normalise(text, english()).text)]
    said: list[str] = []
    at = 0
    while at < len(words):
        key, stop = _class_at(words, at, lexicon)
        if key is not None and rng.random() < SHARE:
            said.append(_other(key, table, language, rng))
        else:
            said += words[at:stop]
        at = stop
    return " ".join(said)


def _class_at(words: list[str], at: int, lexicon: Lexicon) -> tuple[str | None, int]:
    """The class of the longest phrase at a word if it has one alone, and the word behind it."""
    matches = list(lexicon.matches(words, at))
    if not matches:
        return None, at + 1
    stop = matches[0][2]
    keys = {f"{kind} {value}".strip() for kind, value, end in matches if end == stop}
    key = keys.pop()
    return (key if not keys and key in SWAPPED else None), stop


def _other(
    key: str, table: dict[str, list[str]], language: Language, rng: np.random.Generator
) -> str:
    row = table[key]
    drawn = language.folded(_drawn(row[int(rng.integers(len(row)))], table, rng))
    return _other(key, table, language, rng) if _SIDED.search(drawn) else drawn
