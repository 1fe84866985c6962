"""Understands a text: all that it may mean is ranked, and the robot acts, asks or refuses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from semnav_env.language.clauses import GoToDoor
from semnav_env.language.command import Command
from semnav_env.language.errors import CommandError
from semnav_env.language.interpreters import Interpretation
from semnav_env.language.language import Language
from semnav_env.language.languages import language_of
from semnav_env.language.normalise import normalise
from semnav_env.language.parser import STOP_AT_ONCE
from semnav_env.language.question import AmbiguousCommandError, Ask, Question, ask_until_clear
from semnav_env.language.speech.recognition import language_of_text
from semnav_env.language.speech.understanding import QUESTION
from semnav_env.language.stops import begins_or_ends_with_stop, is_stop
from semnav_env.language.translating.candidates import Candidate, HeardText, heard
from semnav_env.language.translating.network import TRAINED_FOLDER
from semnav_env.language.translating.ranking import ranked

SETTLED = (QUESTION, "a distance is")
"""How problems begin that the grammar has understood: "30 cm" is no occasion to ask about 30 m."""


@dataclass(frozen=True)
class AskingLimits:
    """Probabilities from which an interpreter acts or asks.

    The values were chosen with translators and rankers that had not learned from the author who was
    measured, see docs/lab/language.md.

    Attributes:
        acting: least probability of a candidate that is acted on without a question.
        asking: least probability of the candidates of a question together.
        choices: the most candidates in a question.
    """

    acting: float = 0.85
    asking: float = 0.35
    choices: int = 2


@dataclass(frozen=True)
class LearnedInterpreter:
    """Ranks the readings of the grammar and those of a learned translator.

    The robot acts if one candidate is likely enough, and asks which of two is meant if they are
    likely together. Otherwise it refuses the text, with what the grammar says of it.

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
            AmbiguousCommandError: it is open which of two candidates is meant.
            CommandError: no candidate is likely; it is the error of the grammar if that has one.
        """
        if isinstance(text, str) and is_stop(text):
            return self._stop(text)
        found = heard(text, self.language, self.rooms, self.folder)
        if found.readings == 1 and found.refusal is None:
            only = found.candidates[0]
            if self._is_canonical(text, only.command):
                return self._taken(text, only, 1.0)
        order = ranked(found, self.folder)
        if order and self._may_act(*order[0]) and not _is_settled(found):
            return self._taken(text, *order[0])
        if isinstance(text, str) and begins_or_ends_with_stop(text):
            return self._stop(text)
        raise self._doubt(found, order)

    def _may_act(self, found: Candidate, share: float) -> bool:
        """Whether a candidate is likely enough, and no number, side or room is lost on the way."""
        return share >= self.limits.acting and (found.read or found.unsaid == 0)

    def _stop(self, text: str) -> Interpretation:
        """A stop, in whatever text; its language does not matter."""
        return Interpretation(text, STOP_AT_ONCE, language_of(self.language or "en"), "grammar")

    def _taken(self, text: str, found: Candidate, share: float) -> Interpretation:
        by = "grammar" if found.read else "translator"
        return Interpretation(text, (found.command,), self._spoken(text), by, share)

    def _doubt(self, text: HeardText, order: Sequence[tuple[Candidate, float]]) -> CommandError:
        """The question, or the refusal.

        Where the grammar knows which of its readings is open, it is asked as it says.
        """
        asked = text.refusal
        if isinstance(asked, AmbiguousCommandError) and asked.question.is_plain:
            return AmbiguousCommandError(text.text, replace(asked.question, read=self._read))
        if text.refusal is None and text.readings > 1:
            order = [(each, share) for each, share in order if each.read]
            readings = tuple(each.command for each, _ in order[: self.limits.choices])
            question = Question(readings, self._spoken(text.text), self._read)
            return AmbiguousCommandError(text.text, question)
        order = [each for each in order if text.speaks_of(each[0])]
        likely = order[: self.limits.choices]
        if sum(share for _, share in likely) < self.limits.asking or _is_settled(text):
            unread = CommandError("this is not understood", text.text[:200])
            return text.refusal or unread
        second = [each for each, share in likely[1:] if share >= self.limits.asking / 5]
        choices = (likely[0][0].command, *(each.command for each in second))
        question = Question(choices, self._spoken(text.text), self._read)
        return AmbiguousCommandError(text.text, question)

    def _is_canonical(self, text: str, command: Command) -> bool:
        """Whether a text has the canonical words of a command, which are never doubted.

        A door alone counts as canonical if it has no more words than its canonical form: "the
        door".
        """
        spoken = self._spoken(text)
        said = normalise(text, spoken).text.rstrip(spoken.punctuation)
        match command.clauses:
            case (GoToDoor(door, _, True),) if len(said.split()) <= len(door.say(spoken).split()):
                return True
        return said == normalise(command.say(spoken), spoken).text

    def _read(self, text: str) -> Command:
        return self.interpret(text).command

    def _spoken(self, text: str) -> Language:
        return language_of_text(text, self.language)


def _is_settled(text: HeardText) -> bool:
    """Whether a text stays refused: a question, a length that cannot be said, a prohibition.

    The translator often takes a forbidden thing, or one of two things, for the wanted one.
    """
    if text.refusal is None or isinstance(text.refusal, AmbiguousCommandError):
        return False
    return text.refusal.problem.startswith(SETTLED) or text.support.is_forbidding


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
