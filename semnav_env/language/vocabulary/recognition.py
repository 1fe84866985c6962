"""Recognises the language of a text by its words."""

from __future__ import annotations

from collections.abc import Sequence

from semnav_env.language.language import Language
from semnav_env.language.languages import english, language_of, languages
from semnav_env.language.normalise import normalise
from semnav_env.language.vocabulary.lexicon import Lexicon, lexicon_of, mixed
from semnav_env.language.words import pieces


def language_of_text(text: str, language: str | Language | None = None) -> Language:
    """The language of a text: the one that is given, or the one that is recognised.

    Raises:
        CommandError: it has characters that no command has.
        ValueError: there is no such language.
    """
    if language is not None:
        return language_of(language)
    return recognised([piece.text for piece in pieces(normalise(text, english()).text)])


def recognised(words: Sequence[str]) -> Language:
    """The language with the most of these words; of several the first, English before German."""
    known = sorted(languages().values(), key=lambda language: language.code != "en")
    every = sum(word[0].isalpha() for word in words)
    for language in known[:-1]:
        if votes(words, language) == every:
            return language  # the lexicons of the others, which take long to make, tell no more
    return max(known, key=lambda language: votes(words, language))


def votes(words: Sequence[str], language: Language) -> int:
    """How many of these words a language has."""
    known = lexicon_of(language).words
    return sum(word in known for word in words if word[0].isalpha())


def lexicon_for(words: Sequence[str], language: Language) -> Lexicon:
    """The lexicon of a language, with words of others where the text has some that it has not."""
    lexicon = lexicon_of(language)
    for other in languages().values():
        if any(w not in lexicon.words and w in lexicon_of(other).words for w in words):
            lexicon = mixed(lexicon, lexicon_of(other))
    return lexicon
