"""Texts for people that are made before it is known which language they speak."""

from __future__ import annotations

from typing import Any

from semnav_env.language.language import Language

WHOLE = "{what}"
"""The template of a text that is one part, which takes its forms."""


class Told(str):
    """A text in English that says itself in other languages, too.

    Args:
        template: format string in English; the languages' files have theirs under "told".
        parts: what is filled in: texts, numbers, clauses, references, and texts of this kind.
    """

    def __new__(cls, template: str, **parts: Any) -> Told:
        """Say the text in English."""
        from semnav_env.language.languages import english  # read when first spoken

        text = super().__new__(cls, english().fill(template, parts))
        text._template, text._parts = template, parts
        return text

    def __getnewargs_ex__(self) -> tuple[tuple[str], dict[str, Any]]:
        """What a copy is made of."""
        return (self._template,), self._parts

    def say(self, language: Language, form: str = "") -> str:
        """The text in the words of a language, in a grammatical form if the language has it."""
        template = f"{{what:{form}}}" if self._template == WHOLE and form else self._template
        return language.tell(template, form, **self._parts)

    _template: str
    _parts: dict[str, Any]


def told(what: object) -> Told:
    """What can be said, such as a clause or a reference, as a text."""
    return what if isinstance(what, Told) else Told(WHOLE, what=what)


def in_words_of(language: Language, text: str) -> str:
    """A text in the words of a language, if it knows them."""
    return text.say(language) if isinstance(text, Told) else text
