"""Drawings in SVG, read with svgelements."""

from __future__ import annotations

import io
import math
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import ParseError, fromstring

import numpy as np

from semnav_env.world.maps.importers.documents import read_text
from semnav_env.world.maps.importers.drawing import (
    CURVE_TOLERANCE,
    MAX_DRAWING_EXTENT,
    Drawing,
    Stroke,
    plan_of_strokes,
)
from semnav_env.world.maps.importers.imported import ImportedPlan
from semnav_env.world.maps.importers.svg_budget import MAX_ELEMENTS, check_budget
from semnav_env.world.maps.rules import FloorPlanError
from semnav_features.frames import FloatArray, Point
from semnav_features.validation import clipped

MAX_STEPS = 200
"""Largest number of lines that replace a piece of a curve."""

LABEL_ATTRIBUTE = "{http://www.inkscape.org/namespaces/inkscape}label"
"""Attribute in which Inkscape keeps the name of a layer."""


def load_svg(path: str | Path, drawing: Drawing | None = None) -> ImportedPlan:
    """The floor plan of an SVG drawing: the outlines of all its shapes.

    A layer is an outermost group, by its Inkscape label or its id. What is not displayed, text
    and images are left out. y points down in the file and up in the plan.

    Args:
        path: the file.
        drawing: layers, and the scale: metres a unit of the file's own coordinates (its viewBox).

    Raises:
        FloorPlanError: names the file, what is wrong and what would be right.
    """
    where, drawing = Path(path), drawing or Drawing()
    picture = _read(where)
    if drawing.scale is None:
        raise FloorPlanError(
            f"{where}: an SVG does not say how large the building is; give the scale, metres a "
            "unit of its coordinates, such as 0.01"
        )
    unit = drawing.scale / _pixels_per_unit(picture)
    strokes: list[Stroke] = []
    left: Counter[str] = Counter()
    for layer, shape in _shapes(picture, None):
        drawn = list(_strokes(shape, layer, unit))
        strokes += drawn
        if not drawn:
            left[type(shape).__name__.lower()] += 1
    notes = (f"{drawing.scale:g} m a unit of the drawing",)
    plan, report = plan_of_strokes(strokes, drawing, where, "SVG drawing", notes)
    lost = tuple(f"{count} {what}" for what, count in sorted(left.items()))
    return ImportedPlan(plan, report.with_left_out(lost))


def _read(path: Path) -> Any:
    try:
        from svgelements import SVG
    except ImportError:
        raise FloorPlanError("SVG needs svgelements: pip install 'semnav-env[import]'") from None
    text = read_text(path)
    if "<!ENTITY" in text:
        raise FloorPlanError(f"{path}: defines entities; save it as plain SVG")
    if text.count("<") > 4 * MAX_ELEMENTS:
        raise FloorPlanError(f"{path}: more than {MAX_ELEMENTS:,} elements; export the walls alone")
    try:
        check_budget(fromstring(text))
        picture = SVG.parse(io.StringIO(text))
    except FloorPlanError as error:
        raise FloorPlanError(f"{path}: {error}") from None
    except (ParseError, ValueError, TypeError, AttributeError, IndexError, RecursionError) as error:
        raise FloorPlanError(f"{path}: no SVG drawing: {clipped(str(error))}") from None
    if not isinstance(picture, SVG):
        raise FloorPlanError(f"{path}: no SVG drawing: its outermost element is not <svg>")
    return picture


def _pixels_per_unit(picture: Any) -> float:
    """Number of pixels that svgelements gives to a unit of the file's coordinates."""
    box = picture.viewbox
    sides = [(picture.width, box and box.width), (picture.height, box and box.height)]
    shares = [float(size) / float(inner) for size, inner in sides if size and inner]
    return min(shares, default=1.0) or 1.0


def _shapes(group: Any, layer: str | None) -> Iterator[tuple[str, Any]]:
    from svgelements import Group

    for child in group:
        if isinstance(child, Group):
            told = child.values.get("attributes", {})
            yield from _shapes(child, layer or told.get(LABEL_ATTRIBUTE) or child.id or None)
        else:
            yield layer or "", child


def _strokes(shape: Any, layer: str, unit: float) -> Iterator[Stroke]:
    """Each unbroken line of a shape; nothing if it is none."""
    from svgelements import Arc, Path, Shape

    if not isinstance(shape, Shape):
        return
    for part in Path(shape).as_subpaths():
        pieces = [piece for piece in part if piece.start is not None and piece.end is not None]
        points = [_flattened(piece, unit) for piece in pieces]
        if not points:
            continue
        arcs = [piece for piece in pieces if isinstance(piece, Arc)]
        if len(arcs) == 1 and len(pieces) < 4:
            yield Stroke(layer, _flattened(arcs[0], unit), _placed(arcs[0].center, unit))
        elif len(line := _without_repetition(np.concatenate(points))) > 1:
            yield Stroke(layer, line)


def _without_repetition(points: FloatArray) -> FloatArray:
    """The points without those that are the same as the one before; pieces share their ends."""
    kept: FloatArray = points[np.append(True, (points[1:] != points[:-1]).any(axis=1))]
    return kept


def _flattened(piece: Any, unit: float) -> FloatArray:
    """A piece of a path flattened to points, metres."""
    from svgelements import Close, Line, Move

    if isinstance(piece, Move):
        return np.array([_placed(piece.end, unit)])
    if isinstance(piece, Line | Close):
        return np.array([_placed(piece.start, unit), _placed(piece.end, unit)])
    west, south, east, north = piece.bbox()
    extent = unit * max(east - west, north - south)
    if not extent <= MAX_DRAWING_EXTENT:
        return np.array([_placed(piece.start, unit), _placed(piece.end, unit)])
    finest = piece.npoint(np.linspace(0.0, 1.0, MAX_STEPS + 1))
    length = unit * float(np.hypot(*np.diff(finest, axis=0).T).sum())
    steps = min(MAX_STEPS, max(2, math.ceil(length / math.sqrt(8.0 * CURVE_TOLERANCE))))
    points: FloatArray = piece.npoint(np.arange(steps + 1) / steps) * (unit, -unit)
    return points


def _placed(point: Any, unit: float) -> Point:
    return unit * float(point.x), -unit * float(point.y)
