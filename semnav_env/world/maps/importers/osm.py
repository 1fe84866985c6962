"""Floors of OpenStreetMap buildings that are drawn by Simple Indoor Tagging (.osm)."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np

from semnav_env.world.maps.importers.documents import finite, read_xml
from semnav_env.world.maps.importers.door_faces import LEAST_DOOR_WIDTH
from semnav_env.world.maps.importers.drawing import MAX_DRAWING_EXTENT, MAX_SEGMENTS
from semnav_env.world.maps.importers.imported import ImportedPlan, counted
from semnav_env.world.maps.importers.osm_ring import RingPoint, edges_of
from semnav_env.world.maps.importers.traced_rooms import TracedRoom, plan_of_rooms
from semnav_env.world.maps.rules import FloorPlanError
from semnav_features.frames import FloatArray, Point
from semnav_features.validation import shown

DOOR_WIDTH = 0.9
"""Width of a door whose width is not tagged, metres."""

WALLED = ("room", "corridor")
"""Values of `indoor` with walls around them."""

LEVEL = re.compile(r"(-?\d+(?:\.\d+)?)(?:-(-?\d+(?:\.\d+)?))?")
"""A level, or the first and the last of several, as in "0-3" and "-1-3"."""

SHUT_TAGS = frozenset(
    {
        *(("stairs", "yes"), ("room", "stairs"), ("highway", "steps")),
        *(("room", "elevator"), ("highway", "elevator")),
    }
)
"""Tags of spaces that no robot enters: stairs and lifts."""

WHAT_IT_IS = (
    "an OpenStreetMap file has <node> elements with id, lat and lon, and for each room or corridor "
    "a closed <way> of them with the tags indoor and level (Simple Indoor Tagging)"
)

Tags = Mapping[str, str]


@dataclass(frozen=True)
class OsmSpace:
    """A closed way that is a room or a corridor.

    Attributes:
        tags: of the way.
        nodes: identifiers of its corners, the first one once.
    """

    tags: Tags
    nodes: tuple[str, ...]

    @property
    def name(self) -> str:
        """What its door says: its name, or its number."""
        return self.tags.get("name") or self.tags.get("ref") or self.tags["indoor"]


class OsmBuilding:
    """The rooms, corridors and doors of a file.

    Args:
        path: the file.

    Raises:
        FloorPlanError: not such a file; names what is wrong.
    """

    def __init__(self, path: Path) -> None:
        root = read_xml(path, WHAT_IT_IS)
        self.path = path
        self._tags: dict[str, Tags] = {}
        self._places: dict[str, tuple[float, float]] = {}
        for node in root.iter("node"):
            self._add_node(node)
        self.spaces: list[OsmSpace] = []
        self._others: list[Tags] = []
        for way in root.iter("way"):
            tags, nodes = tags_of(way), _nodes_of(way)
            is_ring = len(nodes) > 3 and nodes[0] == nodes[-1]
            if tags.get("indoor") in WALLED and is_ring and levels_of(tags):
                self.spaces.append(OsmSpace(tags, nodes[:-1]))
            elif "indoor" in tags:
                self._others.append(tags)
        if not self.spaces:
            raise FloorPlanError(f"{path}: holds no room and no corridor on a level; {WHAT_IT_IS}")

    @cached_property
    def levels(self) -> Mapping[str, int]:
        """The levels with their numbers of rooms and corridors, the lowest first."""
        counts = Counter(level for space in self.spaces for level in levels_of(space.tags))
        return {f"{level:g}": counts[level] for level in sorted(counts)}

    def spaces_on(self, level: str) -> list[OsmSpace]:
        """The rooms and corridors on a level."""
        return [space for space in self.spaces if float(level) in levels_of(space.tags)]

    def left_out(self, level: str) -> tuple[str, ...]:
        """The other ways on a level, such as areas without walls and rooms that are not closed."""
        counts = Counter(tags["indoor"] for tags in self._others if float(level) in levels_of(tags))
        return tuple(
            f"indoor={kind}, {counted(count, 'ways')}" + ", which are not closed" * (kind in WALLED)
            for kind, count in sorted(counts.items())
        )

    def door_width(self, node: str, level: str) -> float:
        """Width of the door at a node on a level, metres; 0 if there is none."""
        tags = self._tags.get(node, {})
        on_level = not levels_of(tags) or float(level) in levels_of(tags)
        if "door" not in tags or not on_level:
            return 0.0
        return _width(tags.get("door:width") or tags.get("width"))

    def metres(self, spaces: Sequence[OsmSpace]) -> dict[str, Point]:
        """Places of the corners of spaces: most walls along the axes, the lower left corner 0.

        Raises:
            FloorPlanError: a corner is missing, or they are too far apart.
        """
        nodes = list(dict.fromkeys(node for space in spaces for node in space.nodes))
        for node in nodes:
            if node not in self._places:
                raise FloorPlanError(f"{self.path}: node {node} of a way is missing; {WHAT_IT_IS}")
        flat = on_plane(np.array([self._places[node] for node in nodes]))
        numbers = {node: k for k, node in enumerate(nodes)}
        sides = [
            flat[[numbers[node] for node in (*space.nodes, space.nodes[0])]] for space in spaces
        ]
        turned = flat @ _turn(main_direction(np.concatenate([np.diff(s, axis=0) for s in sides])))
        turned -= turned.min(axis=0)
        east, north = turned.max(axis=0)
        if max(east, north) > MAX_DRAWING_EXTENT:
            raise FloorPlanError(
                f"{self.path}: spans {east:,.0f} m x {north:,.0f} m; at most "
                f"{MAX_DRAWING_EXTENT:,.0f} m are read: cut one building out of it"
            )
        return dict(zip(nodes, map(tuple, turned.round(4).tolist()), strict=True))

    def _add_node(self, node: Element) -> None:
        name = node.get("id", "")
        try:
            self._places[name] = finite(node.get("lat")), finite(node.get("lon"))
        except (TypeError, ValueError) as error:
            raise FloorPlanError(f"{self.path}: node {name:.20}: {error}; {WHAT_IT_IS}") from None
        if tags := tags_of(node):
            self._tags[name] = tags


def load_osm(path: Path, level: str | None = None) -> ImportedPlan:
    """The floor plan of a level of an OpenStreetMap file with Simple Indoor Tagging.

    Each way with `indoor=room` or `indoor=corridor` becomes a region with walls around it, which
    have no thickness. A node with `door` on the outlines of two of them is an open door, of
    `DOOR_WIDTH` if neither `door:width` nor `width` says otherwise; on one outline it is a closed
    one. The plan is turned so that most walls lie along the axes. Source:
    https://wiki.openstreetmap.org/wiki/Simple_Indoor_Tagging.

    Args:
        path: the file.
        level: of the building, such as "0"; not needed if the file has one level only.

    Raises:
        FloorPlanError: not such a file, or no such level; names what is wrong.
    """
    building = OsmBuilding(path)
    told = ", ".join(
        f"{name} ({counted(count, 'spaces')})" for name, count in building.levels.items()
    )
    level = next(iter(building.levels)) if level is None and len(building.levels) == 1 else level
    if level is None or level not in building.levels:
        said = "has several levels" if level is None else f"has no level {shown(level)}"
        raise FloorPlanError(f"{path}: {said}; give --drawing.level, one of: {told}")
    spaces = building.spaces_on(level)
    if sum(len(space.nodes) for space in spaces) > MAX_SEGMENTS:
        raise FloorPlanError(f"{path}: more than {MAX_SEGMENTS:,} segments; no floor has as many")
    places = building.metres(spaces)
    rooms = [_room(space, building, level, places) for space in spaces]
    plan, report = plan_of_rooms(rooms, path, "level of an OpenStreetMap building")
    notes = (f"level {level} of: {told}", *report.notes)
    report = replace(report.with_left_out(building.left_out(level)), notes=notes)
    return ImportedPlan(replace(plan, name=f"{plan.name} {level}"), report)


def _room(
    space: OsmSpace, building: OsmBuilding, level: str, places: Mapping[str, Point]
) -> TracedRoom:
    ring = [RingPoint(places[node], building.door_width(node, level)) for node in space.nodes]
    is_shut = any(tag in SHUT_TAGS for tag in space.tags.items())
    return TracedRoom(space.name, space.tags["indoor"], tuple(edges_of(ring)), is_shut)


def tags_of(element: Element) -> dict[str, str]:
    """The tags of an element."""
    return {tag.get("k", ""): tag.get("v", "").strip() for tag in element.iter("tag")}


def levels_of(tags: Tags) -> frozenset[float]:
    """The levels of `level` and `repeat_on`: "0", "0;1", "0-3" and "-1-3" are understood."""
    found: set[float] = set()
    for part in f"{tags.get('level', '')};{tags.get('repeat_on', '')}".split(";"):
        if match := LEVEL.fullmatch(part.strip()):
            first = float(match[1])
            last = min(float(match[2] or first), first + MAX_LEVELS)
            found |= {first, last, *map(float, range(math.ceil(first), math.floor(last) + 1))}
    return frozenset(found)


MAX_LEVELS = 200.0
"""The most levels of one range."""


def on_plane(places: FloatArray) -> FloatArray:
    """Metres to the east and north of the middle, shape (n, 2), on a plane that touches the earth.

    Degrees are as long as on the WGS84 ellipsoid at the middle's latitude (series of its arcs; a
    building of 1 km is true to a few millimetres).

    Args:
        places: latitudes and longitudes, degrees, shape (n, 2).
    """
    middle = places.mean(axis=0)
    phi = math.radians(float(middle[0]))
    north = 111132.954 - 559.822 * math.cos(2 * phi) + 1.175 * math.cos(4 * phi)
    east = 111412.84 * math.cos(phi) - 93.5 * math.cos(3 * phi) + 0.118 * math.cos(5 * phi)
    flat: FloatArray = ((places - middle) * (north, east))[:, ::-1]
    return flat


def main_direction(sides: FloatArray) -> float:
    """The direction of most walls and of those at a right angle to them, radians, -pi/4 to pi/4.

    Args:
        sides: vectors of walls, shape (n, 2), which count by the square of their lengths.
    """
    fourfold = (sides[:, 0] + 1j * sides[:, 1]) ** 4
    lengths = np.maximum(np.hypot(*sides.T), 1e-9)
    return float(np.angle((fourfold / lengths**2).sum())) / 4.0


def _turn(angle: float) -> FloatArray:
    """The matrix from whose right rows of points are turned by -angle."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array(((c, -s), (s, c)))


def _nodes_of(way: Element) -> tuple[str, ...]:
    """The identifiers of a way's nodes, without repetitions in a row."""
    nodes = [node.get("ref", "") for node in way.iter("nd")]
    return tuple([*nodes[:1], *(b for a, b in pairwise(nodes) if a != b)])


def _width(text: str | None) -> float:
    """A width in metres, as "0.9" or "0.9 m"; the usual one if it cannot be read."""
    try:
        width = finite((text or "").removesuffix("m").strip())
    except ValueError:
        return DOOR_WIDTH
    return width if width >= LEAST_DOOR_WIDTH else DOOR_WIDTH
