"""All that a text may mean: the readings of the grammar, and what the translator takes it for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from semnav_env.language.command import Command
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.defaults import decided
from semnav_env.language.errors import CommandError
from semnav_env.language.language import Language
from semnav_env.language.languages import language_of
from semnav_env.language.parser import check_rooms, readings
from semnav_env.language.question import AmbiguousCommandError
from semnav_env.language.speech.recognition import language_of_text
from semnav_env.language.translating.network import load_translator
from semnav_env.language.translating.support import TextSupport
from semnav_env.language.translating.translator import TranslatedText, translate


@dataclass(frozen=True)
class Candidate:
    """A command that a text may mean.

    Attributes:
        command: the command.
        read: whether it is a reading of the grammar.
        likeness: its probability by the translator, with that of others of the same meaning; None
            if the translator has no symbols for it.
        place: among the translations, 0 for the likeliest; None if it is none of them.
        unsaid: how many numbers, sides and rooms of the text it does not have.
    """

    command: Command
    read: bool
    likeness: float | None = None
    place: int | None = None
    unsaid: int = 0


@dataclass(frozen=True)
class HeardText:
    """A text with its candidates, which differ in meaning.

    Attributes:
        text: as it was given.
        candidates: those of the grammar first.
        refusal: the error of the grammar; None if it reads the text, perhaps in several ways.
        translated: what the translator makes of the text; None if it is too long for it.
    """

    text: str
    candidates: tuple[Candidate, ...]
    refusal: CommandError | None
    translated: TranslatedText | None

    @cached_property
    def support(self) -> TextSupport:
        """The evidence in the words of the text."""
        return TextSupport.of(self.translated.plain.words if self.translated else ())

    def speaks_of(self, found: Candidate) -> bool:
        """Whether the grammar reads a candidate, or the words name all that it is about."""
        return found.read or self.support.speaks_of(found.command)

    @property
    def readings(self) -> int:
        """The number of the grammar's readings."""
        return sum(each.read for each in self.candidates)

    @property
    def leaves_out(self) -> bool:
        """Whether the grammar asks whether it may leave words out."""
        asked = self.refusal
        return isinstance(asked, AmbiguousCommandError) and bool(asked.question.unread)


def heard(
    text: str, language: str | Language | None, rooms: Sequence[str], folder: Path
) -> HeardText:
    """A text with all that it may mean.

    Args:
        text: in any language.
        language: code, or a loaded language; None to recognise it.
        rooms: names of the rooms of the floor plan; none if they are not known.
        folder: of the translator's files.
    """
    read: tuple[Command, ...] = ()
    refusal: CommandError | None = None
    try:
        read = readings(text, language, rooms)
        found = decided(read)
    except AmbiguousCommandError as error:
        refusal, found = error, error.readings
    except CommandError as error:
        refusal, found = error, ()
    translated = _translated(text, language, rooms, folder)
    candidates = {meaning(each): Candidate(each, True) for each in reversed(found)}
    candidates = dict(reversed(candidates.items()))
    if translated is not None:
        _add_translations(candidates, read, translated)
    return HeardText(text, tuple(candidates.values()), refusal, translated)


def _add_translations(
    candidates: dict[object, Candidate], read: Sequence[Command], translated: TranslatedText
) -> None:
    """Add the translations, and how likely the translator finds the readings."""
    for place, each in enumerate(translated.translations):
        key = meaning(each.command)
        known = candidates.get(key, Candidate(each.command, False))
        candidates[key] = replace(
            known,
            likeness=(known.likeness or 0.0) + each.likeness,
            place=place if known.place is None else known.place,
            unsaid=len(each.unsaid) if known.place is None else known.unsaid,
        )
    for key, known in candidates.items():
        if known.place is None:
            alike = [each for each in read if meaning(each) == key] or [known.command]
            likely = [n for each in alike if (n := translated.likeness_of(each)) is not None]
            candidates[key] = replace(known, likeness=max(likely, default=None))


def _translated(
    text: str, language: str | Language | None, rooms: Sequence[str], folder: Path
) -> TranslatedText | None:
    """The translations of a text, without those with a room that does not exist.

    None of a text in another language than the one that is asked for.
    """
    try:
        if language is not None and language_of_text(text) != language_of(language):
            return None
        found = translate(text, rooms, load_translator(folder))
    except CommandError:
        return None
    if found is None:
        return None
    kept = tuple(each for each in found.translations if _has_rooms(each.command, rooms))
    return replace(found, translations=kept)


def _has_rooms(command: Command, rooms: Sequence[str]) -> bool:
    try:
        check_rooms(command, "", rooms)
    except CommandError:
        return False
    return True


def meaning(command: Command) -> object:
    """A key that is equal for commands of the same meaning by the rules of docs/commands.md."""
    try:
        return normal(meaning_of(command))
    except TypeError:  # a clause without a step in the notation, such as a search
        return command
