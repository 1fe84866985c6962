"""The immutable floor plan: solid surfaces, materials, and named doors and regions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from enum import StrEnum
from functools import cached_property
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray
from shapely import (
    Polygon,
    STRtree,
    get_coordinates,
    get_parts,
    get_rings,
    linearrings,
    linestrings,
    polygons,
)
from shapely.geometry.base import BaseGeometry

from semnav_features.frames import FloatArray, Point
from semnav_features.rules import DoorRules
from semnav_features.scene import Door, PlainWalls, StillScene

OFFICE_PREFIX = "office"
"""First part of the names of generated offices, as in "office:medium:17"."""

_USUAL_RULES = DoorRules()


class Material(StrEnum):
    """Material of a surface; glass stops the body but not the beam."""

    WALL = "wall"
    GLASS = "glass"
    LEAF = "leaf"
    FURNITURE = "furniture"
    PERSON = "person"


@dataclass(frozen=True)
class Surface:
    """A solid polyline; closed ones repeat their first point.

    Attributes:
        points: (x, y) in metres, at least two.
        material: glass is not seen by the lidar.
        assumed: whether it closes a part that the source of the plan leaves open.
    """

    points: tuple[Point, ...]
    material: Material = Material.WALL
    assumed: bool = False

    @property
    def is_closed(self) -> bool:
        """Whether it encloses an area."""
        return len(self.points) > 3 and self.points[0] == self.points[-1]


@dataclass(frozen=True)
class PlanDoor:
    """A doorway of a plan.

    Attributes:
        name: unique in the plan.
        start: one jamb, (x, y) in metres.
        end: the other jamb.
        open: whether a robot may pass; a closed door's leaf fills the opening.
        is_door: whether it is a door or a mere opening of the wall; None if its width tells.
    """

    name: str
    start: Point
    end: Point
    open: bool = True
    is_door: bool | None = None

    @property
    def midpoint(self) -> Point:
        """Middle of the opening, (x, y) in metres."""
        return self.as_door().midpoint

    @property
    def width(self) -> float:
        """Distance between the jambs, metres."""
        return self.as_door().width

    def counts(self, rules: DoorRules) -> bool:
        """Whether "the second door" counts it: it is open, and as wide as a door."""
        if self.is_door is not None:
            return self.open and self.is_door
        return self.open and rules.narrowest <= self.width <= rules.widest

    def is_doubtful(self, rules: DoorRules, doubt: float) -> bool:
        """Whether it is open, and only a little wider or narrower than a door.

        Args:
            rules: widths of doors.
            doubt: how much wider than the widest, or narrower than the narrowest, metres.
        """
        beyond = max(self.width - rules.width_max, rules.width_min - self.width)
        return self.open and 0.0 < round(beyond, 3) <= doubt  # a door drawn 1.2 m wide is no wider

    def is_opening(self, rules: DoorRules) -> bool:
        """Whether it is too wide for a door, open or not: an opening of the wall."""
        if self.is_door is not None:
            return not self.is_door and self.width > rules.width_max
        return self.width > rules.widest

    def as_door(self) -> Door:
        """The door as a scene holds it."""
        return Door(self.start, self.end, self.name)


@dataclass(frozen=True)
class Region:
    """A named area: a room, a corridor, an intersection or an open area.

    Attributes:
        name: unique among the regions of the plan.
        polygon: metres.
        assumed: whether the source of the plan does not show it.
    """

    name: str
    polygon: Polygon
    assumed: bool = False

    @cached_property
    def bounds(self) -> tuple[float, float, float, float]:
        """Least x, least y, greatest x and greatest y, metres."""
        west, south, east, north = self.polygon.bounds
        return west, south, east, north

    @cached_property
    def edges(self) -> FloatArray:
        """`edges_of` its polygon."""
        return edges_of(self.polygon)


NamedPart = TypeVar("NamedPart", PlanDoor, Region)
"""A door or a region of a plan."""

Made = TypeVar("Made")
"""Type of a value that is derived from a plan."""


@dataclass(frozen=True)
class FloorPlan:
    """One storey, in metres, in the world frame (x right, y up on the page).

    Attributes:
        name: short identifier.
        surfaces: everything solid.
        doors: named doorways.
        rooms: named rooms.
        corridors: named stretches of corridor.
        intersections: named places where corridors meet.
        boundary: the outline; a robot never leaves it.
        source: origin of the plan, in words.
        areas: named areas that are open to a corridor, as a lounge without a front wall.
    """

    name: str
    surfaces: tuple[Surface, ...]
    doors: tuple[PlanDoor, ...]
    rooms: tuple[Region, ...]
    corridors: tuple[Region, ...]
    intersections: tuple[Region, ...]
    boundary: Polygon
    source: str = ""
    areas: tuple[Region, ...] = ()

    @cached_property
    def segments(self) -> FloatArray:
        """Everything that stops a body, shape (n, 4): x1, y1, x2, y2 in metres."""
        rows = [(*a, *b) for s in self.surfaces for a, b in _pairs(s)]
        return _frozen(np.array(rows, dtype=np.float64).reshape(-1, 4))

    @cached_property
    def opaque_segments(self) -> FloatArray:
        """The segments that stop a beam, shape (m, 4): all but glass."""
        opaque = np.array([s.material is not Material.GLASS for s in self.surfaces], dtype=bool)
        return _frozen(self.segments[opaque[self.owners]])

    @cached_property
    def owners(self) -> NDArray[np.intp]:
        """Index of the surface that each row of `segments` belongs to, shape (n,)."""
        counts = np.array([len(surface.points) - 1 for surface in self.surfaces], dtype=np.intp)
        return np.repeat(np.arange(len(counts)), counts)

    @cached_property
    def solids(self) -> STRtree:
        """Spatial index of `segments`, in the same order, for offline queries."""
        return STRtree(np.asarray(linestrings(self.segments.reshape(-1, 2, 2))))

    @cached_property
    def furniture(self) -> STRtree:
        """Spatial index of the areas that closed furniture and people on the floor cover."""
        closed = [
            surface.points
            for surface in self.surfaces
            if surface.material in (Material.FURNITURE, Material.PERSON) and surface.is_closed
        ]
        corners = np.array([corner for points in closed for corner in points]).reshape(-1, 2)
        piece = np.repeat(np.arange(len(closed)), [len(points) for points in closed])
        return STRtree(polygons(linearrings(corners, indices=piece)))

    @cached_property
    def door_ends(self) -> FloatArray:
        """The jambs of `doors`, open or not, shape (m, 4): x1, y1, x2, y2 in metres."""
        rows = [(*door.start, *door.end) for door in self.doors]
        return _frozen(np.array(rows, dtype=np.float64).reshape(-1, 4))

    def derived(self, make: Callable[[FloorPlan], Made]) -> Made:
        """The result of a function of the plan alone; it is computed once and shared."""
        if make not in self._derived:
            self._derived[make] = make(self)
        made: Made = self._derived[make]
        return made

    @cached_property
    def _derived(self) -> dict[Callable[[FloorPlan], Any], Any]:
        """Values that have been derived so far."""
        return {}

    def __getstate__(self) -> dict[str, Any]:
        """The fields alone; derived values are computed again where they are needed."""
        return {each.name: getattr(self, each.name) for each in fields(self)}

    def __deepcopy__(self, memo: dict[int, Any]) -> FloorPlan:
        """The plan itself: it never changes."""
        return self

    @property
    def regions(self) -> tuple[Region, ...]:
        """Every room, corridor, intersection and open area."""
        return self.rooms + self.corridors + self.intersections + self.areas

    @property
    def scene(self) -> StillScene:
        """The scene by the default rules, see `scene_by`."""
        return self.scene_by(_USUAL_RULES)

    def scene_by(self, rules: DoorRules) -> StillScene:
        """All walls (glass included) and all doors that count by some rules, world frame."""
        if rules not in self._scenes:
            doors = tuple(door.as_door() for door in self.doors if door.counts(rules))
            self._scenes[rules] = StillScene(PlainWalls(self.segments), doors)
        return self._scenes[rules]

    @cached_property
    def _scenes(self) -> dict[DoorRules, StillScene]:
        """Scenes that were made so far."""
        return {}

    @property
    def room_names(self) -> tuple[str, ...]:
        """The names of the rooms, in the order of the plan."""
        return tuple(room.name for room in self.rooms)

    def door(self, name: str) -> PlanDoor:
        """The door of that name.

        Raises:
            KeyError: no such door; lists those there are.
        """
        return _named(self.doors, name, f"{self.name} has no door")

    def region(self, name: str) -> Region:
        """The room, corridor, intersection or open area of that name.

        Raises:
            KeyError: no such region; lists those there are.
        """
        return _named(self.regions, name, f"{self.name} has no region")


def _named(parts: tuple[NamedPart, ...], name: str, problem: str) -> NamedPart:
    """The part of that name; a `KeyError` that states the problem and lists the names if none."""
    for part in parts:
        if part.name == name:
            return part
    names = ", ".join(part.name for part in parts)
    raise KeyError(f"{problem} {name!r}; there are: {names}")


def _pairs(surface: Surface) -> list[tuple[Point, Point]]:
    return list(zip(surface.points, surface.points[1:], strict=False))


def edges_of(areas: BaseGeometry | NDArray[Any]) -> FloatArray:
    """The edges of outlines and of holes, shape (n, 4): x1, y1, x2, y2 in metres.

    Args:
        areas: an area, or an array of them.
    """
    corners, ring = get_coordinates(get_rings(get_parts(areas)), return_index=True)
    joined = ring[:-1] == ring[1:]
    edges: FloatArray = np.hstack((corners[:-1], corners[1:]))[joined]
    return edges


def _frozen(array: FloatArray) -> FloatArray:
    array.setflags(write=False)
    return array
