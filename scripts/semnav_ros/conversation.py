"""What the node hears: texts become commands, questions or refusals."""

from __future__ import annotations

from semnav_env.language import (
    AmbiguousCommandError,
    Command,
    CommandError,
    Question,
    Stop,
    encode,
    parse,
)
from semnav_env.language.languages import language_of
from semnav_env.language.vocabulary.recognition import language_of_text

STOP = Command((Stop(),))
"""What a call to stop means."""


class Conversation:
    """Hears texts one after another.

    Args:
        language: of the texts: "en" or "de"; recognised if not given.

    Attributes:
        text: what was heard last.
        question: what is open; None if nothing is.
        said: the open question, or why the last text was refused; empty if there is neither.
        spoken: language of the last command.
    """

    def __init__(self, language: str | None = None) -> None:
        self._language = language
        self.text = self.said = ""
        self.question: Question | None = None
        self.spoken = language_of(language or "en")
        self._parse("stop")  # loads what hears a stop, before anybody calls

    def hear(self, text: str) -> Command | None:
        """The command that a text means; None if the robot asks about it or refuses it."""
        question, self.question = self.question, None
        self.text, self.said = text, ""
        try:
            command = question.answer(text) if question else self._parse(text)
            encode(command)
        except AmbiguousCommandError as error:
            self.question, self.said = error.question, error.question.text
        except CommandError as error:
            self.said = error.summary
        except ValueError as error:  # of `encode`: a room, to which nobody has told the way
            self.said = str(error)
        else:
            self.spoken = question.language if question else language_of_text(text, self._language)
            return command
        return None

    def refuse(self, text: str, why: str) -> None:
        """Note a text that is not even read, and why."""
        self.text, self.said, self.question = text, why, None

    def _parse(self, text: str) -> Command:
        return parse(text, self._language)
