"""Asks where the grammar refuses a text, or where a translator doubts what it takes it for."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from semnav_agents.networks.card import BUNDLED_FOLDER
from semnav_agents.translating.network import load_translator
from semnav_agents.translating.support import TextSupport
from semnav_agents.translating.translator import TranslatedText, Translation, translate
from semnav_env.language.clauses import GoToDoor, Stop
from semnav_env.language.command import Command
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.defaults import decided
from semnav_env.language.errors import CommandError
from semnav_env.language.interpreters import Interpretation
from semnav_env.language.language import Language
from semnav_env.language.normalise import normalise
from semnav_env.language.parser import check_rooms, readings
from semnav_env.language.question import AmbiguousCommandError, Ask, Question, ask_until_clear
from semnav_env.language.speech.recognition import language_of_text
from semnav_env.language.speech.understanding import QUESTION

SETTLED = (QUESTION, "a distance is")
"""How problems begin that the grammar has understood: "30 cm" is no occasion to ask about 30 m."""


@dataclass(frozen=True)
class DoubtLimits:
    """From which probabilities on an interpreter acts or asks.

    They were chosen with networks that had not learned from the author who was measured, see
    docs/language.md.

    Attributes:
        acting: least probability of the grammar's reading that is acted on without a question.
        beside: least probability of a translation that is asked about beside the grammar's.
        asking: least probability of a translation that is asked about where the grammar refuses.
        refusing: greatest probability that a text is no command at which it is asked about.
        choices: the most translations in a question.
    """

    acting: float = 0.14
    beside: float = 0.02
    asking: float = 0.05
    refusing: float = 0.2
    choices: int = 3


@dataclass(frozen=True)
class LearnedInterpreter:
    """The grammar with a learned translator as a second opinion.

    A translation is never carried out without a question. The robot acts where the grammar has one
    reading that the translator takes for likely, too. Where it does not, it asks which of both is
    meant. Where the grammar refuses a text, it asks whether a likely translation is meant.

    Attributes:
        language: code, or a loaded language; None to recognise it.
        rooms: names of the rooms of the floor plan; none if they are not known.
        limits: from which probabilities on it acts or asks.
        folder: of the translator's files.
    """

    language: str | Language | None = None
    rooms: Sequence[str] = ()
    limits: DoubtLimits = DoubtLimits()
    folder: Path = BUNDLED_FOLDER / "translator"

    def interpret(self, text: str) -> Interpretation:
        """The reading that the grammar finds.

        Raises:
            AmbiguousCommandError: the grammar asks, or the text is refused or doubtful and some
                command is likely.
            CommandError: the text is refused; it is the error of the grammar.
        """
        try:
            every = readings(text, self.language, self.rooms)
        except AmbiguousCommandError as error:
            raise (self._refusal(text, error) or self._wider(text, error) or error) from None
        except CommandError as error:
            is_settled = error.problem.startswith(SETTLED)
            raise ((None if is_settled else self._question(text)) or error) from None
        found = decided(every)
        spoken, (first, *more) = self._spoken(text), found
        if more:
            others = self._others(text, every, 1)
            return Interpretation(text, (*found, *others), spoken, "grammar")
        if not self._is_certain(text, first) and (doubt := self._doubt(text, first, every)):
            raise doubt
        return Interpretation(text, found, spoken, "grammar")

    def _is_certain(self, text: str, command: Command) -> bool:
        """Whether a text is never doubted: a stop, or what the robot itself would say.

        A door alone in no more words than it has in canonical ones is that, too: "the door".
        """
        spoken = self._spoken(text)
        said = normalise(text, spoken).text.rstrip(spoken.punctuation)
        match command.clauses:
            case clauses if all(clause == Stop() for clause in clauses):
                return True
            case (GoToDoor(door, _, True),) if len(said.split()) <= len(door.say(spoken).split()):
                return True
        return said == normalise(command.say(spoken), spoken).text

    def _doubt(
        self, text: str, command: Command, every: Sequence[Command]
    ) -> AmbiguousCommandError | None:
        """The question whether a text means the grammar's reading; None to act on it.

        Readings between which it went without saying are not doubted against each other.
        """
        translated = self._translated(text)
        if translated is None:
            return None
        known = [n for each in every if (n := translated.likeness_of(each)) is not None]
        if not known and translated.has_sides_of(command):
            return None  # such as a search, for which there are no symbols
        if sum(known) >= self.limits.acting:
            return None
        others = self._others(text, every, self.limits.choices - 1)
        return self._asked(text, (command, *others))

    def _refusal(self, text: str, error: AmbiguousCommandError) -> CommandError | None:
        """The refusal of a text with words left out that the translator takes for no command."""
        translated = self._translated(text) if error.question.unread else None
        if translated is None or translated.refusal <= self.limits.refusing:
            return None
        return CommandError(f'"{error.question.unread}" is not understood', text[:200])

    def _wider(self, text: str, error: AmbiguousCommandError) -> AmbiguousCommandError | None:
        """A question with what the translator takes a text for beside the grammar's readings."""
        others = self._others(text, error.readings, 1)
        if not others:
            return None
        return self._asked(text, (*error.readings, *others))

    def _question(self, text: str) -> AmbiguousCommandError | None:
        """What to ask about a text that the grammar refuses; None if nothing."""
        translated = self._translated(text)
        if translated is None or translated.refusal > self.limits.refusing:
            return None
        support = TextSupport.of(translated.plain.words)
        if support.is_impossible or support.is_forbidding:
            return None
        found_likely = self._likely(translated, (), self.limits.asking)
        likely = [each for each in found_likely if support.speaks_of(each.command)]
        likely = likely[: self.limits.choices]
        if not likely:
            return None
        return self._asked(text, tuple(each.command for each in likely))

    def _asked(self, text: str, found: tuple[Command, ...]) -> AmbiguousCommandError:
        return AmbiguousCommandError(text, Question(found, self._spoken(text), self._read))

    def _others(self, text: str, known: Sequence[Command], count: int) -> tuple[Command, ...]:
        """The likeliest commands besides those that are known."""
        translated = self._translated(text)
        if translated is None:
            return ()
        likely = self._likely(translated, known, self.limits.beside)
        return tuple(each.command for each in likely[:count])

    def _likely(
        self, translated: TranslatedText, known: Iterable[Command], least: float
    ) -> list[Translation]:
        """The translations from a probability on that mean something else than what is known."""
        meant = [_meaning(command) for command in known]
        found = []
        for each in translated.translations:
            idle = all(isinstance(clause, Stop) for clause in each.command.clauses)
            meaning = _meaning(each.command)
            if each.likeness >= least and not idle and meaning not in meant:
                found.append(each)
                meant.append(meaning)
        return found

    def _translated(self, text: str) -> TranslatedText | None:
        """What the translator takes a text for, without rooms that there are not."""
        try:
            found = translate(text, self.rooms, load_translator(self.folder))
            for each in found.translations if found is not None else ():
                check_rooms(each.command, text, self.rooms)
        except CommandError:
            return None
        return found

    def _read(self, text: str) -> Command:
        return self.interpret(text).command

    def _spoken(self, text: str) -> Language:
        return language_of_text(text, self.language)


def understand(
    text: str, language: str | None = None, rooms: Sequence[str] = (), ask: Ask | None = None
) -> Command:
    """The command that a text means, by the grammar and the translator, see `LearnedInterpreter`.

    The arguments are those of `semnav_env.language.parse`.

    Raises:
        AmbiguousCommandError: it is doubtful; `error.readings` are what it may mean.
        CommandError: it is not understood.
    """
    try:
        return LearnedInterpreter(language, rooms).interpret(text).command
    except AmbiguousCommandError as error:
        if ask is None:
            raise
        return ask_until_clear(error, ask)


def _meaning(command: Command) -> object:
    """What is the same for commands that lead to the same by the rules of docs/commands.md."""
    try:
        return normal(meaning_of(command))
    except TypeError:  # a clause without a step in the notation, such as a search
        return command
