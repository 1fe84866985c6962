"""Command lines into frozen dataclasses, with one-line errors."""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from contextlib import redirect_stderr
from typing import Any, Protocol, cast

import tyro


class Runnable(Protocol):
    """The arguments of a sub-command, which know how to run it."""

    def run(self) -> int:
        """Do it, and return the exit code."""


class Help(Exception):  # noqa: N818 - not an error: the help was asked for and printed
    """The help was printed; there is nothing to run."""


def parse(arguments: Any, words: Sequence[str], prog: str) -> Runnable:
    """Read command-line words as an instance of `arguments`.

    Args:
        arguments: a dataclass with a `run` method, or a union of such.
        words: what follows the name of the command.
        prog: how help and errors call the command.

    Raises:
        Help: the help was asked for and printed.
        ValueError: the words do not fit; one line says which and what would.
    """
    box = io.StringIO()
    try:
        with redirect_stderr(box):
            return cast(Runnable, tyro.cli(arguments, args=list(words), prog=prog))
    except SystemExit as stop:
        if not stop.code:
            raise Help from None
        raise ValueError(f"{_unboxed(box.getvalue())} (see {prog} --help)") from None


def _unboxed(box: str) -> str:
    """The sentences of tyro's error box, without its frame, title and advice."""
    rows = [re.sub("[│─╭╮╰╯]+", " ", row).strip() for row in box.splitlines()[1:]]
    text = " ".join(row for row in rows if row)
    return re.split(r" ?(?:Argument helptext:|For full helptext|Full helptext)", text)[0].strip()
