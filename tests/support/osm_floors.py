"""Small buildings in the format of OpenStreetMap: a corridor 40 m by 2 m, rooms to its north."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from semnav_features.frames import Point
from tests.support.paths import DATA

NORTH, EAST = 111_252.0, 70_200.0
"""About as many metres has a degree of latitude and of longitude at `MIDDLE`."""

MIDDLE = 51.0, 13.7
"""Latitude and longitude of the origin, degrees."""

Tags = Mapping[str, str]


def node(number: int, place: Point, tags: Tags | None = None, turned: float = 0.0) -> str:
    """A node at a place in metres, turned about the origin by an angle in radians."""
    c, s = math.cos(turned), math.sin(turned)
    x, y = c * place[0] - s * place[1], s * place[0] + c * place[1]
    where = f'lat="{MIDDLE[0] + y / NORTH:.9f}" lon="{MIDDLE[1] + x / EAST:.9f}"'
    return f'<node id="{number}" {where}>{_told(tags or {})}</node>'


def way(nodes: Sequence[int], tags: Tags) -> str:
    """A closed way."""
    rows = "".join(f'<nd ref="{number}"/>' for number in (*nodes, nodes[0]))
    return f"<way>{rows}{_told(tags)}</way>"


def building(*parts: str) -> str:
    """A file of nodes and ways."""
    return f"<?xml version='1.0'?><osm version='0.6'>{''.join(parts)}</osm>"


def hall_and_rooms(
    doors: Sequence[Tags] = ({"door": "hinged"},),
    level: str = "0",
    turned: float = 0.0,
    room: Tags | None = None,
) -> str:
    """A corridor with a room of 4 m by 4 m for each door, in the middle of the wall between them.

    Args:
        doors: the tags of each door.
        level: of all spaces.
        turned: angle of the building, radians.
        room: further tags of the rooms.
    """
    count = len(doors)
    places: dict[int, Point] = {1: (0.0, 0.0), 2: (40.0, 0.0), 3: (40.0, 2.0), 4: (0.0, 2.0)}
    parts = [node(number, place, None, turned) for number, place in places.items()]
    north: list[int] = []
    spaces = []
    for k in reversed(range(count)):
        x, first = 4.0 * k + 2.0, 10 * (k + 1)
        corners = [(x - 2, 2.0), (x + 2, 2.0), (x + 2, 6.0), (x - 2, 6.0)]
        parts += [node(first + j, place, None, turned) for j, place in enumerate(corners)]
        parts.append(node(first + 4, (x, 2.0), doors[k], turned))
        north += [first + 1, first + 4, first]
        ring = [first, first + 4, first + 1, first + 2, first + 3]
        tags = {"indoor": "room", "level": level, "ref": f"R{k + 1}", **(room or {})}
        spaces.append(way(ring, tags))
    hall = {"indoor": "corridor", "level": level, "ref": "F1"}
    return building(*parts, *spaces, way([1, 2, 3, *north, 4], hall))


def _told(tags: Tags) -> str:
    return "".join(f'<tag k="{key}" v="{value}"/>' for key, value in tags.items())


real_building = DATA / "osm_apb" / "APBorig.osm"
"""A real building of four floors, where it is there."""
