"""`semnav completion`: the script by which a shell completes commands and options."""

from __future__ import annotations

import functools
import operator
from contextlib import suppress
from dataclasses import dataclass
from importlib import import_module
from typing import Annotated, Any, Literal

import tyro
from tyro.conf import Positional, subcommand

from semnav_scripts.arguments import READERS
from semnav_scripts.dispatch import CommandTable
from semnav_scripts.main import SEMNAV

FILES_TOO = "eval \"$(complete -p semnav | sed 's/^complete /complete -o default /')\""
"""Lets bash complete names of files where nothing else fits, as other shells do."""


@dataclass(frozen=True)
class Arguments:
    """Print the script by which a shell completes commands, options and names of files.

    Keep what is printed where the shell looks for it; docs/guides/command_line.md says where that
    is. A new version needs a new script.

    Attributes:
        shell: bash, zsh or fish.
    """

    shell: Positional[Literal["bash", "zsh", "fish"]]

    def run(self) -> int:
        """Print the script."""
        words = ["--tyro-write-completion", self.shell, "-"]
        with suppress(SystemExit):  # with which tyro ends when it has printed
            tyro.cli(_all_commands(SEMNAV), args=words, prog=SEMNAV.prog, registry=READERS)
        if self.shell == "bash":
            print(FILES_TOO)
        return 0


def _all_commands(table: CommandTable) -> Any:
    """The union of the arguments of all commands, each under its name.

    A command of two words is left out where the first word is a command itself: it takes arguments
    where a further command would stand.
    """
    kinds = {
        name: _arguments(module) for name, (module, _) in table.commands.items() if " " not in name
    }
    named = (Annotated[kind, subcommand(name=name)] for name, kind in kinds.items())
    return functools.reduce(operator.or_, named)


def _arguments(name: str) -> Any:
    """The arguments of the command in a module, or of those in its table."""
    module = import_module(name)
    further = getattr(module, "COMMANDS", None)
    return _all_commands(further) if isinstance(further, CommandTable) else module.Arguments
