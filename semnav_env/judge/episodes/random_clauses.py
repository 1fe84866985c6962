"""Draws random clauses, whether or not they can be carried out."""

from __future__ import annotations

from collections.abc import Sequence
from enum import StrEnum
from typing import TypeVar

import numpy as np

from semnav_env.language import (
    LAST,
    Approach,
    Clause,
    Distance,
    DoorReference,
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    IfThere,
    Place,
    PlaceReference,
    Side,
    Stop,
    Turn,
    Turning,
)
from semnav_env.language.rooms import plain_name

T = TypeVar("T")

SPOT_TURN_SHARE = 0.03
"""Share of turns by degrees among the turns drawn for the end of several clauses. Among the turns
that can be carried out this share is larger, because a turn by degrees always can be."""


class CommandTopic(StrEnum):
    """Topic of a command: the kind of its last clause, or leaving a room as its first."""

    ENTER = "enter"
    APPROACH = "approach"
    FOLLOW = "follow"
    TURN = "turn"
    ROOM = "room"
    LEAVE = "leave"
    BACK = "back"
    WAIT = "wait"
    CONDITION = "condition"


LATER_TOPICS = (CommandTopic.BACK, CommandTopic.WAIT, CommandTopic.CONDITION)
"""Topics of commands that need several clauses: one before or after the clause of the topic."""


def topics_of(clauses: int) -> tuple[CommandTopic, ...]:
    """Topics that a command of a number of clauses can have."""
    late = LATER_TOPICS if clauses > 1 else ()
    return tuple(topic for topic in CommandTopic if topic not in LATER_TOPICS) + late


class RandomClauses:
    """Draws clauses.

    Args:
        rng: source of randomness.
        rooms: the names of the rooms of the floor plan.
    """

    def __init__(self, rng: np.random.Generator, rooms: Sequence[str]) -> None:
        self._rng, self._rooms = rng, rooms

    def last(self, topic: CommandTopic, *, alone: bool) -> Clause:
        """The last clause of a command about something; `alone` if nothing is said before it."""
        match topic:
            case CommandTopic.APPROACH:
                return GoToDoor(self.door(), Approach.TO)
            case CommandTopic.FOLLOW:
                return self.follow()
            case CommandTopic.TURN if not alone and self._rng.random() < SPOT_TURN_SHARE:
                return self.turn_on_the_spot()
            case CommandTopic.TURN:
                return self.turn()
            case CommandTopic.ROOM:
                return GoToRoom(plain_name(self.choose(*self._rooms)))
            case CommandTopic.BACK:
                return GoBack()
            case CommandTopic.WAIT:
                return Stop(int(self._rng.integers(2, 11)))
            case _:
                return GoToDoor(self.door())

    def underway(self) -> Clause:
        """Draw a clause before others; turns are drawn more often, as fewer of them can be done."""
        if self._rng.random() < 0.85:
            return self.turn()
        if self._rng.random() < 0.1:
            return self._distance()
        return self._until(past=0.6)

    def condition(self, otherwise: bool) -> tuple[Clause, ...]:
        """Draw a condition on a door, its branch, and perhaps an "otherwise" branch."""
        side, other_side = self.choose((Side.LEFT, Side.RIGHT), (Side.RIGHT, Side.LEFT))
        door = DoorReference(self.choose(1, 1, 2, 3), side)
        to_it = GoToDoor(door, self.choose(Approach.THROUGH, Approach.THROUGH, Approach.TO))
        other = GoToDoor(DoorReference(self.choose(1, 2), other_side))
        others: tuple[Clause, ...] = (self.turn(), other, Follow(PlaceReference(Place.END)))
        instead = self.choose(*others)
        absent = bool(self._rng.random() < 0.3)
        ways: tuple[Clause, ...] = (instead, to_it) if absent else (to_it, instead)
        return (IfThere(door, absent, otherwise), *ways[: 1 + otherwise])

    def turn(self) -> Turn:
        """A turn at a junction."""
        return Turn(self.choose(Turning.LEFT, Turning.RIGHT), self._junction())

    def turn_here(self) -> Turn:
        """A turn as soon as there is room for it."""
        return Turn(self.choose(Turning.LEFT, Turning.RIGHT))

    def turn_on_the_spot(self) -> Turn:
        """A turn by degrees."""
        degrees = self.choose(30, 45, 60, 90, 90, 120, 135, 180)
        return Turn(self.choose(Turning.LEFT, Turning.RIGHT), degrees=degrees)

    def follow(self) -> Follow:
        """Draw a clause along the corridor up to a place."""
        kind = self._rng.random()
        if kind < 0.03:
            return Follow(PlaceReference(Place.END))
        return self._distance() if kind < 0.09 else self._until(past=0.4)

    def _distance(self) -> Follow:
        return Follow(Distance(float(self._rng.integers(2, 11))))

    def _until(self, past: float) -> Follow:
        mark = self.door() if self._rng.random() < 0.5 else self._junction()
        return Follow(mark, past=bool(self._rng.random() < past))

    def _junction(self) -> PlaceReference:
        kinds = Place.INTERSECTION, Place.INTERSECTION, Place.CORNER, Place.T_JUNCTION
        return PlaceReference(self.choose(*kinds), self.choose(1, 1, 1, 2, 3))

    def door(self) -> DoorReference:
        """One of the first five doors, or the last, on a side or on both."""
        ordinal = self.choose(1, 1, 2, 2, 3, 4, 5, LAST)
        return DoorReference(ordinal, self.choose(Side.LEFT, Side.RIGHT, None))

    def choose(self, *choices: T) -> T:
        """One of them."""
        return choices[int(self._rng.integers(len(choices)))]
