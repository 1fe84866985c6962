"""The clauses of a robot that is to find people: search, look, call, go to them, and ask."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from semnav_env.language.clauses import Clause
from semnav_env.language.declarations import ROOM, Form, TokenVerb, form
from semnav_env.language.references import RoomReference


@dataclass(frozen=True, slots=True)
class SearchHouse(Clause):
    """Look into every room and report every person that is found: "search the house".

    Its token is "go to room" with the number 0: it needs no verb of its own, so agents that were
    trained before keep their observations. That holds for the other clauses here, too.
    """

    forms: ClassVar[tuple[Form, ...]] = (
        form(
            *("search", "search all", "search house", (TokenVerb.GO_TO_ROOM, 0, ROOM)),
            sampled=False,
        ),
    )


@dataclass(frozen=True, slots=True)
class SearchRoom(Clause):
    """Look at all the floor of a room and report the people in it: "search room 12".

    Attributes:
        room: which; the robot goes there first. None for where it is, a room or a hallway.
    """

    room: RoomReference | None = None
    forms: ClassVar[tuple[Form, ...]] = (
        form(
            *("search_here", "search here", "search here", (TokenVerb.GO_TO_ROOM, 2)), sampled=False
        ),
        form(
            *("search_room", "search within {room}", "search {room}", (TokenVerb.GO_TO_ROOM, 2)),
            room=RoomReference,
            sampled=False,
        ),
    )


@dataclass(frozen=True, slots=True)
class LookAround(Clause):
    """Turn on the spot once and look in every direction: "look around"."""

    forms: ClassVar[tuple[Form, ...]] = (
        form("look", "look", "look", (TokenVerb.TURN, 3, ROOM), sampled=False),
    )


@dataclass(frozen=True, slots=True)
class CallOut(Clause):
    """Stand still, call, and listen from where people answer: "call and listen"."""

    forms: ClassVar[tuple[Form, ...]] = (
        form("call", "call", "call", (TokenVerb.STOP, 0, ROOM), sampled=False),
    )


@dataclass(frozen=True, slots=True)
class GoToPerson(Clause):
    """Go to the nearest person that was found: "go to the person you found".

    People to whom the command has led already do not count.
    """

    forms: ClassVar[tuple[Form, ...]] = (
        form("to_person", "to person", "to person", (TokenVerb.GO_TO, 2), sampled=False),
    )


@dataclass(frozen=True, slots=True)
class AskName(Clause):
    """Ask the person to whom the robot went for the name: "ask for the name".

    Without such a person it goes to the nearest one that was found.
    """

    forms: ClassVar[tuple[Form, ...]] = (
        form("ask_name", "ask", "ask", (TokenVerb.GO_TO, 3), sampled=False),
    )
