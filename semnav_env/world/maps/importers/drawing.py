"""Plans from line drawings: strokes on layers, walls on some of them, doors on others."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import Annotated

import numpy as np
from shapely import STRtree

from semnav_env.world.maps.importers.building_doors import with_doors
from semnav_env.world.maps.importers.fitting import fit_door
from semnav_env.world.maps.importers.imported import ImportedPlan
from semnav_env.world.maps.importers.labels import DoorLabel
from semnav_env.world.maps.importers.segments import Row, plan_of_segments
from semnav_env.world.maps.rules import FloorPlanError
from semnav_env.world.maps.units import unit_fault
from semnav_features.checked_fields import Bounds, check_fields
from semnav_features.frames import FloatArray, Point

CURVE_TOLERANCE = 0.01
"""Largest distance between a curve and the lines that replace it, metres."""

MAX_DRAWING_EXTENT = 1000.0
"""Extent of a drawing beyond which its scale must be wrong, metres."""

MAX_SEGMENTS = 49_000
"""Largest number of segments that are read; a floor plan file holds 50,000 positions."""

LEAF_WIDTHS = (0.5, 2.2)
"""Width of the narrowest and of the widest leaf of a door, metres."""


@dataclass(frozen=True)
class Drawing:
    """Options for reading a line drawing (DXF, SVG); the level is for a building (OSM).

    Attributes:
        scale: metres a unit, if the file does not say (0.01 for centimetres).
        walls: layers with walls; all but those of doors if none are named.
        doors: layers with doors: arcs that leaves swing along, or on layers without an arc lines
            from jamb to jamb.
        level: of an OpenStreetMap building, such as "0"; not needed if it has one only.

    Raises:
        ValueError: a scale out of range, or layers that are no texts; names it.
    """

    scale: Annotated[float | None, Bounds(1e-6, 1e3, "metres a unit")] = None
    walls: tuple[str, ...] = ()
    doors: tuple[str, ...] = ()
    level: str | None = None

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True, eq=False)
class Stroke:
    """A line of a drawing.

    Attributes:
        layer: name of its layer.
        points: along it, shape (n, 2), metres.
        hinge: the centre, if it is an arc.
    """

    layer: str
    points: FloatArray
    hinge: Point | None = None


def plan_of_strokes(
    strokes: Sequence[Stroke], drawing: Drawing, path: Path, kind: str, notes: tuple[str, ...] = ()
) -> ImportedPlan:
    """The walls and doors of a drawing; its lower left corner becomes the origin.

    Raises:
        FloorPlanError: no such layer, no wall on it, or a drawing that is too large.
    """
    if not all(np.isfinite(stroke.points).all() for stroke in strokes):
        raise FloorPlanError(f"{path}: has coordinates that are not finite")
    layers = Counter(stroke.layer for stroke in strokes)
    there = ", ".join(f"{name or '(none)'} ({count})" for name, count in sorted(layers.items()))
    for name in (*drawing.walls, *drawing.doors):
        if name not in layers:
            raise FloorPlanError(
                f"{path}: no layer {name!r} with lines; there are: {there or 'none'}"
            )
    chosen = drawing.walls or tuple(name for name in layers if name not in drawing.doors)
    walls = [stroke for stroke in strokes if stroke.layer in chosen]
    if not walls:
        raise FloorPlanError(f"{path}: no line that could be a wall; layers: {there or 'none'}")
    corner = _corner(walls, path)
    rows = [row for stroke in walls for row in _rows(stroke.points - corner)]
    if len(rows) > MAX_SEGMENTS:
        raise FloorPlanError(
            f"{path}: {len(rows):,} segments; at most {MAX_SEGMENTS:,} are read: "
            f"name the layers with walls; there are: {there}"
        )
    plan, report = plan_of_segments(rows, path, kind)
    drawn = [stroke for stroke in strokes if stroke.layer in drawing.doors]
    labels, passed = door_labels(drawn, corner, plan.solids)
    if not labels and (fault := unit_fault(_widths(drawn))):
        raise FloorPlanError(f"{path}: {fault}")
    plan, lost = with_doors(plan, labels, None)
    unused = [name for name in layers if name not in (*chosen, *drawing.doors)]
    left = tuple(f"layer {name}: {layers[name]} lines" for name in sorted(unused))
    taken = report.taken | ({"doors": len(plan.doors)} if drawing.doors else {})
    told = (f"lower left corner, now the origin, at {corner[0]:g}, {corner[1]:g} m", *notes)
    left_out = report.left_out + left + passed + lost
    return ImportedPlan(plan, replace(report, taken=taken, left_out=left_out, notes=told))


def _widths(doors: Sequence[Stroke]) -> list[float]:
    """Widths of doors by the radius of an arc, or the length of a line."""
    ends = [(each.points[-1] if each.hinge is None else each.hinge) for each in doors]
    return [math.dist(each.points[0], end) for each, end in zip(doors, ends, strict=True)]


def door_labels(
    strokes: Sequence[Stroke], corner: FloatArray, walls: STRtree
) -> tuple[tuple[DoorLabel, ...], tuple[str, ...]]:
    """Doors from the arcs that leaves swing along; from lines from jamb to jamb on other layers.

    Returns:
        The doors, and for each layer how many of its lines give none.
    """
    with_arcs = {stroke.layer for stroke in strokes if stroke.hinge is not None}
    drawn = [each for each in strokes if each.hinge is not None or each.layer not in with_arcs]
    found = [_door_label(stroke, f"door {k}", corner, walls) for k, stroke in enumerate(drawn, 1)]
    layers = Counter(stroke.layer for stroke in strokes)
    used = Counter(each.layer for each, label in zip(drawn, found, strict=True) if label)
    passed = sorted((layers - used).items())
    lines = tuple(f"layer {name}: {n} of {layers[name]} lines give no door" for name, n in passed)
    return tuple(label for label in found if label), lines


def _door_label(stroke: Stroke, name: str, corner: FloatArray, walls: STRtree) -> DoorLabel | None:
    """The door that an arc or a line shows; None if it has not the width of one.

    A leaf may be drawn open or closed, so of the two ends of its arc that is taken for the other
    jamb from which the walls show a gap to the hinge.
    """
    first, last = (_point(stroke.points[k] - corner) for k in (0, -1))
    ways = [(first, last)]
    if stroke.hinge is not None:
        hinge = _point(np.array(stroke.hinge) - corner)
        ways = [(hinge, first), (hinge, last)]
    right = [way for way in ways if LEAF_WIDTHS[0] <= math.dist(*way) <= LEAF_WIDTHS[1]]
    doors = [DoorLabel(name, *way) for way in right]
    return min(doors, key=lambda door: not _is_open(door, walls), default=None)


def _is_open(door: DoorLabel, walls: STRtree) -> bool:
    fit = fit_door(door, walls)
    return fit is not None and fit.open


def _corner(strokes: Sequence[Stroke], path: Path) -> FloatArray:
    points = np.concatenate([stroke.points for stroke in strokes])
    low, high = points.min(axis=0), points.max(axis=0)
    if (high - low).max() > MAX_DRAWING_EXTENT:
        width, height = high - low
        raise FloorPlanError(
            f"{path}: {width:,.0f} x {height:,.0f} m; at most {MAX_DRAWING_EXTENT:,.0f} m are "
            "read: give the scale, metres a unit, such as 0.001 for millimetres"
        )
    return np.asarray(low)


def _rows(points: FloatArray) -> list[Row]:
    return [(a, b, c, d) for (a, b), (c, d) in pairwise(points.tolist())]


def _point(values: FloatArray) -> Point:
    return float(values[0]), float(values[1])
