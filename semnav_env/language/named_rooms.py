"""Checks that the rooms of a command exist."""

from __future__ import annotations

from collections.abc import Sequence

from semnav_env.language.command import Command, room_of
from semnav_env.language.errors import CommandError
from semnav_env.language.language import Language
from semnav_env.language.rooms import plain_name


def missing_room(command: Command, rooms: Sequence[str]) -> str | None:
    """The first room of a command that is not among `rooms`; None if all are, or none is known."""
    known = set(map(plain_name, rooms))
    named = filter(None, map(room_of, command.clauses))
    return next((name for name in named if known and name not in known), None)


def check_rooms(command: Command, text: str, rooms: Sequence[str], language: Language) -> None:
    """Refuse a command with a room that is not among `rooms`; without `rooms` take any.

    The error is in the words of `language`.

    Raises:
        CommandError: there is no such room; the message lists the rooms.
    """
    name = missing_room(command, rooms)
    if name is not None:
        problem = 'there is no room "{name}"; there are: {rooms}'
        raise CommandError(language.tell(problem, name=name, rooms=", ".join(rooms)), text[:200])
