"""Reads DXF drawings, as AutoCAD writes them, with ezdxf."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from semnav_env.world.maps.importers.drawing import (
    CURVE_TOLERANCE,
    MAX_DRAWING_EXTENT,
    Drawing,
    Stroke,
    plan_of_strokes,
)
from semnav_env.world.maps.importers.imported import ImportedPlan
from semnav_env.world.maps.rules import FloorPlanError
from semnav_features.reading import check_file
from semnav_features.validation import clipped

CURVE_TYPES = ("LINE", "LWPOLYLINE", "POLYLINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE")
"""Types of DXF entities that are read as lines and curves."""


FARTHEST = 1000.0 * MAX_DRAWING_EXTENT
"""Distance from the origin beyond which nothing is read, metres; coordinates of maps are nearer."""

MAX_BLOCK_DEPTH = 8
"""Depth of blocks within blocks beyond which a drawing is refused."""

MAX_ENTITIES, MAX_BLOCKS = 60_000, 20_000
"""Numbers of entities and of inserted blocks beyond which a drawing is refused."""


def load_dxf(path: str | Path, drawing: Drawing | None = None) -> ImportedPlan:
    """The floor plan of a DXF drawing: lines, polylines and curves of its model space.

    Blocks are resolved; what a block draws on layer 0 belongs to the layer it is inserted on.
    Layers that are off or frozen are left out unless they are named. Units are those of the
    header's $INSUNITS.

    Args:
        path: the file.
        drawing: scale and layers.

    Raises:
        FloorPlanError: names the file, what is wrong and what would be right.
    """
    where, drawing = Path(path), drawing or Drawing()
    document, mended = _read(where)
    scale = drawing.scale or _metres(document, where)
    strokes, left = _strokes(document, drawing, scale, where)
    notes = (f"{scale:g} m a unit of the drawing", *([f"{mended} errors mended"] if mended else ()))
    plan, report = plan_of_strokes(strokes, drawing, where, "DXF drawing", notes)
    lost = tuple(f"{count} {what}" for what, count in sorted(left.items()))
    return ImportedPlan(plan, report.with_left_out(lost))


def _strokes(
    document: Any, drawing: Drawing, scale: float, path: Path
) -> tuple[list[Stroke], Counter[str]]:
    """The curves of the model space, and how many entities of each kind were left out."""
    named = (*drawing.walls, *drawing.doors)
    off = {each.dxf.name for each in document.layers if each.is_off() or each.is_frozen()}
    strokes: list[Stroke] = []
    left: Counter[str] = Counter()
    for layer, entity in _within_budget(_entities(document.modelspace(), None, path), path):
        if layer in off.difference(named):
            left[f"lines on layer {layer}, which is off"] += 1
        elif entity.dxftype() in CURVE_TYPES and (stroke := _stroke(entity, layer, scale)):
            strokes.append(stroke)
        elif entity.dxftype() != "INSERT":
            left[entity.dxftype()] += 1
    return strokes, left


def _read(path: Path) -> tuple[Any, int]:
    """The document, and the number of errors in the file that were repaired."""
    try:
        from ezdxf import recover
        from ezdxf.lldxf.const import DXFError
    except ImportError:
        raise FloorPlanError("DXF needs ezdxf: pip install 'semnav-env[import]'") from None
    try:
        check_file(path, error=FloorPlanError)
        if path.stat().st_size == 0:
            raise FloorPlanError(f"{path}: is empty; give a DXF drawing")
        document, audit = recover.readfile(path)
    except OSError as error:
        raise FloorPlanError(f"{path}: cannot be read: {error.strerror or error}") from None
    except (DXFError, ValueError, KeyError, IndexError, TypeError, AttributeError) as error:
        if isinstance(error, FloorPlanError):
            raise
        said = (str(error) or type(error).__name__).splitlines()[0]
        raise FloorPlanError(f"{path}: no DXF drawing: {clipped(said)}") from None
    return document, len(audit.errors) + len(audit.fixes)


def _metres(document: Any, path: Path) -> float:
    """Metres per unit by the header of the drawing."""
    from ezdxf.enums import InsertUnits
    from ezdxf.units import conversion_factor

    unit = document.units
    if unit not in [known.value for known in InsertUnits] or unit == InsertUnits.Unitless:
        raise FloorPlanError(
            f"{path}: the header does not say in which units it is drawn ($INSUNITS); give the "
            "scale, metres a unit: 0.001 for millimetres, 0.0254 for inches"
        )
    return float(conversion_factor(InsertUnits(unit), InsertUnits.Meters))


def _within_budget(entities: Iterator[tuple[str, Any]], path: Path) -> Iterator[tuple[str, Any]]:
    """The entities, as long as there are not too many; inserted blocks count, if empty, too."""
    blocks = 0
    for count, (layer, entity) in enumerate(entities):
        blocks += entity.dxftype() == "INSERT"
        if count >= MAX_ENTITIES or blocks > MAX_BLOCKS:
            raise _too_many(path)
        yield layer, entity


def _too_many(path: Path) -> FloorPlanError:
    return FloorPlanError(
        f"{path}: more than {MAX_ENTITIES:,} entities or {MAX_BLOCKS:,} blocks; export the walls "
        "alone"
    )


def _entities(
    layout: Iterable[Any], within: str | None, path: Path, depth: int = 0
) -> Iterator[tuple[str, Any]]:
    """Every entity with its layer, inserted blocks before what is in them."""
    if depth > MAX_BLOCK_DEPTH:
        raise FloorPlanError(
            f"{path}: blocks within blocks more than {MAX_BLOCK_DEPTH} deep; explode them"
        )
    for entity in layout:
        own = entity.dxf.get("layer", "0")
        layer = within if own == "0" and within is not None else own
        yield layer, entity
        if entity.dxftype() != "INSERT":
            continue
        if entity.mcount > MAX_ENTITIES:
            raise _too_many(path)
        for insert in entity.multi_insert() if entity.mcount > 1 else (entity,):
            yield from _entities(insert.virtual_entities(), layer, path, depth + 1)


def _stroke(entity: Any, layer: str, scale: float) -> Stroke | None:
    """The entity as points; None if it is no curve, such as a mesh, or far too large."""
    from ezdxf.path import make_path

    try:
        path = make_path(entity)
        far = max((abs(x) for vertex in path.control_vertices() for x in vertex), default=0.0)
        if not far * scale <= FARTHEST:
            return None
        corners = [(v.x, v.y) for v in path.flattening(CURVE_TOLERANCE / scale)]
    except TypeError:
        return None
    if len(corners) < 2:
        return None
    hinge = None
    if entity.dxftype() == "ARC":
        centre = entity.ocs().to_wcs(entity.dxf.center)
        hinge = (centre.x * scale, centre.y * scale)
    return Stroke(layer, scale * np.array(corners), hinge)
