"""Texts about which a robot asks, whatever its limits are."""

from __future__ import annotations

from semnav_env.language import AmbiguousCommandError, CommandError, Question, parse

DOUBTFUL = (
    "take the first or the second door on the right",
    "first door, or was it the second, on the left",
    "turn at the intersection",
    "go back",
    "geh zurück",
    "take the second door, left",
)


def asked_about() -> tuple[str, Question]:
    """A text that is asked about, and the question, which names two choices."""
    for text in DOUBTFUL:
        try:
            parse(text)
        except AmbiguousCommandError as error:
            if error.question.names_both:
                return text, error.question
        except CommandError:
            continue
    raise AssertionError(f"none of {', '.join(DOUBTFUL)} is asked about")
