"""Finds doorways without a label: gaps in the walls between two labelled places."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import shapely
from shapely import LineString, STRtree

from semnav_env.world.maps.doorways import NARROWEST_ROBOT
from semnav_env.world.maps.floor_plan import PlanDoor, Region
from semnav_env.world.maps.importers.fitting import Band
from semnav_features.frames import Point, middle_of

DOORWAY_WIDTHS = (0.6, 2.2)
"""Width of the narrowest and of the widest doorway, metres."""

CROSSING_DEPTH = 0.6
"""Distance before and behind a doorway at which there must be two different places, metres."""

LEAST_DOORWAY_DISTANCE = 0.6
"""Distance between the middles of two doorways below which they are one, metres."""

LEAST_BORDER_LENGTH = 0.3
"""Length below which pieces of a border are left out, metres; borders are simplified by half of
it."""


def find_doorways(
    places: Sequence[Region], solids: STRtree, is_free: Callable[[Point], bool]
) -> tuple[PlanDoor, ...]:
    """The gaps of door width in the walls along the borders of places that lead to another place.

    Borders are drawn by hand and lie some decimetres beside the walls; a `Band` along each straight
    piece of them finds the gaps nevertheless. A robot must be able to go straight through, from
    `CROSSING_DEPTH` before to as far behind. Of several within `LEAST_DOORWAY_DISTANCE` the
    narrowest is kept.

    Args:
        places: rooms and corridors.
        solids: the walls, segments.
        is_free: whether a point is known to be free.

    Returns:
        Open doors, named by the places they join.
    """
    doors = sorted(_doorways(places, solids), key=lambda door: door.width)
    return apart([door for door in doors if is_passable(door, solids, is_free)])


def is_passable(door: PlanDoor, solids: STRtree, is_free: Callable[[Point], bool]) -> bool:
    """Whether a robot can go straight through, from `CROSSING_DEPTH` before to as far behind."""
    way = _way(door)
    if len(solids.query(way.buffer(NARROWEST_ROBOT / 2, cap_style="flat"), "intersects")):
        return False
    return all(is_free((x, y)) for x, y in way.segmentize(0.05).coords)


def apart(doors: Sequence[PlanDoor]) -> tuple[PlanDoor, ...]:
    """The doors without those within `LEAST_DOORWAY_DISTANCE` of one before them."""
    kept: list[PlanDoor] = []
    for door in doors:
        if all(math.dist(door.midpoint, other.midpoint) > LEAST_DOORWAY_DISTANCE for other in kept):
            kept.append(door)
    return tuple(kept)


def places_beside(
    start: Point, end: Point, places: Sequence[Region]
) -> tuple[str | None, str | None]:
    """The places to the left and to the right of an opening, `CROSSING_DEPTH` from its middle."""
    width = max(math.dist(start, end), 1e-9)
    side = (
        CROSSING_DEPTH * (start[1] - end[1]) / width,
        CROSSING_DEPTH * (end[0] - start[0]) / width,
    )
    x, y = middle_of(start, end)
    left, right = (_place_at((x + s * side[0], y + s * side[1]), places) for s in (1.0, -1.0))
    return left, right


def _doorways(places: Sequence[Region], solids: STRtree) -> Iterator[PlanDoor]:
    for place in places:
        ring = shapely.simplify(place.polygon.exterior, LEAST_BORDER_LENGTH / 2)
        corners = [(float(x), float(y)) for x, y in ring.coords]
        for start, end in pairwise(corners):
            if math.dist(start, end) < LEAST_BORDER_LENGTH:
                continue
            band = Band.along(start, end, solids)
            for gap in band.gaps[1:-1]:
                if gap[1] <= 0.0 or gap[0] >= band.length or not band.is_closed(gap):
                    continue
                jambs = band.jambs(gap)
                sides = places_beside(*jambs, places)
                wide = DOORWAY_WIDTHS[0] <= math.dist(*jambs) <= DOORWAY_WIDTHS[1]
                if wide and None not in sides and sides[0] != sides[1]:
                    yield PlanDoor(" - ".join(sorted(map(str, sides))), *jambs)


def _way(door: PlanDoor) -> LineString:
    """The straight way through a door, `CROSSING_DEPTH` to both sides."""
    (x1, y1), (x2, y2) = door.start, door.end
    x, y = door.midpoint
    dx, dy = CROSSING_DEPTH * (y1 - y2) / door.width, CROSSING_DEPTH * (x2 - x1) / door.width
    return LineString(((x + dx, y + dy), (x - dx, y - dy)))


def _place_at(point: Point, places: Sequence[Region]) -> str | None:
    for place in places:
        if shapely.contains_xy(place.polygon, *point):
            return place.name
    return None
