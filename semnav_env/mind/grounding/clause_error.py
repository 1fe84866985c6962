"""The error for one clause of a command that cannot be grounded."""

from __future__ import annotations

from typing import Any

from semnav_env.language.command import Command
from semnav_env.language.language import Language
from semnav_env.language.languages import language_of
from semnav_env.language.told import in_words_of
from semnav_env.mind.grounding.errors import GroundingError


class ClauseError(GroundingError):
    """A clause of a command with several clauses cannot be carried out; the message names it.

    Args:
        command: the command.
        clause: index of the clause.
        reason: why it cannot be carried out.
        language: of the words of the clause in the message.
    """

    def __init__(
        self, command: Command, clause: int, reason: str, language: str | Language = "en"
    ) -> None:
        super().__init__(command, clause, reason, language)
        self.command, self.clause, self._reason, self._language = command, clause, reason, language
        self._message: str | None = None

    def __str__(self) -> str:
        """The message, made only when it is read, because random draws do not need it."""
        if self._message is None:
            spoken = language_of(self._language)
            words = self.command.clauses[self.clause].say(spoken)
            self._message = spoken.tell(
                'clause {number} of {count}, "{words}", cannot be carried out: {why}',
                number=self.clause + 1,
                count=len(self.command.clauses),
                words=words,
                why=in_words_of(spoken, self.reason).removeprefix(f"{words}: "),
            )
        return self._message

    @property
    def reason(self) -> str:
        """Why the clause cannot be carried out."""
        return self._reason

    def in_words_of(self, language: Language) -> ClauseError:
        """A copy of the error with the clause in the words of a language."""
        return ClauseError(self.command, self.clause, self.reason, language)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.command, self.clause, self.reason, str(self))


def _restored(command: Command, clause: int, reason: str, message: str) -> ClauseError:
    """Restore a pickled error with its words."""
    error = ClauseError(command, clause, reason)
    error._message = message
    return error
