"""Plans of rooms that are traced along their own walls, so that walls have a thickness."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from pathlib import Path

import shapely
from shapely import LineString, Polygon, STRtree

from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor, Region, Surface
from semnav_env.world.maps.importers.building_doors import corridor_to_the_left, hang_doors
from semnav_env.world.maps.importers.corridor_kinds import Space, are_corridors
from semnav_env.world.maps.importers.door_faces import DoorFace, TwoFacedDoor, doorways_between
from semnav_env.world.maps.importers.imported import ImportedPlan, ImportReport, boundary_of
from semnav_env.world.maps.rules import (
    LEAST_SEGMENT_LENGTH,
    FloorPlanError,
    check_door,
    check_doorway,
    check_region,
)
from semnav_features.frames import Point

REGION_OVERLAP = 0.01
"""Distance that the floor of a doorway reaches into the room, metres, so that both are one."""


@dataclass(frozen=True)
class Edge:
    """A straight part of the outline of a room: a wall, or one face of a door.

    Attributes:
        start: (x, y) in metres.
        end: likewise.
        is_door: whether it is the face of a door.
    """

    start: Point
    end: Point
    is_door: bool


@dataclass(frozen=True)
class TracedRoom:
    """A room and the edges around it, in order.

    Attributes:
        name: its name, not necessarily unique.
        kind: what it is for, as the drawing says; may be empty.
        edges: a closed ring.
        is_shut: whether its doors are closed to robots, as those of a lift.
    """

    name: str
    kind: str
    edges: tuple[Edge, ...]
    is_shut: bool = False

    @cached_property
    def polygon(self) -> Polygon:
        """Its floor; of an outline that crosses itself the largest part."""
        return _largest(shapely.make_valid(Polygon([edge.start for edge in self.edges])))

    @property
    def walls(self) -> Iterator[tuple[Point, ...]]:
        """The polylines of its walls, from door to door."""
        run: list[Point] = []
        for edge in self.edges:
            if edge.is_door:
                yield tuple(run)
                run = []
            else:
                run = [*(run or [edge.start]), edge.end]
        yield tuple(run)


def plan_of_rooms(rooms: Sequence[TracedRoom], path: Path, kind: str) -> ImportedPlan:
    """The floor plan of traced rooms.

    The two faces of a door are paired (`doorways_between`) and joined by reveals; the door's line
    lies half way between them, and the rooms reach up to it. A face without a partner, the doors of
    lifts, and doors that leave no robot a way are closed. Corridors are told from rooms by
    `are_corridors`.

    Args:
        rooms: with outlines in metres.
        path: file that they were read from.
        kind: kind of file, in words.

    Raises:
        FloorPlanError: nothing is left.
    """
    rooms = [room for room in rooms if len(room.edges) > 2 and not room.polygon.is_empty]
    faces = [
        DoorFace(k, edge.start, edge.end)
        for k, room in enumerate(rooms)
        for edge in room.edges
        if edge.is_door
    ]
    lines = [line for room in rooms for line in room.walls if len(line) > 1]
    if not lines:
        raise FloorPlanError(f"{path}: holds no wall; a {kind} has at least one room")
    doorways = doorways_between(faces, _tree(lines))
    reveals = [
        line
        for each in doorways
        for line in each.reveals
        if math.dist(*line) >= LEAST_SEGMENT_LENGTH
    ]
    surfaces = tuple([Surface(line) for line in (*lines, *reveals)])
    halls, others, lost = _regions(rooms, doorways)
    boundary = boundary_of(surfaces)
    name, source = path.name.split(".")[0], f"{kind} {path.name}"
    bare = FloorPlan(name, surfaces, (), others, halls, (), boundary, source)
    plan = _with_doors(bare, list(_doors(rooms, faces, doorways, bare)))
    taken = {
        "segments": len(plan.segments),
        "open doors": sum(door.open for door in plan.doors),
        "closed doors": sum(not door.open for door in plan.doors),
        "rooms": len(plan.rooms),
        "corridors": len(plan.corridors),
    }
    single = len(faces) - 2 * len(doorways)
    notes = (f"{single} faces of doors without a partner are closed",) if single else ()
    return ImportedPlan(plan, ImportReport((str(path),), kind, taken, lost, notes))


def _regions(
    rooms: Sequence[TracedRoom], doorways: Sequence[TwoFacedDoor]
) -> tuple[tuple[Region, ...], tuple[Region, ...], tuple[str, ...]]:
    """Corridors, rooms, and why others were left out."""
    floors = [room.polygon for room in rooms]
    counts: Counter[int] = Counter()
    for doorway in doorways:
        for face in (doorway.one, doorway.other):
            floors[face.room] = _with_floor(floors[face.room], doorway, face)
            counts[face.room] += 1
    spaces = [Space(room.kind, room.polygon, counts[k]) for k, room in enumerate(rooms)]
    kinds: tuple[list[Region], list[Region]] = ([], [])
    lost = []
    for name, floor, is_hall in zip(
        _unique([room.name for room in rooms]), floors, are_corridors(spaces), strict=True
    ):
        try:
            region = Region(name, floor)
            check_region(region)
        except FloorPlanError as error:
            lost.append(str(error))
        else:
            kinds[0 if is_hall else 1].append(region)
    return tuple(kinds[0]), tuple(kinds[1]), tuple(lost)


def _with_floor(room: Polygon, doorway: TwoFacedDoor, face: DoorFace) -> Polygon:
    """A room with the floor of a doorway up to the door's line."""
    step = doorway.half(face is doorway.one)
    return _largest(
        shapely.union(room, shapely.make_valid(step).buffer(REGION_OVERLAP, join_style="mitre"))
    )


def _doors(
    rooms: Sequence[TracedRoom],
    faces: Sequence[DoorFace],
    doorways: Sequence[TwoFacedDoor],
    plan: FloorPlan,
) -> Iterator[PlanDoor]:
    """All doors; those between two rooms that a robot enters are open."""
    names = _unique([room.name for room in rooms])
    paired = {face for each in doorways for face in (each.one, each.other)}
    found = []
    for each in doorways:
        sides = each.one.room, each.other.room
        is_open = not any(rooms[side].is_shut for side in sides)
        name = " - ".join(sorted(names[side] for side in sides))
        found.append(PlanDoor(name, *each.jambs, is_open))
    for face in faces:
        if face not in paired:
            found.append(PlanDoor(names[face.room], face.start, face.end, False))
    for name, door in zip(_unique([door.name for door in found]), found, strict=True):
        yield corridor_to_the_left(replace(door, name=name), plan)


def _with_doors(bare: FloorPlan, doors: Sequence[PlanDoor]) -> FloorPlan:
    """The walls with doors; a door that leaves no way is closed, or left out if it cannot be."""
    plan = hang_doors(bare, tuple(doors))
    usable = [door if _is_sound(door, plan) else replace(door, open=False) for door in doors]
    plan = hang_doors(bare, tuple(usable))
    return hang_doors(bare, tuple([door for door in usable if _is_sound(door, plan)]))


def _is_sound(door: PlanDoor, plan: FloorPlan) -> bool:
    try:
        check_door(door)
        check_doorway(door, plan)
    except FloorPlanError:
        return False
    return True


def _unique(names: Sequence[str]) -> list[str]:
    """The names, the second of the same name with " (2)" behind it and so on."""
    counts: Counter[str] = Counter()
    told = []
    for name in names:
        counts[name] += 1
        told.append(f"{name} ({counts[name]})" if counts[name] > 1 else name)
    return told


def _tree(lines: Sequence[Sequence[Point]]) -> STRtree:
    ends = [pair for line in lines for pair in pairwise(line)]
    return STRtree([LineString(pair) for pair in ends])


def _largest(shape: shapely.geometry.base.BaseGeometry) -> Polygon:
    parts = [part for part in shapely.get_parts(shape) if isinstance(part, Polygon)]
    return max(parts, key=shapely.area, default=Polygon())
