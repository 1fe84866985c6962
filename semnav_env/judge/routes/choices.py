"""The clauses that may come next on a route."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from semnav_env.judge.routes.naming import names_of_door, names_of_junction
from semnav_env.language import (
    Approach,
    Clause,
    Distance,
    DoorReference,
    Follow,
    GoToDoor,
    Leave,
    Place,
    PlaceReference,
    Turn,
    Turning,
)
from semnav_env.mind.grounding.counted_doors import CountedDoor, doors_along
from semnav_env.mind.grounding.junctions import junctions_ahead
from semnav_env.mind.grounding.situation import Situation
from semnav_features.corridor import Corridor
from semnav_features.frames import FloatArray, points_to_local

CORRIDOR_END = PlaceReference(Place.END)
"""The end of a corridor, as a clause names it."""


MAX_TOLD_DISTANCE = 50.0
"""Longest distance that a clause names in metres."""

SIDE_TURNINGS = (Turning.LEFT, Turning.RIGHT)
"""Turns for which a junction can be named."""

SPOT_TURN_DEGREES = (45, 135)
"""Turns on the spot that are said in degrees; those by 90 and 180 degrees have words."""


LEAVING_ANGLE = 0.9
"""Angle to the corridor's axis at which a route has left the corridor, radians."""

SIDE_MARGIN = 0.3
"""Distance beyond the side of a corridor at which a route has left it, metres."""

MAX_DOOR_DISTANCE = 1.5
"""Largest distance from the end of a route to a door that it may lead to, metres."""


@dataclass(frozen=True)
class Choices:
    """The clauses that may be said to a robot at a pose of a route.

    Attributes:
        situation: the situation in which the clause begins, with the true scene.
        way: poses of the route from there on, shape (n, 3), up to the next door that it crosses.
        door: the name of that door; None if it crosses no more.
    """

    situation: Situation
    way: FloatArray
    door: str | None

    def groups(self) -> Iterator[Sequence[Clause]]:
        """The clauses that may lead along the route.

        The clauses of a group mean the same, the shortest first; not all need to be unambiguous.
        """
        seen = self.situation.corridor
        doors = doors_along(self.situation.scene, seen)
        for group in (
            *self._doors(doors),
            *_turns(seen),
            *self._along(seen, doors),
            [Leave()],
        ):
            yield sorted(group, key=words_of)

    def _doors(self, doors: Sequence[CountedDoor]) -> Iterator[Sequence[Clause]]:
        """Clauses through the next door, or to the door before which the route ends."""
        for door in doors:
            names = names_of_door(door, doors)
            if self.door is not None and door.door.name == self.door:
                yield [GoToDoor(name) for name in names]
            elif self.door is None and self._ends_near(door):
                yield [GoToDoor(name, Approach.TO) for name in names]

    def _along(self, seen: Corridor, doors: Sequence[CountedDoor]) -> Iterator[Sequence[Clause]]:
        """Clauses along the corridor: to its end, a distance, or to or past a mark."""
        yield from ([Follow()], [Follow(CORRIDOR_END)])
        stop = self._follows(seen)
        for names in self._near(stop, seen, doors):
            yield [Follow(name) for name in names]
            yield [Follow(name, past=True) for name in names if name != CORRIDOR_END]
        if 0.5 <= stop <= MAX_TOLD_DISTANCE:
            yield [Follow(Distance(round(2.0 * stop) / 2.0))]

    def _near(
        self, stop: float, seen: Corridor, doors: Sequence[CountedDoor]
    ) -> list[list[DoorReference | PlaceReference]]:
        """The names of the last door or junction before a place in the corridor, and the next."""
        marks: list[tuple[float, list[DoorReference | PlaceReference]]] = []
        marks.extend((door.along, [*names_of_door(door, doors)]) for door in doors)
        junctions = junctions_ahead(seen)
        marks.extend((one.centre, [*names_of_junction(one, seen)]) for one in junctions)
        marks.sort(key=lambda mark: mark[0])
        first = max(0, sum(along < stop for along, _ in marks) - 1)
        return [names for _, names in marks[first : first + 2]]

    def _follows(self, seen: Corridor) -> float:
        """Distance along the corridor at which the route leaves it, metres."""
        local = points_to_local(seen.frame, self.way[:, :2])
        aside = np.abs(local[:, 1]) > seen.half_width + SIDE_MARGIN
        away = np.cos(self.way[:, 2] - seen.frame[2]) < math.cos(LEAVING_ANGLE)
        left = np.flatnonzero((aside | away) & (local[:, 0] > SIDE_MARGIN))
        return float(local[left[0] if len(left) else -1, 0])

    def _ends_near(self, door: CountedDoor) -> bool:
        return math.dist(self.way[-1, :2], door.door.midpoint) <= MAX_DOOR_DISTANCE


def _turns(seen: Corridor) -> Iterator[Sequence[Clause]]:
    """Turns at every junction that leads aside, and on the spot."""
    for turning in SIDE_TURNINGS:
        for junction in junctions_ahead(seen, None, turning):
            yield [Turn(turning, name) for name in names_of_junction(junction, seen, turning)]
        yield from ([Turn(turning, degrees=degrees)] for degrees in SPOT_TURN_DEGREES)
    yield from ([Turn(turning)] for turning in Turning)


@lru_cache(maxsize=4096)
def words_of(clause: Clause) -> int:
    """Number of words of a clause."""
    return str(clause).count(" ") + 1
