"""What the robot makes of a text: a command, a question, or a refusal."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

from semnav_env.language import (
    AmbiguousCommandError,
    Command,
    CommandError,
    Question,
    corrections,
    parse,
)
from semnav_env.language.language import Language
from semnav_env.language.vocabulary.recognition import language_of_text


@dataclass(frozen=True)
class Understood:
    """A text that means one command.

    Attributes:
        text: what was said.
        command: what it means.
        language: of the speaker.
        corrections: a line for each word that was corrected into another.
    """

    text: str
    command: Command
    language: Language
    corrections: tuple[str, ...] = ()

    def message(self, carried_out: Command) -> dict[str, Any]:
        """What was understood, clause by clause in canonical words.

        Args:
            carried_out: the command with the steps that go without saying.
        """
        return {
            "type": "understood",
            "text": self.text,
            "corrections": list(self.corrections),
            "clauses": [clause.say(self.language) for clause in carried_out.clauses],
        }


@dataclass(frozen=True)
class Asked:
    """A text that leaves something open.

    Attributes:
        text: what was said.
        question: settles it.
    """

    text: str
    question: Question

    @property
    def message(self) -> dict[str, Any]:
        """The question with the answers that the page offers, at most two."""
        names = [choice.name for choice in self.question.choices]
        return {
            "type": "asked",
            "text": self.text,
            "question": self.question.text,
            "choices": names if self.question.names_both else ["yes", "no"],
        }


@dataclass(frozen=True)
class Refused:
    """A text that is no command here.

    Attributes:
        text: what was said.
        why: what is wrong with it.
        position: index of the first faulty character; None for the whole text.
        length: number of faulty characters.
    """

    text: str
    why: str
    position: int | None = None
    length: int = 0

    @property
    def message(self) -> dict[str, Any]:
        """The refusal, with the place of the faulty words."""
        return {"type": "refused", **vars(self)}


def understand(
    text: str, language: str | None, rooms: Sequence[str]
) -> Understood | Asked | Refused:
    """What a text means.

    Args:
        text: what was said.
        language: "en" or "de"; recognised if not given.
        rooms: names of the rooms that there are.
    """
    found = _outcome(text, language, lambda: parse(text, language, rooms))
    if not isinstance(found, Understood):
        return found
    lines = tuple(each.say(found.language) for each in corrections(text, rooms))
    return replace(found, corrections=lines)


def understand_answer(asked: Asked, answer: str) -> Understood | Asked | Refused:
    """What a text means, given an answer to the question about it."""
    code = asked.question.language.code
    found = _outcome(answer, code, lambda: asked.question.answer(answer))
    if isinstance(found, Refused):
        return Refused(asked.text, found.why)
    if isinstance(found, Understood):  # the answer alone would mean nothing
        return replace(found, text=found.command.say(found.language))
    return found


def _outcome(
    text: str, language: str | None, read: Callable[[], Command]
) -> Understood | Asked | Refused:
    try:
        return Understood(text, read(), language_of_text(text, language))
    except AmbiguousCommandError as error:
        return Asked(text, error.question)
    except CommandError as error:
        return Refused(text, error.summary, error.position, error.length)
