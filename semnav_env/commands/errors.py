"""What is wrong with the text of a command, where, and what would have been right."""

from __future__ import annotations

import unicodedata
from typing import Any

SHOWN_BEFORE, SHOWN_AFTER = 48, 24
"""How much of a long text an error shows on either side of the fault, characters."""

MOST_SHOWN = 12
"""How many of the words that could have stood somewhere an error lists."""


class CommandError(ValueError):
    """A text is not a command.

    `str(error)` is a line that says all, the text, and a caret under the fault.

    Attributes:
        problem: what is wrong.
        text: the text as it was given, or its beginning.
        position: index in `text` of the first character that is wrong; None for the whole.
        length: number of characters that are wrong.
        expected: what could have stood there.
        suggestion: the known word that is nearest to the one that was not understood.
        hint: advice.
    """

    def __init__(
        self,
        problem: str,
        text: str = "",
        position: int | None = None,
        length: int = 1,
        expected: tuple[str, ...] = (),
        suggestion: str | None = None,
        hint: str | None = None,
    ) -> None:
        super().__init__(problem, text, position, length, expected, suggestion, hint)
        self.problem = problem
        self.text = text
        self.position = position
        self.length = length
        self.expected = expected
        self.suggestion = suggestion
        self.hint = hint

    @property
    def summary(self) -> str:
        """All of it in one line."""
        where = "" if self.position is None else f" (character {self.position + 1})"
        parts = [self.problem + where]
        if self.hint:
            parts.append(self.hint)
        if self.expected:
            one_of = "expected: " if len(self.expected) == 1 else "expected one of: "
            parts.append(one_of + some_of(self.expected))
        if self.suggestion:
            parts.append(f'did you mean "{self.suggestion}"?')
        return "; ".join(parts)

    def __str__(self) -> str:
        if self.position is None:
            return self.summary
        return f"{self.summary}\n{pointed(self.text, self.position, self.length)}"


class AmbiguousCommandError(CommandError):
    """A text can mean several commands.

    Attributes:
        readings: the commands, the likelier first.
        differences: what each reading says where they differ, in the words of the text's language.
    """

    def __init__(self, text: str, readings: tuple[Any, ...], differences: tuple[str, ...]) -> None:
        ways = " or ".join(f'"{difference}"' for difference in differences)
        super().__init__(f"this can mean {ways}", text, hint="say which")
        self.args = (text, readings, differences)
        self.readings = readings
        self.differences = differences


def some_of(words: tuple[str, ...]) -> str:
    """The first `MOST_SHOWN` words, and whether there are more."""
    return ", ".join(words[:MOST_SHOWN]) + (", ..." if len(words) > MOST_SHOWN else "")


def pointed(text: str, position: int, length: int) -> str:
    """Two lines: the text around a position, and carets under it."""
    start = max(0, position - SHOWN_BEFORE)
    stop = min(len(text), position + min(length, SHOWN_AFTER))
    before = ("..." if start else "") + _printable(text[start:position])
    fault = _printable(text[position:stop])
    after = _printable(text[stop : stop + SHOWN_AFTER])
    after += "..." if stop + SHOWN_AFTER < len(text) else ""
    carets = "^" * max(1, _columns(fault))
    return f"  {before}{fault}{after}\n  {' ' * _columns(before)}{carets}"


def named(character: str) -> str:
    """A character by its code point and name, for example "U+0430 CYRILLIC SMALL LETTER A"."""
    return f"U+{ord(character):04X} {unicodedata.name(character, '')}".rstrip()


def _printable(text: str) -> str:
    return "".join(" " if c.isspace() else c if c.isprintable() else "�" for c in text)


def _columns(text: str) -> int:
    """How many columns a terminal gives to a text."""
    wide = sum(unicodedata.east_asian_width(c) in "WF" for c in text)
    return len(text) + wide - sum(unicodedata.combining(c) > 0 for c in text)
