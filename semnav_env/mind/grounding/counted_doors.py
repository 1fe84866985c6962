"""Counts the doors of a corridor: which ones count, on which side and in which order."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import overload

import numpy as np

from semnav_env.language.references import Side
from semnav_env.rules import GroundingRules
from semnav_features.corridor import MAX_KNOWN_VIEWS, Corridor
from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.door_counting import COUNTED, count_doors
from semnav_features.scene import Door, Scene, StillScene, known_ends

SIDES = (Side.LEFT, Side.RIGHT, Side.AHEAD)
"""Sides by the numbers that the kernel gives them."""


@dataclass(frozen=True, slots=True)
class CountedDoor:
    """A door that a reference counts.

    Attributes:
        door: the door, scene frame.
        along: position of its middle along the corridor's axis, metres.
        side: side of the axis, or ahead, behind or opposite.
        outward: heading through the door, away from the corridor, scene frame, radians.
        off: angle from straight behind, radians; only for doors that are ordered by it.
    """

    door: Door
    along: float
    side: Side
    outward: float
    off: float = 0.0

    def pose(self, beyond: float) -> Pose:
        """The pose on the door's axis `beyond` metres behind its line, facing outward.

        A negative `beyond` is before the line.
        """
        x, y = self.door.midpoint
        c, s = math.cos(self.outward), math.sin(self.outward)
        return x + beyond * c, y + beyond * s, self.outward


class _CountedDoors(Sequence[CountedDoor]):
    """Doors of a scene by rows of `COUNTED`; a `CountedDoor` is made on request."""

    def __init__(self, doors: Sequence[Door], rows: list[tuple[float, int, int, float]]) -> None:
        self._doors, self._rows = doors, rows

    def __len__(self) -> int:
        return len(self._rows)

    @overload
    def __getitem__(self, index: int) -> CountedDoor: ...

    @overload
    def __getitem__(self, index: slice) -> list[CountedDoor]: ...

    def __getitem__(self, index: int | slice) -> CountedDoor | list[CountedDoor]:
        if isinstance(index, slice):
            return list(_CountedDoors(self._doors, self._rows[index]))
        along, door, side, outward = self._rows[index]
        return CountedDoor(self._doors[door], along, SIDES[side], outward)


def doors_along(
    scene: Scene,
    corridor: Corridor,
    side: Side | None = None,
    rules: GroundingRules = GroundingRules(),
) -> Sequence[CountedDoor]:
    """The doors that open onto a corridor ahead of its frame, in the order of travel.

    A door counts while at least half of its opening is still ahead. A door parallel to the corridor
    belongs to its side, if a ray from the axis to that side meets it. A door across the corridor
    that ends it lies ahead.

    Args:
        scene: the doors, in the frame of the corridor.
        corridor: whose frame stands where the counting begins.
        side: count only the doors there.
        rules: distances.
    """
    if isinstance(scene, StillScene):
        return [door for door in _known_doors(scene, corridor, rules) if side in (None, door.side)]
    rows = _rows_along(known_ends(scene.doors), corridor, rules)
    if side is not None:
        rows = [row for row in rows if SIDES[row[2]] == side]
    return _CountedDoors(scene.doors, rows)


def _known_doors(scene: StillScene, corridor: Corridor, rules: GroundingRules) -> list[CountedDoor]:
    """The doors on all sides, counted once for each corridor of a scene that never changes."""
    known, key = scene.known_doors, (corridor, rules)
    if key not in known:
        if len(known) >= MAX_KNOWN_VIEWS:
            known.clear()
        rows = _rows_along(scene.door_ends, corridor, rules)
        known[key] = list(_CountedDoors(scene.doors, rows))
    found: list[CountedDoor] = known[key]
    return found


def _rows_along(
    ends: FloatArray, corridor: Corridor, rules: GroundingRules
) -> list[tuple[float, int, int, float]]:
    seen = corridor.frame, corridor.half_width, corridor.end, corridor.left, corridor.right
    counted = np.empty(len(ends), COUNTED)
    count = count_doors(ends, *seen, rules.door_offset, rules.end_door_offset, counted)
    return sorted(counted[:count].tolist())
