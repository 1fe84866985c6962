"""Says the same command in other words, with the wordings in the language's file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from semnav_env.language.clauses import Turn
from semnav_env.language.command import Command, Link, links_of
from semnav_env.language.declarations import field_names
from semnav_env.language.language import Language
from semnav_env.language.languages import language_of
from semnav_env.language.sampling import check_generator

TEXTS_PER_PARAPHRASE = 20
"""Texts that are drawn for each paraphrase wanted, before the command is taken to have no more."""

BEFORE_NOUNS = ("det", "a", "ordinal")
"""Classes of words with a noun behind them: "the bend" and "3rd turn" name no action."""


@dataclass(frozen=True, eq=False)
class _VariedLanguage(Language):
    """A language that says each phrase in a random wording.

    Attributes:
        rng: draws the wordings.
    """

    rng: np.random.Generator

    def say(self, phrase: str, form: str = "", **parts: Any) -> str:
        """Fill the parts into a random wording of the phrase, in the given form if there is one."""
        formed = f"{phrase}:{form}"
        key = formed if formed in self.phrases or formed in self.wordings else phrase
        return self.fill(self._any_of(self.phrases.get(key) or self.phrases[phrase], key), parts)

    def ordinal(self, number: int) -> str:
        """A random word for an ordinal."""
        return self._any_of(super().ordinal(number), str(number))

    def command(self, command: Command) -> str | None:
        """The text of a command, with or without words of politeness.

        None if it leaves open how far a condition reaches: "if you see the door and then go in",
        "if you see the door, left at the corner".
        """
        polite, parts = self._any_of("{command}", "command"), command.parts(self)
        links = links_of(command.clauses)
        dependent = (2 * i for i, link in enumerate(links) if link in (Link.THEN, Link.OTHERWISE))
        is_clear = all(
            (links[at // 2] is Link.OTHERWISE or not parts[at - 1][0].isspace())
            and (not isinstance(command.clauses[at // 2], Turn) or self._says_verb(parts[at]))
            for at in dependent
        )
        return polite.format(command="".join(parts)) if is_clear else None

    def _says_verb(self, text: str) -> bool:
        """Whether a clause has a verb: "turn left at the corner", not "left at the corner"."""
        from semnav_env.language.vocabulary.lexicon import lexicon_of  # here, as these are large
        from semnav_env.language.vocabulary.phrases import plain_words

        spoken = language_of(self.code)
        words, lexicon = plain_words(text, spoken), lexicon_of(spoken)
        matches = [tuple(lexicon.matches(words, at)) for at in range(len(words))]
        nouns = {stop for found in matches for kind, _, stop in found if kind in BEFORE_NOUNS}
        kinds = (
            kind
            for at, found in enumerate(matches)
            if at not in nouns and not lexicon.find(words, at, "side")  # "left" is a verb, too
            for kind, _, _ in found
        )
        return any(kind in ("verb", "around", "around alone") for kind in kinds)

    def _any_of(self, usual: str, key: str) -> str:
        choices = (usual, *self.wordings.get(key, ()))
        return choices[int(self.rng.integers(len(choices)))]


def paraphrases(
    command: Command, rng: np.random.Generator, n: int, language: str | Language = "en"
) -> tuple[str, ...]:
    """Texts in other words for a command.

    Args:
        command: what the texts mean.
        rng: draws the wordings.
        n: how many texts; all differ, and none is `command.say(language)`.
        language: "en", "de" or a loaded one.

    Returns:
        The texts; fewer than `n` if the language has too few wordings.

    Raises:
        ValueError: `n` is negative, or there is no such language.
        TypeError: the command is a text, or `rng` is no generator.
    """
    if not isinstance(command, Command):
        raise TypeError(f"paraphrases needs a Command, as parse makes it, not {command!r}")
    check_generator(rng)
    if n < 0:
        raise ValueError(f"n is {n}; it must be 0 or more")
    spoken = language_of(language)
    values = {name: getattr(spoken, name) for name in field_names(type(spoken))}
    varied, usual = _VariedLanguage(**values, rng=rng), command.say(spoken)
    found: dict[str, None] = {}
    for _ in range(TEXTS_PER_PARAPHRASE * n):
        if len(found) == n:
            break
        text = varied.command(command)
        if text and text != usual:
            found[text] = None
    return tuple(found)
