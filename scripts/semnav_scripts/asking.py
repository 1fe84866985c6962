"""Asks the person at the terminal about an ambiguous command."""

from __future__ import annotations

import sys

from semnav_env.language import Ask


def asking() -> Ask | None:
    """A function that asks at the terminal; None without one, as in a pipe or a script."""
    return _ask if sys.stdin.isatty() and sys.stderr.isatty() else None


def _ask(question: str) -> str:
    """Print a question and read a line; the end of the input is no answer.

    Both use the terminal and not the standard output, which may be a file.
    """
    print(f"{question} ", end="", file=sys.stderr, flush=True)
    line = sys.stdin.readline()
    if not line:
        raise ValueError("there is no answer; say the whole command")
    return line.strip()
