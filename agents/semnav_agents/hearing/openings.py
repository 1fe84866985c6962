"""Doors and openings of a corridor as elements of the network's set, in the corridor's frame."""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np

from semnav_features.corridor import MIN_CONTINUATION, Corridor
from semnav_features.frames import FloatArray, Pose

RowArrays: TypeAlias = tuple[FloatArray, FloatArray, FloatArray]
"""Two ends, shape (n, 4); base poses, shape (n, 3); seven extras, shape (n, 7)."""

REACHED_SHARE = 0.95
"""Share of the distance to a door's middle that must be free of walls for it to be in view."""

MOST_DEPTH = 5.0
"""Largest depth behind a door, metres; larger depths are clipped."""


def describe_doors(
    doors: FloatArray,
    walls: FloatArray,
    corridor: Corridor,
    begin: Pose,
    depths: FloatArray,
    told: FloatArray,
    outward: FloatArray,
) -> RowArrays:
    """Make elements of the remembered doors.

    Args:
        doors: jambs, shape (n, 4).
        walls: ends, shape (m, 4).
        corridor: whose frame all is in.
        begin: where the clause began.
        depths: how far behind each a beam goes, metres; NaN if not known.
        told: jambs of the told door, shape (0 or 1, 4).
        outward: direction through the told door, shape (2,); zeros without one.
    """
    if not len(doors):
        return np.zeros((0, 4)), np.zeros((0, 3)), np.zeros((0, 7))
    middles = (doors[:, :2] + doors[:, 2:]) / 2
    bases = _through(doors, middles - begin[:2] if not outward.any() else outward)
    gaps = np.array([_side_gap(corridor, x, y) for x, y in middles.tolist()])
    offsets = middles - ((told[0, :2] + told[0, 2:]) / 2) if len(told) else np.full((1, 2), 9.0)
    extras = np.column_stack(
        (
            np.hypot(*(doors[:, 2:] - doors[:, :2]).T),
            np.clip(gaps, -2.0, 2.0),
            np.clip(np.nan_to_num(depths, nan=-MOST_DEPTH), -MOST_DEPTH, MOST_DEPTH) / 2.0,
            np.isfinite(depths),
            [_blocked(walls, begin, place) for place in middles],
            np.broadcast_to(np.clip(offsets, -2.0, 2.0), middles.shape),
        )
    )
    return doors, bases, extras


def _through(doors: FloatArray, towards: FloatArray) -> FloatArray:
    """The pose in the middle of each door, facing through it, away from the side of approach."""
    middles, along = (doors[:, :2] + doors[:, 2:]) / 2, doors[:, 2:] - doors[:, :2]
    normals = np.column_stack((-along[:, 1], along[:, 0]))
    normals *= np.where((normals * towards).sum(axis=1) < 0.0, -1.0, 1.0)[:, None]
    return np.column_stack((middles, np.arctan2(normals[:, 1], normals[:, 0])))


def through_one(door: FloatArray, towards: FloatArray) -> FloatArray:
    """The pose in the middle of one door, shape (1, 4), that heads through it; shape (1, 3)."""
    return _through(door, towards)


def _side_gap(corridor: Corridor, along: float, offset: float) -> float:
    """Distance of a place behind the side of the corridor, metres; 2 where no side is known."""
    side = corridor.side_at(offset > 0.0, along)
    return abs(offset) - side if math.isfinite(side) else 2.0


def _blocked(walls: FloatArray, begin: Pose, place: FloatArray) -> float:
    """1 if a wall lies between where the clause began and a place, else 0.

    A wall does where its ends lie on different sides of the line of sight, and the ends of that on
    different sides of the wall.
    """
    x, y = begin[0], begin[1]
    dx, dy = REACHED_SHARE * (place - (x, y))
    first = dx * (walls[:, 1] - y) - dy * (walls[:, 0] - x)
    last = dx * (walls[:, 3] - y) - dy * (walls[:, 2] - x)
    rx, ry = walls[:, 2] - walls[:, 0], walls[:, 3] - walls[:, 1]
    here = rx * (y - walls[:, 1]) - ry * (x - walls[:, 0])
    there = rx * (y + dy - walls[:, 1]) - ry * (x + dx - walls[:, 0])
    return float(((first * last < 0.0) & (here * there < 0.0)).any())


def describe_openings(corridor: Corridor) -> RowArrays:
    """The mouths of the arms that leave the corridor; the base pose lies in the mouth."""
    rows = [
        (opening, 1.0 if opening.left else -1.0, junction)
        for junction in corridor.junctions
        for opening in junction.openings
    ]
    ends = [(each.near, side * each.offset, each.far, side * each.offset) for each, side, _ in rows]
    bases = [(each.centre, side * each.offset, side * math.pi / 2) for each, side, _ in rows]
    extras = [
        (
            side,
            float(junction.ahead),
            float(len(junction.openings) - 1),
            float(each.far < corridor.end - MIN_CONTINUATION),
            each.offset,
            (each.far - each.near) / 2.0,
            junction.centre / 10.0,
        )
        for each, side, junction in rows
    ]
    sizes = (4, 3, 7)
    return tuple(
        np.array(each, np.float64).reshape(-1, size)
        for each, size in zip((ends, bases, extras), sizes, strict=True)
    )  # type: ignore[return-value]
