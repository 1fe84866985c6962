"""A command with sub-commands: runs one of them and returns an exit code.

Exit codes: 0 done; 1 not achieved; 2 bad input, with one line on stderr that names what is wrong
and what would be right; 130 interrupted by Ctrl-C; 143 terminated by SIGTERM.
"""

from __future__ import annotations

import difflib
import errno
import os
import signal
import sys
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING

from semnav_features.interruption import SIGNALS, Terminated, interrupt, interruption_in
from semnav_features.validation import clipped
from semnav_scripts.printable import printable, printing_text
from semnav_scripts.terminal_text import write_utf8

if TYPE_CHECKING:  # known to type checkers alone
    from sys import UnraisableHookArgs

_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EIO)
BAD_INPUT, INTERRUPTED, BROKEN_PIPE, TERMINATED = 2, 130, 141, 143
"""Exit codes; the last three are those of a shell for SIGINT, SIGPIPE and SIGTERM."""

LONGEST_LINE = 1000
"""Largest number of characters of an error that are shown."""

RETRY_SECONDS = 0.01
"""Time after which a signal is sent again if its exception was dropped, seconds."""


@dataclass(frozen=True)
class CommandTable:
    """A command and its sub-commands.

    Attributes:
        prog: name of the command.
        about: one sentence that says what it is for.
        commands: module and help of each sub-command, by its name. The module's `Arguments` have
            `run() -> int`; or its `COMMANDS` are a table of further sub-commands.
    """

    prog: str
    about: str
    commands: Mapping[str, tuple[str, str]]

    def main(self, argv: Sequence[str] | None = None) -> int:
        """Run with these arguments, by default those of the process.

        `--debug` anywhere, or SEMNAV_DEBUG=1 in the environment, shows where an error comes from.

        Returns:
            The exit code.
        """
        write_utf8(sys.stdout, sys.stderr)
        words = list(sys.argv[1:] if argv is None else argv)
        debug = "--debug" in words or os.environ.get("SEMNAV_DEBUG", "0") not in ("", "0")
        words = [word for word in words if word != "--debug"]
        try:
            return self._run(words)
        except BaseException as error:
            if (stop := interruption_in(error)) is not None:
                return self._interrupted(stop, error)
            if isinstance(error, BrokenPipeError):
                os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
                return BROKEN_PIPE
            if debug or not isinstance(error, ValueError | OSError | ImportError):
                raise
            print(_with_notes(f"{self.prog}: {in_one_line(error)}", error), file=sys.stderr)
            return BAD_INPUT

    def _interrupted(self, stop: KeyboardInterrupt, error: BaseException) -> int:
        """Print that a signal ended the command, and where its results so far are kept."""
        code = exit_code_of(stop)
        said = f"{self.prog}: {'terminated' if code == TERMINATED else 'interrupted'}"
        print(_with_notes(said, error), file=sys.stderr)
        return code

    def _run(self, words: list[str]) -> int:
        known = ", ".join(self.commands)
        if not words:
            raise ValueError(f"no command given; there are: {known} ({self.prog} --help)")
        name, *rest = words
        if rest and f"{name} {rest[0]}" in self.commands:
            name, rest = f"{name} {rest[0]}", rest[1:]
        if name in ("-h", "--help"):
            print(self._help())
            return 0
        if name == "--version":
            from importlib import metadata

            print(f"semnav {metadata.version('semnav-env')}")
            return 0
        if name not in self.commands:
            near = difflib.get_close_matches(name, self.commands, n=1)
            hint = f"did you mean {near[0]!r}? " if near else ""
            raise ValueError(f"no command {name!r}; {hint}there are: {known}")
        module = import_module(self.commands[name][0])
        if isinstance(further := getattr(module, "COMMANDS", None), CommandTable):
            return further._run(rest)
        from semnav_scripts.arguments import HelpShown, parse

        try:
            command = parse(module.Arguments, rest, prog=f"{self.prog} {name}")
        except HelpShown:
            return 0
        _end_loading()
        with printing_text():
            return command.run()

    def _help(self) -> str:
        width = max(map(len, self.commands)) + 2
        lines = "\n".join(f"  {name:<{width}}{help}" for name, (_, help) in self.commands.items())
        return (
            f"usage: {self.prog} COMMAND ...\n\n{self.about}\n\ncommands:\n{lines}\n\n"
            f"`{self.prog} COMMAND --help` tells a command's options; `--debug` shows where an\n"
            "error comes from; `--version` prints the version.\n"
            "exit codes: 0 done, 1 not achieved, 2 bad input, 130 Ctrl-C, 143 SIGTERM"
        )


def exit_code_of(stop: BaseException) -> int:
    """The exit code of a command that a signal ended."""
    return TERMINATED if isinstance(interruption_in(stop), Terminated) else INTERRUPTED


def _end_loading() -> None:
    """Turn signals into exceptions from here on, so that a command can save its partial results."""
    for number in SIGNALS:
        if getattr(signal.getsignal(number), "__name__", "") == "leave_at_once":
            signal.signal(number, interrupt)
    if hasattr(signal, "pthread_kill"):
        sys.unraisablehook = _interrupt_again


def _interrupt_again(lost: UnraisableHookArgs) -> None:
    """Send a signal again that came where exceptions are only reported, as in `__del__`."""
    if not isinstance(lost.exc_value, KeyboardInterrupt):
        sys.__unraisablehook__(lost)
        return
    number = signal.SIGTERM if isinstance(lost.exc_value, Terminated) else signal.SIGINT
    main_thread = threading.main_thread().ident or 0
    again = threading.Timer(RETRY_SECONDS, signal.pthread_kill, (main_thread, number))
    again.daemon = True
    again.start()


def in_one_line(error: Exception) -> str:
    """The message of an error in one line that a user understands, at most `LONGEST_LINE` long."""
    return clipped(_first_line(error), LONGEST_LINE)


def _first_line(error: Exception) -> str:
    if isinstance(error, FileExistsError):
        return f"{os.fspath(error.filename)!r} is a file, not a folder"
    if isinstance(error, OSError) and error.strerror:
        where = f" {os.fspath(error.filename)!r}" if error.filename else ""
        what = "write" if error.errno in _NO_ROOM else "open"
        return f"cannot {what}{where}: {error.strerror}"
    if isinstance(error, ModuleNotFoundError):
        package, _, inner = str(error.name).partition(".")
        if package.startswith("semnav_") and not inner:
            return (
                f"{package} is missing: the checkout has new packages since it was installed; "
                "`semnav doctor` says what to type"
            )
        if not package.startswith("semnav_"):
            return f"{error.name} is not installed; `semnav doctor` says what to install"
    lines = str(error).strip().splitlines()
    return lines[0] if lines else type(error).__name__


def _with_notes(said: str, error: BaseException | None) -> str:
    """The message with the notes of an error and its causes: where partial results are."""
    parts = [said]
    while error is not None:
        parts += getattr(error, "__notes__", ())
        error = error.__cause__ or error.__context__
    return printable("; ".join(parts))
