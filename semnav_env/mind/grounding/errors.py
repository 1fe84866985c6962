"""Why a clause cannot be grounded."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from semnav_env.language.language import Language


class GroundingError(ValueError):
    """The referent of a clause cannot be there; the message says what is."""

    def in_words_of(self, language: Language) -> GroundingError:
        """The same error with the words of the command in a language, where it has such words."""
        return self


class UnclearError(GroundingError):
    """More must be said: several things fit a clause, or something else is meant by it."""
