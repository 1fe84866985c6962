"""A language of commands: its grammar and words, read from two files beside this one."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

NUMBER = "0-9"
"""Stands for every word that begins with a digit, in the hints."""


@dataclass(frozen=True, eq=False)
class Language:
    """The words of a language by their use in its grammar.

    Attributes:
        name: stem of the two files.
        grammar: Lark grammar without the definitions of the word terminals.
        terminals: the words (or fixed phrases) of each terminal, the usual one first.
        ordinals: the words of 1, 2, ... in turn, the usual one first.
        punctuation: characters that part clauses and end a command.
        letters: letters beyond ASCII that its words use.
        same_as: characters read as another.
        names: what to call a terminal in an error, where its first word does not do.
        hints: advice for words that are often tried and not understood.
        phrases: how commands are said, as format strings.
    """

    name: str
    grammar: str
    terminals: dict[str, tuple[str, ...]]
    ordinals: tuple[tuple[str, ...], ...]
    punctuation: str
    letters: str
    same_as: dict[str, str]
    names: dict[str, str]
    hints: dict[str, str]
    phrases: dict[str, str]

    def lark(self) -> str:
        """The whole grammar in Lark's notation; a word ends where its letters end."""
        lines = [self.grammar, f"_PUNCTUATION: /[{re.escape(self.punctuation)}]/"]
        for terminal, words in self.terminals.items():
            longest_first = sorted(words, key=len, reverse=True)
            lines.append(rf"{terminal}: /(?:{'|'.join(longest_first)})(?![\w'])/")
        return "\n".join(lines) + "\n"

    def number(self, ordinal: str) -> int:
        """The number of an ordinal word, for example 2 for "2nd"."""
        return next(n for n, words in enumerate(self.ordinals, 1) if ordinal in words)

    def vocabulary(self, terminal: str) -> tuple[str, ...]:
        """The single words that a terminal is made of."""
        return tuple(word for phrase in self.terminals.get(terminal, ()) for word in phrase.split())

    def call(self, terminal: str) -> str:
        """What to call a terminal in an error."""
        return self.names.get(terminal) or self.terminals[terminal][0]

    def hint(self, word: str) -> str | None:
        """Advice for a word that was not understood, if there is any."""
        return self.hints.get(NUMBER if word[:1].isdigit() else word.split("-")[0])

    def say(self, phrase: str, **parts: str) -> str:
        """Fill the parts into a phrase."""
        return self.phrases[phrase].format(**parts)


def load(name: str) -> Language:
    """The language in `name.json` and `name.lark`."""
    folder = files("semnav_env.commands")
    table = json.loads((folder / f"{name}.json").read_text("utf-8"))
    ordinals = tuple(tuple(words) for words in table["ordinals"])
    terminals = {key: tuple(words) for key, words in table["terminals"].items()}
    return Language(
        name=name,
        grammar=(folder / f"{name}.lark").read_text("utf-8"),
        terminals=terminals | {"NTH": tuple(word for words in ordinals for word in words)},
        ordinals=ordinals,
        punctuation=table["punctuation"],
        letters=table["letters"],
        same_as=table["same_as"],
        names=table["names"],
        hints={word: hint["say"] for hint in table["hints"] for word in hint["words"]},
        phrases=table["phrases"],
    )


@cache
def english() -> Language:
    """English, read once."""
    return load("english")
