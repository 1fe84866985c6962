"""Floor plans of the KTH and MIT campus data sets (XML): rooms traced along their own walls."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from statistics import median
from xml.etree.ElementTree import Element

from semnav_env.world.maps.importers.documents import finite, read_xml
from semnav_env.world.maps.importers.door_faces import LEAST_DOOR_WIDTH
from semnav_env.world.maps.importers.drawing import MAX_DRAWING_EXTENT, MAX_SEGMENTS
from semnav_env.world.maps.importers.imported import ImportedPlan
from semnav_env.world.maps.importers.traced_rooms import Edge, TracedRoom, plan_of_rooms
from semnav_env.world.maps.rules import LEAST_SEGMENT_LENGTH, FloorPlanError
from semnav_features.frames import Point

USUAL_DOOR_WIDTH = 0.85
"""Median width of the doors of KTH's floors, metres."""

LIFT_TYPE = re.compile(r"hiss|elevator|lift\b", re.I)
"""Types of spaces that no robot enters: lifts, their shafts and machines."""

WHAT_IT_IS = (
    "a floor plan of the KTH and MIT campus data sets has <space> elements with a <contour> of "
    '<linesegment x1="" y1="" x2="" y2="" type="Wall|Window|Portal">, and a <Scale>'
)


@dataclass(frozen=True)
class DrawnSpace:
    """A space as the file has it, in units of the file.

    Attributes:
        name: its name, with that of the building.
        kind: what it is for, in the words of the draughtsmen; often empty.
        lines: start, end and type ("Wall", "Window" or "Portal") of the parts of its outline.
    """

    name: str
    kind: str
    lines: tuple[tuple[Point, Point, str], ...]


def load_kth(path: Path, scale: float | None = None) -> ImportedPlan:
    """The floor plan of an XML file of the KTH or MIT campus data set.

    Every room is traced along the inner faces of its walls, so walls have their thickness and each
    door appears twice, once on each face (`plan_of_rooms`). Windows are walls. The lower left
    corner becomes the origin. Source: Aydemir, Jensfelt and Folkesson, "What can we predict about
    unexplored parts of buildings?", 2012.

    Args:
        path: the file.
        scale: metres a unit of its coordinates; that of the file if None. If by the file's scale
            the doors are about half or twice as wide as doors are, it is corrected by this factor.

    Raises:
        FloorPlanError: not such a file; names what is wrong.
    """
    root = read_xml(path, WHAT_IT_IS)
    spaces = [space for each in root.iter("space") if (space := _space(each, path)).lines]
    if sum(len(space.lines) for space in spaces) > MAX_SEGMENTS:
        raise FloorPlanError(f"{path}: more than {MAX_SEGMENTS:,} segments; no floor has as many")
    if not spaces:
        raise FloorPlanError(f"{path}: holds no space with an outline; {WHAT_IT_IS}")
    unit, notes = (scale, ()) if scale else _unit(root, spaces, path)
    low, high = _bounds(spaces)
    if unit * max(high[0] - low[0], high[1] - low[1]) > MAX_DRAWING_EXTENT:
        raise FloorPlanError(
            f"{path}: spans {unit * (high[0] - low[0]):,.0f} m x {unit * (high[1] - low[1]):,.0f} "
            f"m; at most {MAX_DRAWING_EXTENT:,.0f} m are read: give --drawing.scale, metres a unit"
        )
    rooms = [_room(space, low, unit) for space in spaces]
    plan, report = plan_of_rooms(rooms, path, "floor plan of a campus")
    return ImportedPlan(
        plan, replace(report, notes=(f"{unit:.6g} m a unit", *notes, *report.notes))
    )


def _space(element: Element, path: Path) -> DrawnSpace:
    name = element.get("name", "")
    try:
        lines = tuple(_line(each) for each in element.iter("linesegment"))
    except (TypeError, ValueError) as error:
        raise FloorPlanError(f"{path}: space {name!r:.40}: {error}; {WHAT_IT_IS}") from None
    return DrawnSpace(name, (element.get("type") or "").strip(), lines)


def _line(element: Element) -> tuple[Point, Point, str]:
    x1, y1, x2, y2 = (finite(element.get(name)) for name in ("x1", "y1", "x2", "y2"))
    return (x1, y1), (x2, y2), (element.get("type") or "Wall")


def _unit(root: Element, spaces: Sequence[DrawnSpace], path: Path) -> tuple[float, tuple[str, ...]]:
    """Metres a unit by the file's scale, corrected by the widths of the doors, and notes."""
    fields = getattr(root.find("Scale"), "attrib", {})
    try:
        pixels = finite(fields.get("PixelDistance"))
        metres = finite(fields.get("RealDistance", fields.get("realDistance")))
    except (TypeError, ValueError):
        pixels = metres = 0.0
    if not (pixels > 0.0 and metres > 0.0):
        raise FloorPlanError(
            f"{path}: <Scale> says {dict(fields)}; give --drawing.scale, metres a unit"
        )
    unit = metres / pixels
    doors = [
        unit * math.dist(a, b) for space in spaces for a, b, kind in space.lines if _is_door(kind)
    ]
    if not doors:
        return unit, ()
    factor = 2.0 ** round(math.log2(USUAL_DOOR_WIDTH / max(median(doors), 1e-9)))
    if not 0.25 <= factor <= 4.0 or factor == 1.0:
        return unit, ()
    return unit * factor, (
        f"by its <Scale> doors are {median(doors):.2f} m wide, so {factor:g} times this scale is "
        "used; --drawing.scale sets another one",
    )


def _bounds(spaces: Sequence[DrawnSpace]) -> tuple[Point, Point]:
    points = [point for space in spaces for start, end, _ in space.lines for point in (start, end)]
    xs, ys = zip(*points, strict=True)
    return (min(xs), min(ys)), (max(xs), max(ys))


def _room(space: DrawnSpace, corner: Point, unit: float) -> TracedRoom:
    """A space in metres; what its outline leaves open is closed by a wall."""
    edges = [
        Edge(_metres(start, corner, unit), _metres(end, corner, unit), _is_door(kind))
        for start, end, kind in space.lines
    ]
    name = space.name.rpartition("_")[2].strip() or "space"
    is_lift = LIFT_TYPE.match(space.kind) is not None
    return TracedRoom(name, space.kind, tuple(_closed(edges)), is_lift)


def _metres(point: Point, corner: Point, unit: float) -> Point:
    return round(unit * (point[0] - corner[0]), 4), round(unit * (point[1] - corner[1]), 4)


def _closed(edges: Sequence[Edge]) -> Iterator[Edge]:
    """The edges of a closed ring: walls where one ends and the next begins elsewhere."""
    for edge, following in pairwise([*edges, edges[0]]):
        width = math.dist(edge.start, edge.end)
        if width >= LEAST_SEGMENT_LENGTH:
            yield replace(edge, is_door=edge.is_door and width >= LEAST_DOOR_WIDTH)
        if math.dist(edge.end, following.start) >= LEAST_SEGMENT_LENGTH:
            yield Edge(edge.end, following.start, False)


def _is_door(kind: str) -> bool:
    return kind.strip().lower() == "portal"
