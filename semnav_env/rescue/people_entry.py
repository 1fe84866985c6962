"""The entry "people" of the observation: the tracks of the robot's map of people."""

from __future__ import annotations

from typing import Any, NamedTuple

import gymnasium as gym
import numpy as np
from numpy.typing import NDArray

from semnav_env.mind.observations import Moment
from semnav_env.rescue.settings import PersonMapSettings
from semnav_env.robots import RobotSpec
from semnav_features.frames import Point, to_local
from semnav_features.lidar_spec import LidarSpec

FARTHEST = 100.0
"""Largest coordinate of a place, metres; farther places are clipped, so that the space is
bounded."""

COLUMNS = ("is_there", "x", "y", "probability", "reported")
"""Columns of a row: whether it counts, position (robot frame, metres), probability of being a
person, and whether the robot has reported it."""


class SeenPerson(NamedTuple):
    """A row of the entry: place (robot frame, metres), probability, whether it is reported."""

    place: Point
    probability: float
    reported: bool


class PeopleEntry:
    """The robot's map of people, a row for each track, flat.

    Attributes:
        name: its key in the observation.
    """

    name = "people"

    def __init__(self, rows: int = PersonMapSettings().capacity) -> None:
        self._rows = rows

    def space(self, robot: RobotSpec, lidar: LidarSpec) -> gym.spaces.Box:
        """Rows of `COLUMNS`, flat; float32."""
        high = np.tile([1.0, FARTHEST, FARTHEST, 1.0, 1.0], self._rows).astype(np.float32)
        low = np.tile([0.0, -FARTHEST, -FARTHEST, 0.0, 0.0], self._rows).astype(np.float32)
        return gym.spaces.Box(low, high)

    def observe(self, moment: Moment) -> NDArray[np.float32]:
        """Make new rows."""
        rows = np.zeros((self._rows, len(COLUMNS)), np.float32)
        tracks = moment.payload.people.tracks[: self._rows]
        for row, track in zip(rows, tracks, strict=False):
            x, y = (
                min(max(value, -FARTHEST), FARTHEST)
                for value in to_local(moment.belief.pose, track.place)
            )
            row[:] = 1.0, x, y, track.probability, track.reported
        return rows.ravel()


def read_people(observation: dict[str, NDArray[Any]]) -> list[SeenPerson]:
    """The people of an observation, robot frame."""
    rows = observation["people"].reshape(-1, len(COLUMNS)).tolist()
    return [SeenPerson((x, y), p, done > 0.5) for there, x, y, p, done in rows if there > 0.5]
