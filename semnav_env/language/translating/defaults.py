"""What goes without saying: a door that is only named is gone through."""

from __future__ import annotations

from dataclasses import replace

from semnav_env.language.clauses import Approach, GoToDoor
from semnav_env.language.command import Command
from semnav_env.language.translating.support import TextSupport

ENTERING = ("in", "prep into", "prep through", "verb enter")
"""Classes of phrases that say to go through a door."""


def with_defaults(command: Command, support: TextSupport) -> Command:
    """The command, marked where it goes through its last door though nobody said so.

    Args:
        command: what a text means.
        support: the words of the text.
    """
    *before, last = command.clauses
    is_through = isinstance(last, GoToDoor) and last.approach is Approach.THROUGH
    if not is_through or not support.classes.isdisjoint(ENTERING):
        return command
    return Command((*before, replace(last, by_default=True)))  # type: ignore[type-var]
