"""Judges what interpreters make of a corpus, beside each other."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from semnav_agents.translating.interpreter import LearnedInterpreter
from semnav_agents.translating.network import load_translator
from semnav_agents.translating.translator import translate
from semnav_env.language.command import Command
from semnav_env.language.corpora import ParseOutcome, Sentence
from semnav_env.language.corpora.meanings import meaning_of, normal
from semnav_env.language.corpora.measure import rooms_in
from semnav_env.language.defaults import decided
from semnav_env.language.errors import CommandError
from semnav_env.language.interpreters import Interpretation, Interpreter
from semnav_env.language.languages import english
from semnav_env.language.parser import readings
from semnav_env.language.question import AmbiguousCommandError


@dataclass(frozen=True)
class RecognisingGrammar:
    """The grammar, which recognises the language.

    Attributes:
        rooms: that there are.
    """

    rooms: Sequence[str]

    def interpret(self, text: str) -> Interpretation:
        """What the grammar understands."""
        found = decided(readings(text, None, self.rooms))
        return Interpretation(text, found, english(), "grammar")


@dataclass(frozen=True)
class TranslatorAlone:
    """The translator without the grammar, which acts on what it takes a text for.

    Attributes:
        rooms: that there are.
        folder: of the translator's files.
        enough: least probability of a translation that is acted on.
    """

    rooms: Sequence[str]
    folder: Path
    enough: float

    def interpret(self, text: str) -> Interpretation:
        """The likeliest command."""
        found = translate(text, self.rooms, load_translator(self.folder))
        if found is None or not found.translations or found.refusal > 0.5:
            raise CommandError("it is no command", text)
        first = found.translations[0]
        if first.likeness < self.enough:
            raise CommandError("it is not understood", text)
        return Interpretation(text, (first.command,), english(), "learned", first.likeness)


def interpreters(
    sentences: Sequence[Sentence], folder: Path, sure: float
) -> dict[str, Interpreter]:
    """The grammar, the grammar with a translator that doubts it, and the translator alone.

    Args:
        sentences: of a corpus, which tell the rooms of the building.
        folder: of the translator's files.
        sure: least probability at which the translator alone acts.
    """
    rooms = tuple(dict.fromkeys(rooms_in(each.meanings for each in sentences)))
    return {
        "grammar": RecognisingGrammar(rooms),
        "second opinion": LearnedInterpreter(rooms=rooms, folder=folder),
        "alone": TranslatorAlone(rooms, folder, sure),
    }


def outcome_of(sentence: Sentence, interpreter: Interpreter) -> ParseOutcome:
    """What an interpreter makes of a sentence."""
    try:
        found = interpreter.interpret(sentence.text).readings
    except AmbiguousCommandError as error:
        return _asked(error.readings, sentence)
    except CommandError:
        return ParseOutcome.REFUSED
    command, *others = found
    if others:
        return _asked(found, sentence)
    return ParseOutcome.UNDERSTOOD if _is_right(command, sentence) else ParseOutcome.MISREAD


def _asked(found: Sequence[Command], sentence: Sentence) -> ParseOutcome:
    right = any(_is_right(command, sentence) for command in found)
    return ParseOutcome.ASKED if right else ParseOutcome.ASKED_WRONGLY


def _is_right(command: Command, sentence: Sentence) -> bool:
    return normal(meaning_of(command)) in map(normal, sentence.meanings)


def counted(
    sentences: Sequence[Sentence], interpreter: Interpreter
) -> dict[str, Counter[ParseOutcome]]:
    """How many sentences of each kind come to which outcome."""
    counts: dict[str, Counter[ParseOutcome]] = {}
    for sentence in sentences:
        counts.setdefault(sentence.kind, Counter())[outcome_of(sentence, interpreter)] += 1
    return counts
