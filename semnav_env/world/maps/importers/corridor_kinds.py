"""Tells corridors from rooms on drawn floors: by what they are called, or by shape and doors."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from shapely import Polygon

from semnav_env.world.maps.importers.building import is_long

CORRIDOR_TYPE = re.compile(
    r"korrid|korrio|corridor|hallway|pass(age)?\b|kulvert|.*g\u00e5ng$", re.I
)
"""Types of spaces that are corridors, in Swedish and in English."""

LEAST_DOORS_OF_A_LONG_SPACE = 4
"""Number of doors from which on a long space without a type is a corridor."""

LEAST_DOORS_OF_ANY_SPACE = 7
"""Number of doors from which on any space without a type is a corridor."""


@dataclass(frozen=True, eq=False)
class Space:
    """A space of a drawn floor.

    Attributes:
        kind: what the drawing says it is for; empty if it says nothing.
        polygon: its floor, metres.
        doors: number of doors through which it can be entered.
    """

    kind: str
    polygon: Polygon
    doors: int


def are_corridors(spaces: Sequence[Space]) -> tuple[bool, ...]:
    """Which spaces of a floor are corridors.

    Those are the ones of a `CORRIDOR_TYPE` and, of the spaces without a type, the long ones and the
    ones with many doors. If there is none, the space with most doors is the corridor.
    """
    found = [_is_corridor(space) for space in spaces]
    if not any(found) and spaces:
        most = max(range(len(spaces)), key=lambda k: (spaces[k].doors, spaces[k].polygon.area))
        found[most] = spaces[most].doors > 1
    return tuple(found)


def _is_corridor(space: Space) -> bool:
    if space.kind:
        return CORRIDOR_TYPE.match(space.kind) is not None
    least = LEAST_DOORS_OF_A_LONG_SPACE if is_long(space.polygon) else LEAST_DOORS_OF_ANY_SPACE
    return space.doors >= least
