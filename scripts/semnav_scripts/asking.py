"""Asks the person at the terminal what a command leaves open."""

from __future__ import annotations

import sys

from semnav_env.language import Ask


def asking() -> Ask | None:
    """Asks at the terminal; None where nobody sits at one, as in a pipe or a script."""
    return _ask if sys.stdin.isatty() and sys.stderr.isatty() else None


def _ask(question: str) -> str:
    """Print a question and read a line; an end of the input is no answer.

    Both go by the terminal and not by the output, which may be a file.
    """
    print(f"{question} ", end="", file=sys.stderr, flush=True)
    line = sys.stdin.readline()
    if not line:
        raise ValueError("there is no answer; say the whole command")
    return line.strip()
