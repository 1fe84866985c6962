"""Finds doorways across hallways that nobody labelled: where walls narrow a hallway to a door."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import STRtree

from semnav_env.world.maps.floor_plan import PlanDoor, Region
from semnav_env.world.maps.importers.gaps import (
    CROSSING_DEPTH,
    DOORWAY_WIDTHS,
    apart,
    is_passable,
    places_beside,
)
from semnav_features.frames import FloatArray, Point

WIDEST_NARROWING = 1.35
"""Width of the widest narrowing, metres: what somebody may count as a door at most (1.2 m, and
`SuccessRules.door_doubt`)."""

LEAST_WIDENING = 0.1
"""How much wider the hallway is before and behind, at least, metres: two pixels of a usual map."""

JAMB_SHARE = 0.02
"""Share of a narrowing beside each of its ends in which the wall that it ends at may stand."""


def find_narrowings(
    halls: Sequence[Region], solids: STRtree, is_free: Callable[[Point], bool]
) -> tuple[PlanDoor, ...]:
    """The gaps of door width across hallways, which narrow there and are wider on both sides.

    A door is a gap of such a width between the ends of two walls (Barbret 2021, section 3.1), with
    or without a leaf, and nobody who sees the map can tell whether there is one. Each gap is the
    shortest way from a corner of a wall to another wall. `CROSSING_DEPTH` before and behind it the
    hallway is wider by `LEAST_WIDENING`, and a robot can go straight through. Of several with
    nearly the same middle the narrowest is kept.

    Args:
        halls: corridors.
        solids: the walls, segments.
        is_free: whether a point is known to be free.

    Returns:
        Open doors, named by the corridor on both sides.
    """
    doors = sorted(_narrowings(halls, solids), key=lambda door: door.width)
    return apart([door for door in doors if is_passable(door, solids, is_free)])


def _narrowings(halls: Sequence[Region], solids: STRtree) -> Iterator[PlanDoor]:
    """All narrowings in hallways, many of them nearly the same."""
    ends = _gaps(halls, solids)
    for start, end in ends[_widens(ends, solids)].tolist():
        jambs = (start[0], start[1]), (end[0], end[1])
        sides = places_beside(*jambs, halls)
        if None not in sides:
            yield PlanDoor(" - ".join(sorted(map(str, sides))), *jambs)


def _gaps(halls: Sequence[Region], solids: STRtree) -> FloatArray:
    """The shortest ways from corners of walls to other walls around hallways, shape (n, 2, 2)."""
    around = shapely.union_all([hall.polygon for hall in halls]).buffer(WIDEST_NARROWING)
    walls = solids.geometries[solids.query(around, "intersects")]
    points = shapely.points(np.unique(shapely.get_coordinates(walls), axis=0))
    corner, wall = solids.query(points, "dwithin", WIDEST_NARROWING)
    lines = shapely.shortest_line(points[corner], solids.geometries[wall])
    coordinates = shapely.get_coordinates(lines[shapely.length(lines) >= DOORWAY_WIDTHS[0]])
    ends: FloatArray = coordinates.reshape(-1, 2, 2)
    return ends[_are_free(_between(ends, JAMB_SHARE, 1.0 - JAMB_SHARE), solids)]


def _widens(ends: FloatArray, solids: STRtree) -> NDArray[np.bool_]:
    """Whether the way is wider both before and behind each gap, shape (n,)."""
    along = ends[:, 1] - ends[:, 0]
    width = np.hypot(*along.T)
    across = CROSSING_DEPTH * np.column_stack((-along[:, 1], along[:, 0])) / width[:, None]
    more = LEAST_WIDENING / width
    # One end of the gap can be moved on by all of it, or each end by a half.
    moved = (
        (JAMB_SHARE, 1.0 + more),
        (-more / 2.0, 1.0 + more / 2.0),
        (-more, 1.0 - JAMB_SHARE),
    )
    before, behind = (
        np.any([_are_free(_between(ends + side[:, None], *way), solids) for way in moved], axis=0)
        for side in (across, -across)
    )
    return np.asarray(before & behind)


def _between(ends: FloatArray, low: FloatArray | float, high: FloatArray | float) -> FloatArray:
    """The part of each line, shape (n, 2, 2), from one share of its length to another."""
    along = ends[:, 1] - ends[:, 0]
    shares = (np.broadcast_to(share, len(ends))[:, None] for share in (low, high))
    return np.stack([ends[:, 0] + share * along for share in shares], axis=1)


def _are_free(ends: FloatArray, solids: STRtree) -> NDArray[np.bool_]:
    """Whether no wall touches a line, for each of them, shape (n, 2, 2)."""
    free = np.ones(len(ends), dtype=bool)
    free[solids.query(shapely.linestrings(ends), "intersects")[0]] = False
    return free
