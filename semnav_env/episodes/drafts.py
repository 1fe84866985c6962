"""Random commands of so many clauses that end as asked for and can be carried out."""

from __future__ import annotations

from copy import copy
from enum import StrEnum
from typing import TypeVar

import numpy as np

from semnav_env.commands import (
    LAST,
    Approach,
    Clause,
    Command,
    Distance,
    DoorReference,
    Follow,
    GoBack,
    GoToDoor,
    GoToRoom,
    Leave,
    Place,
    PlaceReference,
    Side,
    Stop,
    Turn,
    Turning,
)
from semnav_env.commands.rooms import plain_name
from semnav_env.directory import Directory
from semnav_env.features.frames import Pose
from semnav_env.grounding import GroundingError
from semnav_env.grounding.follower import Follower
from semnav_env.maps import FloorPlan
from semnav_env.maps.geodesic import Geodesic
from semnav_env.verifier.goals import check_grounded

T = TypeVar("T")

TRIES = 15
"""Clauses drawn for each place in a command before the command is given up."""

TURN_TRIES = 8
"""Of them those that ask for a turn, on the way."""


class Verb(StrEnum):
    """What a command is about: its last clause, or leaving a room, its first."""

    ENTER = "enter"
    APPROACH = "approach"
    FOLLOW = "follow"
    TURN = "turn"
    ROOM = "room"
    LEAVE = "leave"
    BACK = "back"
    WAIT = "wait"


def verbs_of(clauses: int) -> tuple[Verb, ...]:
    """The verbs that a command of so many clauses can have."""
    late = (Verb.BACK, Verb.WAIT) if clauses > 1 else ()
    return tuple(verb for verb in Verb if verb not in (Verb.BACK, Verb.WAIT)) + late


class Drafter:
    """Draws commands clause by clause, each of which can be carried out after those before.

    Args:
        plan: where.
        geodesic: its shortest ways.
        start: from where.
        rng: source of randomness.
    """

    def __init__(
        self, plan: FloorPlan, geodesic: Geodesic, start: Pose, rng: np.random.Generator
    ) -> None:
        self.start, self.rng = start, rng
        self._plan, self._geodesic = plan, geodesic
        self._followers: dict[tuple[Clause, ...], Follower] = {}

    def feasible(self, clauses: int, verb: Verb) -> Command | None:
        """A command that can be carried out; None if none came up."""
        said: tuple[Clause, ...] = ()
        for index in range(clauses):
            for attempt in range(TRIES):
                clause = self._draw(index, index == clauses - 1, verb, attempt)
                if self._follows(said, clause) and self.problem((*said, clause)) is None:
                    said = (*said, clause)
                    break
            else:
                return None
        return Command(said)

    def infeasible(self, clauses: int) -> Command | None:
        """A command whose last clause, and no other, cannot be carried out."""
        first = self.feasible(clauses - 1, Verb.TURN) if clauses > 1 else None
        if clauses > 1 and first is None:
            return None
        before = first.clauses if first else ()
        for _ in range(TRIES):
            verb = self._choose(Verb.ENTER, Verb.ENTER, Verb.TURN, Verb.APPROACH, Verb.FOLLOW)
            said = (*before, self._draw(clauses - 1, True, verb, 0))
            problem = self.problem(said)
            if problem is not None and "say " not in problem:
                return Command(said)
        return None

    def turns(self, clauses: int) -> Command | None:
        """A command that only turns at junctions, so that it starts no counting of doors."""
        said: tuple[Clause, ...] = ()
        for _ in range(TRIES):
            clause = self._turn()
            if self._follows(said, clause) and self.problem((*said, clause)) is None:
                said = (*said, clause)
            if len(said) == clauses:
                return Command(said)
        return None

    def problem(self, clauses: tuple[Clause, ...]) -> str | None:
        """Why clauses cannot be carried out; None if they can."""
        try:
            self._followed(clauses)
        except GroundingError as error:
            return str(error)
        return None

    def _followed(self, clauses: tuple[Clause, ...]) -> Follower:
        """A follower at the last of some clauses; kept, for those that may come next."""
        if clauses in self._followers:
            return self._followers[clauses]
        command = Command(clauses)
        guide = Directory(self._plan, command, self._geodesic)
        if len(clauses) == 1:
            follower = Follower(command, complete=True, guide=guide)
            follower.start(self._plan.scene, self.start)
        else:
            follower = copy(self._followed(clauses[:-1]))
            follower.command, follower.guide = command, guide
            follower.skip_to_next(self._plan.scene)
        check_grounded(follower)
        self._followers[clauses] = follower
        return follower

    def _follows(self, said: tuple[Clause, ...], clause: Clause) -> bool:
        """Whether a clause says something new after the others."""
        if not said or not isinstance(clause, Follow):
            return True
        before = said[-1]
        if not isinstance(before, Follow):
            return True
        return isinstance(before.until, DoorReference) or isinstance(clause.until, DoorReference)

    def _draw(self, index: int, is_last: bool, verb: Verb, attempt: int) -> Clause:
        if verb is Verb.LEAVE and index == 0:
            return Leave()
        if not is_last:
            return self._underway(index, attempt)
        match verb:
            case Verb.APPROACH:
                return GoToDoor(self._door(), Approach.TO)
            case Verb.FOLLOW:
                return self._follow()
            case Verb.TURN:
                return self._turn()
            case Verb.ROOM:
                return GoToRoom(plain_name(self._choose(*self._plan.room_names)))
            case Verb.BACK:
                return GoBack()
            case Verb.WAIT:
                return Stop(int(self.rng.integers(2, 11)))
            case _:
                return GoToDoor(self._door())

    def _underway(self, index: int, attempt: int) -> Clause:
        """A turn if there is one to take, for what follows hallways can be said nearly anywhere."""
        if index == 0 and self.rng.random() < 0.1:
            return Turn(Turning.AROUND)
        if attempt < TURN_TRIES:
            return self._turn()
        return self._follow()

    def _turn(self) -> Turn:
        return Turn(self._choose(Turning.LEFT, Turning.RIGHT), self._junction())

    def _follow(self) -> Follow:
        kind = self.rng.random()
        if kind < 0.2:
            return Follow(PlaceReference(Place.END))
        if kind < 0.4:
            return Follow(Distance(float(self.rng.integers(2, 11))))
        mark = self._door() if kind < 0.7 else self._junction()
        return Follow(mark, past=bool(self.rng.random() < 0.4))

    def _junction(self) -> PlaceReference:
        kinds = Place.INTERSECTION, Place.INTERSECTION, Place.CORNER, Place.T_JUNCTION
        return PlaceReference(self._choose(*kinds), self._choose(1, 1, 1, 2, 3))

    def _door(self) -> DoorReference:
        ordinal = self._choose(1, 1, 2, 2, 3, 4, 5, LAST)
        return DoorReference(ordinal, self._choose(Side.LEFT, Side.RIGHT, None))

    def _choose(self, *choices: T) -> T:
        return choices[int(self.rng.integers(len(choices)))]
