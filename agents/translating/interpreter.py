"""Asks where the grammar refuses a text, or where a translator would do something else."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from semnav_env.agents.translating.files import BUNDLED_FOLDER, load_translator
from semnav_env.agents.translating.translator import Translation, translate
from semnav_env.commands.clauses import Stop
from semnav_env.commands.command import Command
from semnav_env.commands.corpora.meanings import meaning_of, normal
from semnav_env.commands.errors import AmbiguousCommandError, CommandError
from semnav_env.commands.interpreters import Interpretation
from semnav_env.commands.language import Language
from semnav_env.commands.languages import english, language_of, languages
from semnav_env.commands.normalise import normalise
from semnav_env.commands.parser import check_rooms, differences, readings
from semnav_env.commands.speech.lexicon import lexicon_of, parts_of
from semnav_env.commands.speech.recognition import recognised
from semnav_env.commands.words import pieces

ENOUGH = 0.8
"""Least probability of a translation that is asked about, chosen on the second author's sets, of
which the bundled network read nothing: from here on none of their feasible texts is asked about
wrongly."""

DIFFERING = 0.9
"""Least probability of a translation that is asked about beside what the grammar understands,
chosen on the same sets: with less, more is asked needlessly and no more misreadings are
prevented."""

NEVER_ASKED = ("beyond", "no", "not", "instead", "but", "or")
"""Kinds of words with which no text is asked about: things that no robot can do, corrections,
negations and choices, which the translator often takes for the opposite."""


class TranslationQuestionError(AmbiguousCommandError):
    """A text that the grammar refuses, and that may mean what a network takes it for.

    Attributes:
        likeness: how likely that is as the network sees it, 0 to 1.
    """

    def __init__(self, text: str, command: Command, said: str, likeness: float) -> None:
        super().__init__(text, (command,), (said,))
        self.problem = f'did you mean "{said}"?'
        self.hint = "say that, or say it in other words"
        self.args = (text, command, said, likeness)
        self.likeness = likeness


@dataclass(frozen=True)
class LearnedInterpreter:
    """The grammar with a learned translator as a second opinion.

    The translation is never carried out without a question. Where the grammar refuses a text, the
    interpreter asks whether a likely translation is meant. Where the grammar has one reading, and a
    very likely translation means something else, it asks which of both.

    Attributes:
        language: code, or a loaded language; None to recognise it.
        rooms: names of the rooms of the floor plan; none if they are not known.
        enough: least probability of a translation that is asked about where the grammar refuses.
        differing: least probability of a translation that is asked about beside the grammar's
            reading; above 1 for never.
        folder: of the translator's files.
    """

    language: str | Language | None = None
    rooms: Sequence[str] = ()
    enough: float = ENOUGH
    differing: float = DIFFERING
    folder: Path = BUNDLED_FOLDER

    def interpret(self, text: str) -> Interpretation:
        """Every reading that the grammar finds.

        Raises:
            TranslationQuestionError: the grammar refuses the text, and a translation is likely.
            AmbiguousCommandError: the grammar asks, or a translation differs from its reading.
            CommandError: the text is refused; it is the error of the grammar.
        """
        try:
            found = readings(text, self.language, self.rooms)
        except AmbiguousCommandError:
            raise
        except CommandError as error:
            question = self._question(text)
            raise (question or error) from None
        spoken = self._spoken(text)
        other = self._other(text, found[0]) if len(found) == 1 else None
        if other is not None:
            both = (found[0], other)
            raise AmbiguousCommandError(text[:200], both, differences(both, spoken))
        return Interpretation(text, found, spoken, "grammar")

    def _other(self, text: str, command: Command) -> Command | None:
        """A very likely translation that means something else than a command; None without one."""
        spoken = self._spoken(text)
        said = normalise(text, spoken).text.rstrip(spoken.punctuation)
        if said == normalise(command.say(spoken), spoken).text:
            return None
        other = self._translation(text)
        if other is None or other.likeness < self.differing or other.unsaid:
            return None
        return None if _is_same(command, other.command) else other.command

    def _translation(self, text: str) -> Translation | None:
        """A translation that names only rooms that there are."""
        found = translate(text, self.rooms, load_translator(self.folder))
        if found is not None:
            check_rooms(found.command, text, self.rooms)
        return found

    def _question(self, text: str) -> TranslationQuestionError | None:
        """What to ask about a text that the grammar refuses; None if nothing."""
        try:
            translation = self._translation(text)
        except CommandError:
            return None
        if translation is None or not self._is_asked(translation):
            return None
        said = translation.command.say(self._spoken(text))
        return TranslationQuestionError(text[:200], translation.command, said, translation.likeness)

    def _is_asked(self, translation: Translation) -> bool:
        """Whether a translation is likely, and nothing that the text says is lost in it."""
        idle = all(isinstance(clause, Stop) for clause in translation.command.clauses)
        said = translation.likeness >= self.enough and not translation.unsaid
        return said and not idle and _is_known(translation.words)

    def _spoken(self, text: str) -> Language:
        if self.language is not None:
            return language_of(self.language)
        return recognised([piece.text for piece in pieces(normalise(text, english()).text)])


def _is_known(words: Sequence[str]) -> bool:
    """Whether the grammar knows every word, and none of a kind in which a translation errs."""
    lexica = [lexicon_of(language) for language in languages().values()]
    for at, word in enumerate(words):
        if any(lexicon.find(words, at, kind) for lexicon in lexica for kind in NEVER_ASKED):
            return False
        known = any(lexicon.words.issuperset(parts_of(word, lexicon)) for lexicon in lexica)
        if word.isalpha() and not known:
            return False
    return True


def _is_same(one: Command, other: Command) -> bool:
    """Whether two commands lead to the same by the rules of docs/commands.md."""
    try:
        return normal(meaning_of(one)) == normal(meaning_of(other))
    except TypeError:  # a clause without a step in the notation, such as a search
        return one == other
