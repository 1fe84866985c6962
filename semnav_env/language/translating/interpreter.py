"""Understands a text: its translations are ranked, and the robot acts, asks or refuses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from semnav_env.language.canonical import read_canonical
from semnav_env.language.clauses import Stop
from semnav_env.language.command import Command
from semnav_env.language.interpreters import Interpretation
from semnav_env.language.language import Language
from semnav_env.language.languages import language_of
from semnav_env.language.named_rooms import check_rooms
from semnav_env.language.question import AmbiguousCommandError, Ask, Question, ask_until_clear
from semnav_env.language.stops import begins_or_ends_with_stop, is_stop
from semnav_env.language.translating.defaults import with_defaults
from semnav_env.language.translating.network import TRAINED_FOLDER, load_translator
from semnav_env.language.translating.ranking import ranked
from semnav_env.language.translating.refusal import Refusal, refused_language
from semnav_env.language.translating.translator import TranslatedText, Translation, translate
from semnav_env.language.vocabulary.recognition import language_of_text


@dataclass(frozen=True)
class AskingLimits:
    """Probabilities from which an interpreter acts or asks.

    The values were chosen with translators and rankers that had not learned from the author who was
    measured, see docs/lab/language.md.

    Attributes:
        acting: least probability of a translation that is acted on without a question.
        asking: least probability of the choices of a question together.
        choices: the most choices of a question.
    """

    acting: float = 0.85
    asking: float = 0.35
    choices: int = 2


@dataclass(frozen=True)
class LearnedInterpreter:
    """Ranks what a learned translator takes a text for.

    The robot acts if one translation is likely enough, and asks which of two is meant if they are
    likely together. Otherwise it refuses the text. Canonical words and calls to stop are never
    doubted.

    Attributes:
        language: code, or a loaded language; None to recognise it.
        rooms: names of the rooms of the floor plan; none if they are not known.
        limits: probabilities from which it acts or asks.
        folder: of the files of translator and ranker.
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
            check_rooms(command, text, self.rooms)
            return Interpretation(text, command, spoken, "canonical words")
        if self.language is not None and (error := refused_language(text, spoken)):
            raise error
        found = translate(text, self.rooms, load_translator(self.folder))
        order = ranked(found, self.folder) if found else []
        if found and order and self._may_act(found, order[0][1]):
            likeliest, share = order[0]
            command = with_defaults(likeliest.command, found.support)
            return Interpretation(text, command, spoken, "translator", share)
        if begins_or_ends_with_stop(text):
            return self._stop(text)
        if question := self._question(text, spoken, found, order):
            raise question
        raise Refusal(text, spoken, self.rooms, found).error

    def _may_act(self, text: TranslatedText, share: float) -> bool:
        """Whether a command is likely enough, and the text neither forbids nor leaves a choice.

        The translator often takes the forbidden thing, or one of two, for the wanted one.
        """
        return share >= self.limits.acting and not text.support.leaves_open

    def _stop(self, text: str) -> Interpretation:
        """A stop, in whatever text; its language does not matter."""
        spoken = language_of(self.language or "en")
        return Interpretation(text, Command((Stop(),)), spoken, "stop")

    def _question(
        self,
        text: str,
        spoken: Language,
        found: TranslatedText | None,
        order: Sequence[tuple[Translation, float]],
    ) -> AmbiguousCommandError | None:
        """The question which of two commands is meant; None if none of them is likely."""
        order = [each for each in order if found and found.support.speaks_of(each[0].command)]
        likely = order[: self.limits.choices]
        if sum(share for _, share in likely) < self.limits.asking:
            return None
        second = [each for each, share in likely[1:] if share >= self.limits.asking / 5]
        choices = (likely[0][0].command, *(each.command for each in second))
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
            docs/language.md tells what is understood.
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
