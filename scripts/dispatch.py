"""A command with sub-commands: runs one of them and returns an exit code.

Exit codes: 0 done; 1 not achieved; 2 bad input, with one line on stderr that names what is wrong
and what would be right; 130 interrupted by Ctrl-C; 143 by SIGTERM.
"""

from __future__ import annotations

import difflib
import errno
import os
import signal
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from types import FrameType
from typing import NoReturn

from semnav_env.features.validation import clipped
from semnav_env.scripts.printable import printable, printing_text
from semnav_env.scripts.terminal_text import write_utf8

_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EIO)
BAD_INPUT, INTERRUPTED, BROKEN_PIPE, TERMINATED = 2, 130, 141, 143
"""Exit codes; the last three are those of a shell for SIGINT, SIGPIPE and SIGTERM."""

LONGEST_LINE = 1000
"""Largest number of characters of an error that are shown."""


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
        except BrokenPipeError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return BROKEN_PIPE
        except (KeyboardInterrupt, SystemError) as stop:
            if isinstance(stop, SystemError) and not isinstance(stop.__cause__, KeyboardInterrupt):
                raise  # otherwise Ctrl-C came while a compiled kernel ran
            print(_with_notes(f"{self.prog}: interrupted", stop), file=sys.stderr)
            return exit_code_of(stop)
        except (ValueError, OSError, ImportError) as error:
            if debug:
                raise
            print(_with_notes(f"{self.prog}: {in_one_line(error)}", error), file=sys.stderr)
            return BAD_INPUT

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
        from semnav_env.scripts.arguments import HelpShown, parse

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


class Terminated(KeyboardInterrupt):
    """SIGTERM, by which a cluster or a service ends a process; a command minds it as Ctrl-C."""


def exit_code_of(stop: BaseException) -> int:
    """The exit code of a command that this interruption ended, itself or as a cause."""
    return TERMINATED if Terminated in (type(stop), type(stop.__cause__)) else INTERRUPTED


def _end_loading() -> None:
    """From here on interruptions are exceptions, so that a command can put away what it began."""
    handlers = {signal.SIGINT: signal.default_int_handler, signal.SIGTERM: _raise_terminated}
    for number, handler in handlers.items():
        if getattr(signal.getsignal(number), "__name__", "") == "leave_at_once":
            signal.signal(number, handler)


def _raise_terminated(number: int, frame: FrameType | None) -> NoReturn:
    raise Terminated


def in_one_line(error: Exception) -> str:
    """What an error says, in one line that a user understands, of `LONGEST_LINE` at most."""
    return clipped(_first_line(error), LONGEST_LINE)


def _first_line(error: Exception) -> str:
    if isinstance(error, FileExistsError):
        return f"{os.fspath(error.filename)!r} is a file, not a folder"
    if isinstance(error, OSError) and error.strerror:
        where = f" {os.fspath(error.filename)!r}" if error.filename else ""
        what = "write" if error.errno in _NO_ROOM else "open"
        return f"cannot {what}{where}: {error.strerror}"
    if isinstance(error, ModuleNotFoundError) and not str(error.name).startswith("semnav_env"):
        return f"{error.name} is not installed; `semnav doctor` says what to install"
    lines = str(error).strip().splitlines()
    return lines[0] if lines else type(error).__name__


def _with_notes(said: str, error: BaseException) -> str:
    """The message with the notes of the error, such as where the results so far are."""
    return printable("; ".join([said, *getattr(error, "__notes__", ())]))
