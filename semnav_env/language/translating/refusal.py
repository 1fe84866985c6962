"""Says why a text is refused, and what can be said instead, in the language of the speaker."""

from __future__ import annotations

from collections.abc import Sequence

from semnav_env.language.errors import CommandError, listed
from semnav_env.language.language import Language
from semnav_env.language.languages import languages
from semnav_env.language.normalise import NormalisedText, normalise
from semnav_env.language.translating.support import FORBIDDING
from semnav_env.language.translating.translator import TranslatedText
from semnav_env.language.translating.word_classes import UNKNOWN, classes_of
from semnav_env.language.vocabulary.lexicon import lexicon_of
from semnav_env.language.vocabulary.recognition import votes
from semnav_env.language.vocabulary.typos import nearest_word
from semnav_env.language.words import TextPiece, pieces

SUPPORTED = 0.05
"""Least probability of a command that a refusal names as the nearest one."""


def refusal(
    text: str, spoken: Language, rooms: Sequence[str], found: TranslatedText | None
) -> CommandError:
    """The error for a text that is no command.

    Args:
        text: as it was given.
        spoken: its language.
        rooms: names of the rooms of the floor plan.
        found: its translations; None if it has no words, or too many.
    """
    normalised = normalise(text, spoken)
    said = pieces(normalised.text)
    words = [piece.text for piece in said]
    lexicon = lexicon_of(spoken)
    classes = [set(each) for each in classes_of(words, lexicon)]

    def first(*kinds: str) -> TextPiece | None:
        """The first word that belongs to one of these classes, and to no other."""
        of_kind = (
            piece
            for piece, known in zip(said, classes, strict=True)
            if known and all(name.partition(",")[0] in kinds for name in known)
        )
        return next(of_kind, None)

    if other := _other_language(words, spoken):
        return CommandError(spoken.say("refused_language", language=other), text)
    if piece := first("beyond"):
        return _about(piece, normalised, spoken.say("refused_thing", word=piece.text))
    if piece := first("noun area"):
        known = spoken.say("rooms_here", rooms=listed(tuple(rooms)))
        hint = known if rooms else spoken.say("rooms_unknown")
        return _about(piece, normalised, spoken.say("refused_room", word=piece.text), hint)
    if piece := first(UNKNOWN):
        nearest = nearest_word(piece.text, lexicon.words)
        hint = spoken.say("did_you_mean", word=nearest) if nearest else None
        return _about(piece, normalised, spoken.say("refused_word", word=piece.text), hint)
    if piece := first(*FORBIDDING):
        return _about(piece, normalised, spoken.say("refused"), spoken.hint(piece.text))
    if "?" in words:
        return CommandError(spoken.hint("?") or spoken.say("refused"), text)
    return CommandError(spoken.say("refused"), text, hint=_nearest(found, spoken))


def _about(
    piece: TextPiece, text: NormalisedText, problem: str, hint: str | None = None
) -> CommandError:
    return CommandError(problem, text.original, *text.span(piece.start, piece.stop), hint=hint)


def _nearest(found: TranslatedText | None, spoken: Language) -> str | None:
    """The likeliest command, for the speaker to say it if it is meant."""
    likely = [each for each in (found.translations if found else ()) if each.likeness > SUPPORTED]
    return spoken.say("nearest", command=likely[0].command.say(spoken)) if likely else None


def _other_language(words: Sequence[str], spoken: Language) -> str | None:
    """The name of the language to which all words of a text belong that `spoken` has not."""
    every = sum(word[0].isalpha() for word in words)
    for language in languages().values():
        if language is not spoken and votes(words, language) == every > votes(words, spoken) * 2:
            return language.name
    return None
