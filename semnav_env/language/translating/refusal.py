"""Says why a text is refused, and what can be said instead, in the language of the speaker."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from semnav_env.language.errors import CommandError, listed
from semnav_env.language.language import Language
from semnav_env.language.languages import languages
from semnav_env.language.normalise import normalise
from semnav_env.language.rooms import plain_name
from semnav_env.language.translating.translator import TranslatedText
from semnav_env.language.translating.unknown_words import near_room
from semnav_env.language.translating.word_classes import UNKNOWN, classes_of
from semnav_env.language.vocabulary.lexicon import lexicon_of
from semnav_env.language.vocabulary.recognition import votes
from semnav_env.language.vocabulary.room_words import SUPPORTING_WORDS
from semnav_env.language.vocabulary.typos import nearest_word
from semnav_env.language.words import TextPiece, pieces

CAUSES = (
    ("refused_thing", ("beyond",)),
    ("refused_room", ("noun area",)),
    ("refused_not", ("not", "absent", "beyond", "before it")),
    ("refused_word", (UNKNOWN,)),
    ("refused_or", ("or",)),
)
"""What is said of a word at fault, and its classes: it has one of them, and no others. The causes
are tried in this order. What forbids has "not", too."""

LEAST_LIKENESS = 0.05
"""Least probability of the command that a refusal names as the nearest one."""


@dataclass(frozen=True)
class Refusal:
    """A text that is no command.

    Attributes:
        text: as it was given.
        spoken: its language.
        rooms: names of the rooms of the floor plan.
        found: its translations; None if it has no words, or too many.
    """

    text: str
    spoken: Language
    rooms: Sequence[str]
    found: TranslatedText | None

    @property
    def error(self) -> CommandError:
        """Names the word that is at fault, or the nearest command."""
        names_a_room = bool(self.found and self.found.plain.rooms)
        for phrase, kinds in CAUSES:
            if phrase == "refused_room" and names_a_room:  # the fault is another one
                continue
            for piece, known in self._words:
                if known and known <= set(kinds) and (phrase != "refused_not" or "not" in known):
                    return self._about(piece, phrase)
        problem = "refused_question" if "?" in self.text else "refused"
        return CommandError(self.spoken.say(problem), self.text, hint=self._nearest())

    @cached_property
    def _words(self) -> list[tuple[TextPiece, set[str]]]:
        """The words that name no room of the building and no person, each with its classes."""
        said = pieces(normalise(self.text, self.spoken).text)
        found = classes_of([piece.text for piece in said], lexicon_of(self.spoken))
        classes = ({name.partition(",")[0] for name in names} for names in found)
        named = {word for room in self.rooms for word in re.split("[^a-z0-9]", plain_name(room))}
        named |= SUPPORTING_WORDS
        return [
            (piece, known)
            for piece, known in zip(said, classes, strict=True)
            if any(map(str.isalnum, piece.text)) and plain_name(piece.text) not in named
        ]

    def with_a_room(self) -> Iterator[str]:
        """The text with an unknown word replaced by that of a room's name, for each such word."""
        for piece, known in self._words:
            near = near_room(piece.text, self.rooms) if known == {UNKNOWN} else None
            if near:
                start, length = normalise(self.text, self.spoken).span(piece.start, piece.stop)
                yield self.text[:start] + near + self.text[start + length :]

    def _about(self, piece: TextPiece, phrase: str) -> CommandError:
        """The error that points at a word, and says it as it was written."""
        start, length = normalise(self.text, self.spoken).span(piece.start, piece.stop)
        problem = self.spoken.say(phrase, word=self.text[start : start + length])
        hint = self._advice(phrase, piece.text)
        place = self.spoken.tell("character")
        return CommandError(problem, self.text, start, length, hint=hint, place=place)

    def _advice(self, phrase: str, word: str) -> str | None:
        if phrase in ("refused_word", "refused_room") and self.rooms:
            return self.spoken.say("rooms_here", rooms=listed(tuple(self.rooms)))
        nearest = nearest_word(word, lexicon_of(self.spoken).words)
        if phrase == "refused_word" and nearest:
            return self.spoken.say("did_you_mean", word=nearest)
        return self.spoken.say("rooms_unknown") if phrase == "refused_room" else None

    def _nearest(self) -> str | None:
        """The likeliest command, for the speaker to say it if it is meant."""
        found = self.found.translations if self.found else ()
        if not found or found[0].likeness < LEAST_LIKENESS:
            return None
        return self.spoken.say("nearest", command=found[0].command.say(self.spoken))


def refused_language(text: str, spoken: Language) -> CommandError | None:
    """The error for a text that another language knows wholly, and the one asked for does not."""
    words = [piece.text for piece in pieces(normalise(text, spoken).text) if piece.text.isalpha()]
    for other in languages().values():
        if votes(words, other) == len(words) > votes(words, spoken):
            return CommandError(spoken.say("refused_language", language=other.name), text)
    return None
