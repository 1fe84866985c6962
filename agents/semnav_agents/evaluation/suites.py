"""Suites of trials, on which agents are measured."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from semnav_env.judge.episodes import SPLITS, Episode
from semnav_env.language.vocabulary.typos import did_you_mean
from semnav_features.frames import Pose

SEARCH = "search the house"
"""The command of a search of a house."""


@dataclass(frozen=True)
class Trial:
    """A command and an approximate start pose.

    Attributes:
        floor_plan: bundled name or path.
        command: what the robot is told.
        pose: pose around which the robot starts, world frame.
        scatter: largest deviation of the start in x, y (metres) and heading (radians).
        person_in: name of the room on whose floor a person lies, where people are to be found as
            told; empty for others.
    """

    floor_plan: str
    command: str
    pose: Pose
    scatter: Pose = (0.2, 0.2, 0.2)
    person_in: str = ""

    @property
    def group(self) -> str:
        """Name of its group in tables: the plan and the command."""
        return f"{self.floor_plan}: {self.command}"

    @property
    def is_search(self) -> bool:
        """Whether people are searched, which needs a person detector, victims and time."""
        return self.command == SEARCH or bool(self.person_in)


def _trials(floor_plan: str, pose: Pose, *commands: str) -> tuple[Trial, ...]:
    return tuple(Trial(floor_plan, command, pose) for command in commands)


_HEIDELBERG = _trials(
    "heidelberg_hallway",
    (-2.5, -0.3, 0.24),
    "go through the first door on the right",
    "go through the second door on the right",
    "go through the third door on the right",
    "go down the hallway, turn left at the intersection and go in the first door on the right",
)

_FROM_WEST = _trials(
    "office_cross",
    (1.3, 9.1, 0.0),
    "go through the first door on the right",
    "enter the second door on the left",
    "go through the third door on the right",
    "go to the second door on the right",
    "go through the fourth door on the left",
    "follow the hallway until the intersection",
    "go to the end of the hallway",
    "turn left at the intersection and go in the first door on the right",
    "turn right at the intersection and go through the first door on the left",
    "turn right at the intersection and follow the hallway until the end",
    "go down the hallway, turn left at the intersection and go through the first door on the left",
    "turn left at the intersection, turn right at the corner and take the second door on the right",
    "turn left at the intersection, turn right at the corner and take the last door on the left",
)

_FROM_EAST = _trials(
    "office_cross",
    (28.6, 9.1, math.pi),
    "take the first door on the right",
    "go through the second door on the left",
    "turn right at the intersection and take the first door on the left",
)

_FROM_SOUTH = _trials(
    "office_cross",
    (15.0, 1.0, math.pi / 2),
    "go through the first door on the left",
    "turn right at the intersection and go through the second door on the right",
    "turn left at the intersection and go through the first door on the right",
    "follow the hallway to the intersection, then turn around",
)

_FROM_BEND = _trials(
    "office_cross",
    (26.0, 19.1, math.pi),
    "go in the first door on the right",
    "turn left at the corner and go through the second door on the left",
    "go down the hallway, turn left and take the first door on the right",
)

_UP_THE_SOUTH_ARM, _DOWN_THE_SOUTH_ARM = (1.0, 1.0, math.pi / 2), (1.2, 3.7, -math.pi / 2)
_FROM_THE_WEST_END, _UP_THE_WEST_ARM = (-5.4, 4.35, 0.0), (-3.0, 4.35, 0.0)
_DOWN_THE_WEST_ARM = (-1.5, 4.35, math.pi)
_IN_THE_PARENTS_ROOM, _IN_THE_DAUGHTERS_ROOM = (-8.2, 4.4, 0.0), (-4.2, 7.0, -math.pi / 2)
_IN_THE_KITCHEN, _IN_THE_LIVING_ROOM = (0.5, -1.9, math.pi / 2), (4.8, 2.4, math.pi)

_in_the_villa = partial(_trials, "villa_hall")

_VILLA_DOORS = (
    *_in_the_villa(
        _DOWN_THE_SOUTH_ARM,
        "go through the first door on the left",
        "go through the door at the end of the hallway",
    ),
    *_in_the_villa(
        _DOWN_THE_WEST_ARM, "go through the first door on the right", "go through the last door"
    ),
    *_in_the_villa(
        _UP_THE_SOUTH_ARM,
        "turn left at the corner and go through the first door on the right",
        "turn left at the corner and go through the door at the end of the hallway",
    ),
    *_in_the_villa(
        _UP_THE_WEST_ARM,
        "turn right at the corner and go through the first door on the left",
        "turn right at the corner and go through the door at the end of the hallway",
        "go down the hallway, turn right at the corner and go through the second door",
    ),
    *_in_the_villa(_FROM_THE_WEST_END, "take the first door on the left"),
)

_VILLA_TURNS = (
    *_in_the_villa(
        _UP_THE_SOUTH_ARM,
        "turn left at the next corner",
        "go to the end of the hallway",
        "turn left at the corner and follow the hallway until the end",
    ),
    *_in_the_villa(
        _UP_THE_WEST_ARM,
        "turn right at the next corner",
        "follow the hallway to the corner",
        "turn right at the corner and go to the end of the hallway",
    ),
    *_in_the_villa(_FROM_THE_WEST_END, "go down the hallway and turn right at the corner"),
    *_in_the_villa((1.2, 2.4, math.pi / 2), "turn around", "turn left at the corner"),
    *_in_the_villa(_DOWN_THE_SOUTH_ARM, "follow the hallway until the end"),
)

_VILLA_ROOMS = (
    *_in_the_villa(
        _UP_THE_SOUTH_ARM,
        "go to the parents' bedroom",
        "go to the daughter's room",
        "go to the living room",
    ),
    *_in_the_villa(_UP_THE_WEST_ARM, "enter the living room", "go to the kitchen"),
    *_in_the_villa(_DOWN_THE_SOUTH_ARM, "enter the kitchen", "go into the living room"),
    *_in_the_villa(_DOWN_THE_WEST_ARM, "enter the parents' room"),
    *_in_the_villa(_FROM_THE_WEST_END, "enter the daughter's room", "go into the kitchen"),
)

_VILLA_EXITS = (
    *_in_the_villa(
        _IN_THE_PARENTS_ROOM, "leave the room", "leave the room and turn right at the corner"
    ),
    *_in_the_villa(
        _IN_THE_DAUGHTERS_ROOM,
        "exit the room",
        "leave the room and go through the first door on the right",
    ),
    *_in_the_villa(
        _IN_THE_KITCHEN,
        "leave this room",
        "leave the room and turn left at the corner",
        "leave the room and go to the living room",
    ),
    *_in_the_villa(_IN_THE_LIVING_ROOM, "get out of the room", "exit the room and turn left"),
    *_in_the_villa((4.8, 2.4, 0.0), "go out of the room"),
)

_SEARCH_KITCHEN = 'search room "kitchen"'
_SEARCH_LIVING_ROOM = 'search room "living room"'
_MEET, _ASK = "go to the person you found", "ask for the name"


def _finding(room: str, pose: Pose, *commands: str) -> tuple[Trial, ...]:
    return tuple(Trial("villa_hall", each, pose, person_in=room) for each in commands)


_VILLA_FIND = (
    *_finding(
        "kitchen",
        _UP_THE_SOUTH_ARM,
        _SEARCH_KITCHEN,
        f"{_SEARCH_KITCHEN} and {_MEET}",
        f"{_SEARCH_KITCHEN}, {_MEET} and {_ASK}",
        f"{_SEARCH_KITCHEN}, {_ASK} and go back to the start",
    ),
    *_finding(
        "living room",
        _DOWN_THE_SOUTH_ARM,
        _SEARCH_LIVING_ROOM,
        f"{_SEARCH_LIVING_ROOM}, {_MEET} and {_ASK}",
        'look around, call and listen and go to room "living room"',
    ),
    *_finding(
        "parents' bedroom",
        _DOWN_THE_WEST_ARM,
        'search room "parents bedroom"',
        f'search room "parents bedroom", {_MEET} and {_ASK}',
    ),
    *_finding(
        "daughter's bedroom",
        _FROM_THE_WEST_END,
        'search room "daughters bedroom"',
        f"go through the first door on the left, search this room, {_MEET} and {_ASK}",
    ),
    *_finding(
        "kitchen",
        (1.5, -2.8, math.pi / 2),
        "search this room and leave the room",
        f"look around, {_MEET} and {_ASK}",
        "call and listen and leave the room",
    ),
    *_finding(
        "living room",
        _IN_THE_LIVING_ROOM,
        f"look around and {_ASK}",
        "search this room, leave the room and turn left",
    ),
    *_finding(
        "daughter's bedroom",
        _UP_THE_WEST_ARM,
        f"search the house, {_MEET} and {_ASK}",
        f"search the house, {_ASK} and go back to the start",
    ),
    *_finding(
        "living room",
        _UP_THE_WEST_ARM,
        'go to room "living room", look around and call and listen',
        f"{_SEARCH_LIVING_ROOM}, leave the room and {_SEARCH_KITCHEN}",
    ),
)

_VILLA_SEARCH = (
    *_in_the_villa(_UP_THE_SOUTH_ARM, SEARCH),
    *_in_the_villa(_DOWN_THE_SOUTH_ARM, SEARCH),
    *_in_the_villa(_FROM_THE_WEST_END, SEARCH),
    *_in_the_villa(_UP_THE_WEST_ARM, SEARCH),
    *_in_the_villa(_DOWN_THE_WEST_ARM, SEARCH),
)

SUITES = {
    "heidelberg": _HEIDELBERG,
    "office_cross": _FROM_WEST + _FROM_EAST + _FROM_SOUTH + _FROM_BEND,
    "villa_doors": _VILLA_DOORS,
    "villa_turns": _VILLA_TURNS,
    "villa_rooms": _VILLA_ROOMS,
    "villa_exits": _VILLA_EXITS,
    "villa_search": _VILLA_SEARCH,
    "villa_find": _VILLA_FIND,
}
"""The suites by name. Those of the villa are in the hall of Mes 2021."""

JOINED = {
    "villa": ("villa_doors", "villa_turns", "villa_rooms", "villa_exits"),
    "all": tuple(name for name in SUITES if name not in ("villa_search", "villa_find")),
}
"""Names of several suites at once. For `villa_search` and `villa_find`, which are in none, an agent
must be able to search."""


def suite(name: str) -> tuple[Trial, ...]:
    """The trials of a suite, or of the suites that a name of `JOINED` stands for.

    Raises:
        ValueError: there is no such suite; the error lists the suites.
    """
    if name not in SUITES and name not in JOINED:
        there = f"{', '.join((*SUITES, *JOINED))}, and the splits {', '.join(SPLITS)}"
        hint = did_you_mean(name, (*SUITES, *JOINED, *SPLITS))
        raise ValueError(f"no suite {name!r:.80}; there are: {there}{hint}")
    return tuple(trial for each in JOINED.get(name, (name,)) for trial in SUITES[each])


def usual_agent(trials: Sequence[Trial | Episode]) -> str:
    """Name of the agent that drives them if none is named."""
    searches = [each for each in trials if isinstance(each, Trial) and each.is_search]
    if any(each.person_in for each in searches):
        return "finder"
    return "searcher" if searches else "scripted"
