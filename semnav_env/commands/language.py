"""A language of commands: its grammar and words, read from two files beside this one."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

from semnav_env.commands.words import fold, pieces

SIGNS = PUNCTUATION, QUESTION, NAME = "_PUNCTUATION", "_QUESTION", "NAME"
"""Terminals that no list of words holds."""

NUMBER = "0-9"
"""Stands for every word that begins with a digit, in the hints."""


@dataclass(frozen=True, eq=False)
class Language:
    """The words of a language by their use in its grammar.

    Attributes:
        name: stem of the two files.
        code: what `parse` calls it, as "en".
        grammar: Lark grammar without the declarations of its word terminals.
        terminals: the words (or fixed phrases) of each terminal, the usual one first.
        ordinals: the words of 1, 2, ... in turn, the usual one first.
        from_end: the words of last, second to last, ... in turn, the usual one first.
        numbers: the words of numbers.
        counts: the number of each word of `ordinals` and, negative, of `from_end`.
        decimal: parts a number from its fraction.
        punctuation: characters that part clauses and end a command.
        same_as: characters read as others.
        names: what to call a terminal in an error, where its first word does not do.
        hints: advice for words that are often tried and not understood.
        phrases: how commands are said, as format strings; "door:to" is a form of "door".
        wordings: other ways to say phrases; those of "1" are other words for the first, and those
            of "command" say a whole one.
    """

    name: str
    code: str
    grammar: str
    terminals: dict[str, tuple[str, ...]]
    ordinals: tuple[tuple[str, ...], ...]
    from_end: tuple[tuple[str, ...], ...]
    numbers: dict[str, float]
    counts: dict[str, int]
    decimal: str
    punctuation: str
    same_as: dict[str, str]
    names: dict[str, str]
    hints: dict[str, str]
    phrases: dict[str, str]
    wordings: dict[str, tuple[str, ...]]

    def lark(self) -> str:
        """The whole grammar in Lark's notation."""
        return f"{self.grammar}\n%declare {' '.join((*self.terminals, *SIGNS))}\n"

    def folded(self, words: str) -> str:
        """Words with the spelling that the grammar reads."""
        return fold(words, self.same_as)

    def number(self, words: str) -> float:
        """What a number word or a number in digits means, for example 2.5 for "2.5"."""
        known = self.numbers.get(words)
        return float(words.replace(self.decimal, ".")) if known is None else known

    def number_text(self, amount: float) -> str:
        """A number in digits."""
        return f"{amount:g}".replace(".", self.decimal)

    def ordinal(self, number: int) -> str:
        """The usual word of an ordinal: positive, `OTHER` (0), or counted from the end."""
        if number == 0:
            return self.terminals["OTHER"][0]
        return self.ordinals[number - 1][0] if number > 0 else self.from_end[-number - 1][0]

    def vocabulary(self, terminal: str) -> tuple[str, ...]:
        """The single words that a terminal is made of, as they are written."""
        phrases = self.terminals.get(terminal, ())
        return tuple(word for phrase in phrases for word in phrase.replace("-", " ").split())

    def call(self, terminal: str) -> str:
        """What to call a terminal in an error."""
        return self.names.get(terminal) or self.terminals[terminal][0]

    def hint(self, word: str) -> str | None:
        """Advice for a word that was not understood, if there is any."""
        return self.hints.get(NUMBER if word[:1].isdigit() else word)

    def say(self, phrase: str, form: str = "", **parts: Any) -> str:
        """Fill the parts into a phrase, or into a form of it if it has that.

        Parts that are references are said in the form that the phrase asks for: "{door:to}".
        """
        return self.fill(self.phrases.get(f"{phrase}:{form}") or self.phrases[phrase], parts)

    def fill(self, template: str, parts: dict[str, Any]) -> str:
        """Say the parts in a format string, each in the form that it asks for."""
        return template.format(**{key: _Part(part, self) for key, part in parts.items()})


class _Part:
    """A part of a phrase; its format specification names the form in which it is said."""

    def __init__(self, value: Any, language: Language) -> None:
        self._value = value
        self._language = language

    def __format__(self, form: str) -> str:
        said = self._value if isinstance(self._value, str) else None
        return self._value.say(self._language, form) if said is None else said


def load(name: str) -> Language:
    """The language in `name.json` and `name.lark`."""
    folder = files("semnav_env.commands")
    table = json.loads((folder / f"{name}.json").read_text("utf-8"))
    same_as = table["same_as"]
    ordinals, from_end = (tuple(map(tuple, table[key])) for key in ("ordinals", "from_end"))
    terminals = {key: tuple(words) for key, words in table["terminals"].items()}
    terminals["NTH"] = tuple(word for words in ordinals for word in words)
    terminals["FROM_END"] = tuple(word for words in from_end for word in words)
    terminals["NUMBER"] = tuple(table["numbers"])
    numbers = {_plain(words, same_as): value for words, value in table["numbers"].items()}
    counts = {_plain(w, same_as): n for n, words in enumerate(ordinals, 1) for w in words}
    counts |= {_plain(w, same_as): -n for n, words in enumerate(from_end, 1) for w in words}
    return Language(
        name=name,
        code=table["code"],
        grammar=(folder / f"{name}.lark").read_text("utf-8"),
        terminals=terminals,
        ordinals=ordinals,
        from_end=from_end,
        numbers=numbers,
        counts=counts,
        decimal=table["decimal"],
        punctuation=table["punctuation"],
        same_as=same_as,
        names=table["names"],
        hints={fold(w, same_as): hint["say"] for hint in table["hints"] for w in hint["words"]},
        phrases=table["phrases"],
        wordings={key: tuple(words) for key, words in table["wordings"].items()},
    )


def _plain(words: str, same_as: dict[str, str]) -> str:
    return " ".join(piece.text for piece in pieces(fold(words.casefold(), same_as)))


@cache
def english() -> Language:
    """English, read once."""
    return languages()["en"]


@cache
def languages() -> dict[str, Language]:
    """All languages by their code; each is a pair of files beside this one."""
    folder = files("semnav_env.commands")
    stems = sorted(file.name[:-5] for file in folder.iterdir() if file.name.endswith(".lark"))
    loaded = [load(stem) for stem in stems]
    return {language.code: language for language in loaded}


def language_of(language: str | Language) -> Language:
    """The language of a code or a name, such as "de" or "german".

    Raises:
        ValueError: there is no such language; lists those there are.
    """
    if isinstance(language, Language):
        return language
    for known in languages().values():
        if language in (known.code, known.name):
            return known
    there = ", ".join(f"{known.code} ({known.name})" for known in languages().values())
    raise ValueError(f"no language {language!r}; there are: {there}")
