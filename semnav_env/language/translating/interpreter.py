"""Understands a text: by how likely its translations are the robot acts, asks or refuses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from semnav_env.language.canonical import read_canonical
from semnav_env.language.clauses import Stop
from semnav_env.language.command import Command, room_of
from semnav_env.language.errors import CommandError
from semnav_env.language.interpreters import Interpretation
from semnav_env.language.language import Language
from semnav_env.language.languages import language_of
from semnav_env.language.named_rooms import check_rooms
from semnav_env.language.question import AmbiguousCommandError, Ask, Question, ask_until_clear
from semnav_env.language.rooms import plain_name
from semnav_env.language.stops import begins_or_ends_with_stop, is_stop
from semnav_env.language.translating.defaults import with_defaults
from semnav_env.language.translating.network import TRAINED_FOLDER, load_translator
from semnav_env.language.translating.refusal import Refusal, refused_language
from semnav_env.language.translating.translator import TranslatedText, translate
from semnav_env.language.translating.unknown_words import rests_on_known_words
from semnav_env.language.vocabulary.recognition import language_of_text
from semnav_env.language.vocabulary.room_words import shared_kinds


@dataclass(frozen=True)
class AskingLimits:
    """Probabilities from which an interpreter acts or asks.

    The values were chosen with translators that had not learned from the author who was measured,
    see docs/lab/language.md.

    Attributes:
        acting: least probability of a translation that is acted on without a question.
        asking: least probability of the choices of a question together.
        choices: the most choices of a question.
    """

    acting: float = 0.93
    asking: float = 0.3
    choices: int = 2


@dataclass(frozen=True)
class LearnedInterpreter:
    """Acts on what a learned translator takes a text for.

    The robot acts if one translation is likely enough, and asks which of two is meant if they are
    likely together. Otherwise it refuses the text. Canonical words and calls to stop are never
    doubted.

    Attributes:
        language: code, or a loaded language; None to recognise it.
        rooms: names of the rooms of the floor plan; none if they are not known.
        limits: probabilities from which it acts or asks.
        folder: of the files of the translator.
    """

    language: str | Language | None = None
    rooms: Sequence[str] = ()
    limits: AskingLimits = AskingLimits()
    folder: Path = TRAINED_FOLDER

    def interpret(self, text: str) -> Interpretation:
        """What a text most likely means.

        Raises:
            AmbiguousCommandError: it is open which of two commands is meant.
            CommandError: no command is likely.
        """
        if isinstance(text, str) and is_stop(text):
            return self._stop(text)
        spoken = language_of_text(text, self.language)
        if command := read_canonical(text, spoken):
            check_rooms(command, text, self.rooms, spoken)
            return Interpretation(text, command, spoken, "canonical words")
        if self.language is not None and (error := refused_language(text, spoken)):
            raise error
        found = translate(text, self.rooms, load_translator(self.folder))
        if found and (which := self._which_of_a_kind(text, spoken, found)):
            raise which
        if found and self._is_sure(found):
            likeliest = found.translations[0]
            command = with_defaults(likeliest.command, found.support)
            return Interpretation(text, command, spoken, "translator", likeliest.likeness)
        if begins_or_ends_with_stop(text):
            return self._stop(text)
        refusal = Refusal(text, spoken, self.rooms, found)
        question = self._which_room(refusal) or (found and self._question(text, spoken, found))
        raise question or refusal.error

    def _stop(self, text: str) -> Interpretation:
        """A stop, in whatever text; its language does not matter."""
        spoken = language_of(self.language or "en")
        return Interpretation(text, Command((Stop(),)), spoken, "stop")

    def _is_sure(self, found: TranslatedText) -> bool:
        """Whether the likeliest translation is acted on."""
        is_likely = any(each.likeness >= self.limits.acting for each in found.translations[:1])
        return is_likely and rests_on_known_words(found, self.rooms)

    def _which_room(self, refusal: Refusal) -> AmbiguousCommandError | None:
        """The question whether an unknown word is the room whose name it is near."""
        known = refusal.found.plain.rooms if refusal.found else ()
        for text in refusal.with_a_room():
            try:
                command = self._read(text)
            except CommandError:
                continue
            named = {room_of(clause) for clause in command.clauses}.difference(known)
            for meant in (each for each in self.rooms if plain_name(each) in named):
                question = Question((command,), refusal.spoken, self._read, meant)
                return AmbiguousCommandError(refusal.text, question)
        return None

    def _which_of_a_kind(
        self, text: str, spoken: Language, found: TranslatedText
    ) -> AmbiguousCommandError | None:
        """The question which room is meant where a text names a kind of which there are several."""
        words = found.plain.words
        for kind, names in shared_kinds(tuple(self.rooms)).items():
            for at in range(len(words)):
                if words[at : at + len(kind)] == kind:
                    texts = (" ".join((*words[:at], n, *words[at + len(kind) :])) for n in names)
                    try:
                        readings = tuple(dict.fromkeys(map(self._read, texts)))
                    except CommandError:
                        continue
                    if len(readings) > 1:
                        return AmbiguousCommandError(text, Question(readings, spoken, self._read))
        return None

    def _question(
        self, text: str, spoken: Language, found: TranslatedText
    ) -> AmbiguousCommandError | None:
        """The question which of two commands is meant; None if none of them is likely."""
        order = [each for each in found.translations if found.support.speaks_of(each.command)]
        likely = order[: self.limits.choices]
        if sum(each.likeness for each in likely) < self.limits.asking:
            return None
        second = [each for each in likely[1:] if each.likeness >= self.limits.asking / 5]
        choices = tuple(each.command for each in (likely[0], *second))
        return AmbiguousCommandError(text, Question(choices, spoken, self._read))

    def _read(self, text: str) -> Command:
        return self.interpret(text).command


def parse(
    text: str,
    language: str | Language | None = None,
    rooms: Sequence[str] = (),
    ask: Ask | None = None,
) -> Command:
    """The command that a text means, see `LearnedInterpreter`.

    Args:
        text: for example "go down the hallway, turn left and go in the first door on the right";
            docs/guides/language.md tells what is understood.
        language: "en", "de" or a `Language`; by default it is recognised.
        rooms: the names of the rooms that there are; empty if they are not known. If given, only
            these are understood, and they need no quotation marks.
        ask: asks a person what is meant where the text leaves it open, such as `input`. Without it
            that is an error.

    Returns:
        The command; `parse(command.say(language), language) == command`.

    Raises:
        CommandError: the text is not understood.
        AmbiguousCommandError: it is open which of two commands is meant; `error.readings` are they.
        ValueError: there is no such language.
    """
    try:
        return LearnedInterpreter(language, rooms).interpret(text).command
    except AmbiguousCommandError as error:
        if ask is None:
            raise
        return ask_until_clear(error, ask)


def correct(command: Command, text: str, language: str | Language = "en") -> Command:
    """A command with its end corrected by a text such as "no, the left one".

    Raises:
        CommandError: the text does not correct that command.
    """
    reader = LearnedInterpreter(language, limits=AskingLimits(acting=AskingLimits.asking))
    return reader.interpret(f"{command.say(language)}, {text}").command
