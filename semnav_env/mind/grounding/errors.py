"""Errors for clauses that cannot be grounded."""

from __future__ import annotations

from semnav_env.language.language import Language
from semnav_env.language.told import in_words_of

NO_WAY_TOLD = "{what}: the robot has not been told the way there"
NOT_BEHIND = "the hallway does not go on behind {place:dative}"
"""Messages of several clauses."""


class GroundingError(ValueError):
    """The referent of a clause cannot be there; the message says what is there."""

    def in_words_of(self, language: Language) -> GroundingError:
        """A copy of the error in the words of a language."""
        return type(self)(in_words_of(language, self.reason))

    def say(self, language: Language, form: str = "") -> str:
        """The message in the words of a language, as a part of another one."""
        return str(self.in_words_of(language))

    @property
    def reason(self) -> str:
        """The message, which may be a text that says itself in other languages."""
        reason: str = self.args[0]
        return reason


class UnclearError(GroundingError):
    """The clause is not clear: several things fit it, or it needs other words."""
