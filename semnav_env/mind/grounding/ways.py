"""Ways to places out of view: told ways, and the trail that the robot has driven."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from semnav_env.rules import GroundingRules
from semnav_features.frames import (
    FloatArray,
    Point,
    Pose,
    distances_along,
    heading_between,
    to_local,
    wrap_angle,
)
from semnav_features.scene import Door, Scene

WAY_SPACING = 1.5
"""Distance between the places of a way, metres: about the width of a corridor."""


@dataclass(frozen=True, slots=True)
class Way:
    """The way to a place, as a person who knows the building would describe it.

    Attributes:
        places: (x, y) in metres, `WAY_SPACING` apart, from the start of the way to its end.
        door: the doorway at the end; None if there is none to pass.
        heading: heading through that door, or else of the robot at the last place, radians.
    """

    places: tuple[Point, ...]
    door: Door | None = None
    heading: float = 0.0

    def seen_from(self, frame: Pose) -> Way:
        """A copy of the way in another frame."""
        places = tuple(to_local(frame, place) for place in self.places)
        door = self.door
        if door is not None:
            door = Door(to_local(frame, door.start), to_local(frame, door.end))
        return Way(places, door, wrap_angle(self.heading - frame[2]))


class Guide(Protocol):
    """Gives the ways to named rooms."""

    def __call__(self, clause: int, begin: Pose) -> Way | None:
        """The way from the start of a clause of the command to the room that it names."""


@dataclass(frozen=True)
class KnownWays:
    """A guide that holds told ways, by the number of their clause."""

    ways: Mapping[int, Way]

    def __call__(self, clause: int, begin: Pose) -> Way | None:
        """The told way of a clause; None if there is none."""
        return self.ways.get(clause)


def door_near(scene: Scene, way: Way, pose: Pose, rules: GroundingRules) -> Door | None:
    """The door of a scene that is the way's, for a robot before it; None if it is not seen."""
    if way.door is None:
        return None
    pointed_out = (*way.door.midpoint, way.heading)
    before = (*pose[:2], way.heading)
    near = [
        door
        for door in scene.doors
        if _is_near(door, pointed_out, rules) and _apart(door, before)[0] > -rules.way_door_passed
    ]
    return min(near, key=lambda door: abs(_apart(door, pointed_out)[1]), default=None)


def _is_near(door: Door, pointed_out: Pose, rules: GroundingRules) -> bool:
    """Whether a door may be the told one, by its middle and the heading through it."""
    through, beside = _apart(door, pointed_out)
    run = heading_between(door.start, door.end)
    turned = abs(math.cos(run - pointed_out[2])) >= math.sin(rules.way_door_angle)
    near = abs(through) < rules.way_door_depth and abs(beside) < rules.way_door_offset
    return near and not turned


def _apart(door: Door, pointed_out: Pose) -> Point:
    """Position of a door's middle relative to a pose, along its heading and to its left, metres."""
    return to_local(pointed_out, door.midpoint)


def paced(points: FloatArray | Sequence[Point]) -> tuple[Point, ...]:
    """Places `WAY_SPACING` apart along a line, shape (k, 2); its ends included, at least two."""
    line = np.asarray(points, dtype=np.float64)
    along = distances_along(line)
    stops = np.append(
        WAY_SPACING * np.arange(max(1, math.ceil(along[-1] / WAY_SPACING))), along[-1]
    )
    x, y = (np.interp(stops, along, line[:, axis]) for axis in (0, 1))
    return tuple(zip(x.tolist(), y.tolist(), strict=True))


class Trail:
    """The driven path of the robot: places `WAY_SPACING` apart, without loops."""

    def __init__(self, start: Pose) -> None:
        self._places = [start[:2]]
        self._heading = start[2]

    @property
    def end(self) -> Point:
        """The last place of the trail."""
        return self._places[-1]

    def note(self, pose: Pose) -> None:
        """Add the robot's present position; call it often."""
        here = pose[:2]
        if math.dist(here, self._places[-1]) >= WAY_SPACING and not self._closes_loop(here):
            self._places.append(here)

    def note_doorway(self, pose: Pose) -> None:
        """Add a position in a doorway, which the line between two other places may miss."""
        self._closes_loop(pose[:2])
        self._places.append(pose[:2])

    def _closes_loop(self, here: Point) -> bool:
        """Whether the trail has been at a place before; then the loop since then is left out."""
        for k, place in enumerate(self._places[:-1]):
            if math.dist(here, place) < WAY_SPACING / 2:
                del self._places[k + 1 :]
                return True
        return False

    def back(self, pose: Pose) -> Way:
        """The way back to the pose at which the trail began."""
        return Way((pose[:2], *reversed(self._places)), heading=self._heading)
