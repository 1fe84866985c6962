"""A language of commands: its words, and how it puts commands in words."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from numbers import Real
from typing import Any

from semnav_env.language.words import fold


@dataclass(frozen=True, eq=False)
class Language:
    """A language of commands, as `languages.load` reads it from its file.

    Attributes:
        name: stem of its file, such as "english".
        code: its ISO 639-1 code, such as "en".
        ordinals: for 1, 2, ... in order its words, the usual one first.
        from_end: for the last, the second to last, ... in order its words, the usual one first.
        other: its word for the only other one.
        numbers: the value of each number word.
        decimal: the decimal sign.
        punctuation: characters that part clauses or end a command.
        same_as: characters that are read as others.
        phrases: format strings that put commands in words; "door:to" is a form of "door".
        answers: what people answer to a question: words for yes and no, for the first and the
            second of two choices, for sides and approaches, and words that may stand beside.
        wordings: other format strings for these phrases; those of "1" are other words for the
            first, and those of "command" frame a whole command.
        told: format strings of what a robot tells, by those in English; see `Told`.
    """

    name: str
    code: str
    ordinals: tuple[tuple[str, ...], ...]
    from_end: tuple[tuple[str, ...], ...]
    other: str
    numbers: dict[str, float]
    decimal: str
    punctuation: str
    same_as: dict[str, str]
    phrases: dict[str, str]
    answers: dict[str, tuple[str, ...]]
    wordings: dict[str, tuple[str, ...]]
    told: dict[str, str]

    def folded(self, words: str) -> str:
        """Words in the spelling in which they are read."""
        return fold(words, self.same_as)

    def number_text(self, amount: float) -> str:
        """A number in digits, with the decimal sign of the language."""
        return f"{amount:g}".replace(".", self.decimal)

    def ordinal(self, number: int) -> str:
        """The usual word for an ordinal: positive, `OTHER` (0), or negative from the end."""
        if number == 0:
            return self.other
        return self.ordinals[number - 1][0] if number > 0 else self.from_end[-number - 1][0]

    def say(self, phrase: str, form: str = "", **parts: Any) -> str:
        """Put a phrase in words, in the given form if the language has it.

        Parts that are references are put in the form that the phrase asks for: "{door:to}".
        """
        return self.fill(self.phrases.get(f"{phrase}:{form}") or self.phrases[phrase], parts)

    def tell(self, template: str, form: str = "", **parts: Any) -> str:
        """What a robot tells, by its format string in English, which stands for an unknown one."""
        known = self.told.get(f"{template}:{form}") or self.told.get(template, template)
        return self.fill(known, parts)

    def fill(self, template: str, parts: dict[str, Any]) -> str:
        """Fill parts into a format string, each in the form that it asks for."""
        return template.format(**{key: _SpokenPart(part, self) for key, part in parts.items()})


class _SpokenPart:
    """A part of a phrase; the format specification names the grammatical form that it takes.

    That of a number is its format, and "bare" is without an English article.
    """

    def __init__(self, value: Any, language: Language) -> None:
        self._value = value
        self._language = language

    def __format__(self, form: str) -> str:
        if isinstance(self._value, StrEnum):
            return self._language.say(self._value)
        if isinstance(self._value, Real):
            return format(float(self._value), form or "g").replace(".", self._language.decimal)
        is_plain = not hasattr(self._value, "say")
        forms = (form,) if form else ()  # a command has none
        said: str = self._value if is_plain else self._value.say(self._language, *forms)
        return said.removeprefix("the ") if form == "bare" else said
