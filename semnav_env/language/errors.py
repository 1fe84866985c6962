"""Errors that say what is wrong with a text, where, and what would have been right."""

from __future__ import annotations

import unicodedata

CONTEXT_BEFORE, CONTEXT_AFTER = 48, 24
"""How much of a long text an error shows before and after the fault, characters; together with the
fault it fits into a line of a terminal."""

MAX_WORDS_LISTED = 12
"""The most names that an error lists."""


class CommandError(ValueError):
    """A text that is not a command.

    `str(error)` is the summary in one line, then the text, then carets under the fault.

    Attributes:
        problem: what is wrong.
        text: the text as it was given, or its beginning.
        position: index in `text` of the first wrong character; None if the whole text is wrong.
        length: number of wrong characters.
        hint: advice on what to say instead.
        place: the word for a character in the language of the speaker.
    """

    problem: str
    text: str
    position: int | None
    length: int
    hint: str | None
    place: str

    def __init__(
        self,
        problem: str,
        text: str = "",
        position: int | None = None,
        length: int = 1,
        hint: str | None = None,
        place: str = "character",
    ) -> None:
        super().__init__(problem, text, position, length, hint, place)
        self.problem = problem
        self.text = text
        self.position = position
        self.length = length
        self.hint = hint
        self.place = place

    @property
    def summary(self) -> str:
        """The problem and the hint in one line."""
        where = "" if self.position is None else f" ({self.place} {self.position + 1})"
        return "; ".join(filter(None, (self.problem + where, self.hint)))

    def __str__(self) -> str:
        if self.position is None:
            return self.summary
        return f"{self.summary}\n{with_caret(self.text, self.position, self.length)}"


def listed(words: tuple[str, ...]) -> str:
    """At most `MAX_WORDS_LISTED` words, with "..." if there are more."""
    return ", ".join(words[:MAX_WORDS_LISTED]) + (", ..." if len(words) > MAX_WORDS_LISTED else "")


def with_caret(text: str, position: int, length: int) -> str:
    """Two lines: the text around a position, and carets under its wrong characters."""
    start = max(0, position - CONTEXT_BEFORE)
    stop = min(len(text), position + min(length, CONTEXT_AFTER))
    before = ("..." if start else "") + _printable(text[start:position])
    fault = _printable(text[position:stop])
    after = _printable(text[stop : stop + CONTEXT_AFTER])
    after += "..." if stop + CONTEXT_AFTER < len(text) else ""
    carets = "^" * max(1, _columns(fault))
    return f"  {before}{fault}{after}\n  {' ' * _columns(before)}{carets}"


def character_name(character: str) -> str:
    """A character by its code point and name, for example "U+0430 CYRILLIC SMALL LETTER A"."""
    return f"U+{ord(character):04X} {unicodedata.name(character, '')}".rstrip()


def _printable(text: str) -> str:
    return "".join(" " if c.isspace() else c if c.isprintable() else "�" for c in text)


def _columns(text: str) -> int:
    """How many columns of a terminal a text takes; wide letters take two, accents none."""
    wide = sum(unicodedata.east_asian_width(c) in "WF" for c in text)
    return len(text) + wide - sum(unicodedata.combining(c) > 0 for c in text)
