"""The told ways to named rooms, as arrays for kernels."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from semnav_env.language import MAX_CLAUSES
from semnav_env.mind.grounding.ways import Way
from semnav_features.frames import FloatArray

TOLD_PLACES, TOLD_DOORS = 80, MAX_CLAUSES
"""Room for the places of all told ways of a command, 120 m, and for the doors at their ends; places
beyond are left out."""

ToldArrays: TypeAlias = tuple[FloatArray, FloatArray, NDArray[np.int64]]
"""Places, rows of (clause, x, y); doors, rows of (clause, x and y of both jambs); and how many of
each are used. Metres, odometry frame; the clause is the number of the one that names the room."""


class ToldWays:
    """The ways that the robot was told before driving; they do not change while it drives."""

    def __init__(self) -> None:
        self._places, self._doors = np.zeros((TOLD_PLACES, 3)), np.zeros((TOLD_DOORS, 5))
        self._used = np.zeros(2, np.int64)

    @property
    def arrays(self) -> ToldArrays:
        """The ways, as compiled code takes them."""
        return self._places, self._doors, self._used

    def tell(self, ways: Mapping[int, Way]) -> None:
        """Set the ways of a command, by the number of the clause, odom frame."""
        told = sorted(ways.items())
        places = [(clause, *place) for clause, way in told for place in way.places]
        doors = [
            (clause, *way.door.start, *way.door.end) for clause, way in told if way.door is not None
        ]
        for array, rows, kind in ((self._places, places, 0), (self._doors, doors, 1)):
            self._used[kind] = count = min(len(rows), len(array))
            array[:count] = rows[:count] if count else 0.0
