"""Errors for clauses that cannot be grounded."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from semnav_env.language.language import Language


class GroundingError(ValueError):
    """The referent of a clause cannot be there; the message says what is there."""

    def in_words_of(self, language: Language) -> GroundingError:
        """A copy of the error with any words of the command in the given language."""
        return self


class UnclearError(GroundingError):
    """The clause is not clear: several things fit it, or it needs other words."""
