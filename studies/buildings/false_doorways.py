"""Doorways of an occupancy map that close nothing: a body gets around them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt, label

from semnav_env.world.maps.doorways import NARROWEST_ROBOT
from semnav_env.world.maps.floor_plan import PlanDoor
from semnav_env.world.maps.importers import OccupancyMap
from semnav_env.world.maps.importers.gaps import CROSSING_DEPTH
from semnav_features.frames import FloatArray, Point, to_local

SEAL_OVERLAP = 0.1
"""How far the seal of a doorway overlaps its jambs, which are rough, metres."""


def false_doorways(
    found: Sequence[PlanDoor], sealed: Sequence[PlanDoor], pixels: OccupancyMap
) -> tuple[PlanDoor, ...]:
    """Those doorways that part nothing.

    With all of them sealed, and some others, the way from `CROSSING_DEPTH` before a doorway to as
    far behind
    it is barred to a disc as wide as the narrowest robot. If it is not, the doorway is a gap
    beside a piece of furniture, or part of an opening that was not found whole. This looks at the
    free pixels alone, neither at the traced walls nor at the outlines of places.

    Args:
        found: doorways to judge.
        sealed: other doorways that are sealed with them.
        pixels: the map.
    """
    clear = np.asarray(distance_transform_edt(pixels.free)) * pixels.spec.resolution
    way = clear >= NARROWEST_ROBOT / 2
    for door in (*found, *sealed):
        way &= ~_sealed(door, pixels)
    spaces, _ = label(way)
    return tuple([door for door in found if _parts_nothing(door, spaces, pixels)])


def _parts_nothing(door: PlanDoor, spaces: NDArray[np.int32], pixels: OccupancyMap) -> bool:
    (x1, y1), (x2, y2) = door.start, door.end
    x, y = door.midpoint
    dx, dy = CROSSING_DEPTH * (y1 - y2) / door.width, CROSSING_DEPTH * (x2 - x1) / door.width
    before, behind = _pixel(pixels, (x + dx, y + dy)), _pixel(pixels, (x - dx, y - dy))
    return bool(spaces[before] == spaces[behind] != 0)


def _sealed(door: PlanDoor, pixels: OccupancyMap) -> NDArray[np.bool_]:
    """The pixels on the line of a doorway and beside it."""
    mask = np.zeros_like(pixels.free)
    for point in _along(door, pixels.spec.resolution / 2):
        row, column = _pixel(pixels, (point[0], point[1]))
        mask[max(0, row - 1) : row + 2, max(0, column - 1) : column + 2] = True
    return mask


def _along(door: PlanDoor, step: float) -> FloatArray:
    start, end = np.array(door.start), np.array(door.end)
    over = SEAL_OVERLAP / door.width
    shares = np.linspace(-over, 1.0 + over, math.ceil((door.width + 2 * SEAL_OVERLAP) / step) + 1)
    return np.asarray(start + shares[:, None] * (end - start))


def _pixel(pixels: OccupancyMap, point: Point) -> tuple[int, int]:
    """Row and column, the nearest there is."""
    x, y = to_local(pixels.spec.origin, point)
    rows, columns = pixels.free.shape
    row, column = rows - 1 - y // pixels.spec.resolution, x // pixels.spec.resolution
    return int(np.clip(row, 0, rows - 1)), int(np.clip(column, 0, columns - 1))
