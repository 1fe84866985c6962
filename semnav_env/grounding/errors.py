"""Why a clause cannot be grounded."""

from __future__ import annotations


class GroundingError(ValueError):
    """The referent of a clause cannot be there; the message says what is."""


class UnclearError(GroundingError):
    """More must be said: several things fit a clause, or something else is meant by it."""
