"""Chooses the importer of a file."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TypeAlias

from semnav_env.world.maps.importers.building import load_building
from semnav_env.world.maps.importers.documents import read_text
from semnav_env.world.maps.importers.drawing import Drawing
from semnav_env.world.maps.importers.dxf import load_dxf
from semnav_env.world.maps.importers.house_expo import is_house, plan_of_house
from semnav_env.world.maps.importers.imported import ImportedPlan
from semnav_env.world.maps.importers.kth import load_kth
from semnav_env.world.maps.importers.occupancy import IMAGE_SUFFIXES, read_occupancy
from semnav_env.world.maps.importers.osm import load_osm
from semnav_env.world.maps.importers.plan_file import load_plan_file
from semnav_env.world.maps.importers.segments import load_csv, load_vector_map
from semnav_env.world.maps.importers.svg import load_svg
from semnav_env.world.maps.importers.tracing import Tracing, trace
from semnav_env.world.maps.rules import FloorPlanError
from semnav_env.world.maps.units import certain_unit_fault, unit_fault
from semnav_features.validation import clipped

IMPORTED_FORMATS = (
    "a map_server map (.yaml, or its image with a resolution)",
    "a vector map or a house of HouseExpo (.json)",
    "a list of segments (.csv)",
    "a drawing (.dxf, .svg)",
    "a floor plan of a campus data set of KTH or MIT (.xml)",
    "a building of OpenStreetMap with indoor tags (.osm)",
    "a floor plan of this project in another unit (.geojson)",
)
"""Formats that can be imported, as an error lists them."""

KNOWN_SUFFIXES = frozenset(
    (
        ".yaml",
        ".yml",
        ".dxf",
        ".svg",
        ".xml",
        ".osm",
        ".json",
        ".csv",
        ".txt",
        ".geojson",
        *IMAGE_SUFFIXES,
    )
)
"""Suffixes of the files that the package itself reads; they cannot be registered."""

LARGE_EXTENT = 300.0
"""Extent of an imported plan beyond which its unit is doubted, metres: few buildings are longer."""

Importer: TypeAlias = Callable[[Path], ImportedPlan]
"""Reads a file into a floor plan and a report of what was imported."""

_registered: dict[str, Importer] = {}


def register_importer(suffix: str, importer: Importer) -> None:
    """Let `import_map` read files of another kind.

    Args:
        suffix: of their names, such as ".rooms".
        importer: reads one; it replaces the one that was registered for the suffix before.

    Raises:
        ValueError: no suffix, or one of a kind that the package reads itself.
    """
    lowered = suffix.lower()
    if not (lowered.startswith(".") and len(lowered) > 1) or lowered in KNOWN_SUFFIXES:
        known = ", ".join(sorted(KNOWN_SUFFIXES))
        raise ValueError(f"{suffix!r} is no suffix of a new kind; those of the package are {known}")
    _registered[lowered] = importer


def import_map(
    path: str | Path,
    resolution: float | None = None,
    tracing: Tracing | None = None,
    drawing: Drawing | None = None,
) -> ImportedPlan:
    """Import a floor plan from a foreign map, by the suffix of its file.

    Args:
        path: .yaml or .yml of ROS's map_server, with the labels beside it if there are any; its
            image alone; .json with the segments of a vector map or a house of HouseExpo; .csv or
            .txt with segments; .dxf or .svg; .xml of KTH or MIT; .osm; .geojson; or a kind of
            `register_importer`.
        resolution: metres per pixel of an image alone.
        tracing: options for tracing walls from the pixels of an occupancy map.
        drawing: scale and layers of a drawing, level of a building of OpenStreetMap; of other
            coordinates only the scale is used.

    Returns:
        The plan, and a report of what was imported.

    Raises:
        FloorPlanError: names the file, what is wrong and what would be right.
    """
    where = Path(path)
    suffix = where.suffix.lower()
    if suffix in _registered:
        return _registered[suffix](where)
    try:
        return _with_doubts(_imported(where, suffix, resolution, tracing, drawing), where)
    except (FloorPlanError, OSError, ImportError):
        raise
    except Exception as error:  # foreign bytes raise whatever a parser stumbles over
        said = (str(error) or type(error).__name__).splitlines()[0]
        raise FloorPlanError(f"{where}: cannot be read: {clipped(said)}") from error


def _with_doubts(found: ImportedPlan, path: Path) -> ImportedPlan:
    """The plan, with a note if its size suggests another unit; refused if this is certain."""
    plan, report = found
    widths = [door.width for door in plan.doors]
    if fault := certain_unit_fault(widths):
        raise FloorPlanError(f"{path}: {fault}")
    west, south, east, north = plan.boundary.bounds
    doubt = unit_fault(widths)
    if max(east - west, north - south) > LARGE_EXTENT:
        doubt = doubt or (
            f"it spans {east - west:,.0f} m x {north - south:,.0f} m; if that is too large, give "
            "--drawing.scale, metres a unit, such as 0.01 for centimetres; or for images the "
            "right resolution"
        )
    notes = (*report.notes, *filter(None, [doubt]))
    return ImportedPlan(plan, replace(report, notes=notes))


def _imported(
    where: Path,
    suffix: str,
    resolution: float | None,
    tracing: Tracing | None,
    drawing: Drawing | None,
) -> ImportedPlan:
    if suffix in IMAGE_SUFFIXES:
        return trace(read_occupancy(where, resolution), tracing)
    if resolution is not None:
        raise FloorPlanError(f"{where}: only an image alone needs a resolution; leave it out")
    if suffix in (".yaml", ".yml"):
        return load_building(where, tracing)
    scale = drawing.scale if drawing else None
    if suffix in (".dxf", ".svg"):
        return (load_dxf if suffix == ".dxf" else load_svg)(where, drawing)
    if suffix == ".json":
        return _load_json(where, scale)
    if suffix in (".csv", ".txt"):
        return load_csv(where, scale)
    if suffix == ".xml":
        return load_kth(where, scale)
    if suffix == ".osm":
        return load_osm(where, drawing.level if drawing else None)
    if suffix == ".geojson":
        return load_plan_file(where, scale)
    raise FloorPlanError(f"{where}: no map of a known kind; give {', '.join(IMPORTED_FORMATS)}")


def _load_json(path: Path, scale: float | None) -> ImportedPlan:
    """A house of HouseExpo or a vector map, by what the file holds."""
    text = read_text(path)
    try:
        content = json.loads(text)
    except (ValueError, RecursionError):
        content = None  # the reader of vector maps says what is wrong
    return (
        plan_of_house(content, path, scale) if is_house(content) else load_vector_map(path, scale)
    )
