"""Walls from the pixels of an occupancy map."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, TypeAlias

import numpy as np

from semnav_env.world.maps.floor_plan import FloorPlan, Surface
from semnav_env.world.maps.importers.imported import ImportedPlan, ImportReport, boundary_of
from semnav_env.world.maps.importers.occupancy import OccupancyMap, OccupancySpec
from semnav_env.world.maps.importers.outlines import outlines
from semnav_env.world.maps.importers.raster import mended
from semnav_env.world.maps.importers.straighten import Straightened, straighten
from semnav_env.world.maps.rules import LEAST_SEGMENT_LENGTH, FloorPlanError
from semnav_features.checked_fields import Bounds, check_fields
from semnav_features.frames import FloatArray

Pixels: TypeAlias = Annotated[float, Bounds(0.0, 5.0, "pixels")]


@dataclass(frozen=True)
class Tracing:
    """Options for tracing walls from pixels.

    Attributes:
        mend: largest width of gaps in walls that are closed, pixels; maps that a robot made have
            perforated walls, which beams would pass.
        simplify: pixels by which an outline may be simplified, see `outlines`.
        straighten: pixels by which walls along the building's two directions may be moved onto
            straight lines, see `straighten`; 0 leaves them as traced. With 0 here, in `mend`
            and in `simplify`, the walls are exactly the pixels' edges.

    Raises:
        ValueError: a value of another kind or out of its range; names it.
    """

    mend: Annotated[int, Bounds(0, 10, "pixels")] = 2
    simplify: Pixels = 0.5
    straighten: Pixels = 1.5

    def __post_init__(self) -> None:
        check_fields(self)


def trace(pixels: OccupancyMap, tracing: Tracing | None = None) -> ImportedPlan:
    """The floor plan of an occupancy map: the outlines of what is solid, along the pixels' edges.

    Args:
        pixels: the map.
        tracing: options for tracing walls; `Tracing()` if None.

    Returns:
        The plan (walls only) and the report.

    Raises:
        FloorPlanError: names the file, what is wrong and what would be right.
    """
    tracing = tracing or Tracing()
    spec, solid = pixels.spec, pixels.solid
    if not solid.any():
        raise FloorPlanError(
            f"{spec.image}: no pixel is darker than occupied_thresh {spec.occupied_thresh}; "
            "lower it, or set negate if walls are white"
        )
    rings = outlines(mended(solid, tracing.mend), tracing.simplify)
    straight = straighten(rings, tracing.straighten) if tracing.straighten else None
    traced = [pixels.to_world(ring) for ring in (straight.rings if straight else rings)]
    surfaces = tuple([s for points in traced if (s := _surface(points)) is not None])
    where = Path(pixels.files[0])
    boundary = boundary_of(surfaces)
    source = f"occupancy map {where.name}"
    plan = FloorPlan(where.stem, surfaces, (), (), (), (), boundary, source)
    rows, columns = solid.shape
    notes = (
        f"{spec.resolution:g} m a pixel, {columns} x {rows} pixels",
        f"{solid.mean():.1%} solid, {pixels.free.mean():.1%} free, the rest unknown (not a wall)",
        *([_report(straight, rings, spec)] if straight else ()),
    )
    taken = {"outlines": len(surfaces), "segments": len(plan.segments)}
    return ImportedPlan(plan, ImportReport(pixels.files, "occupancy map", taken, notes=notes))


def _report(straight: Straightened, rings: Sequence[FloatArray], spec: OccupancySpec) -> str:
    """One line about what was straightened."""
    turn = math.degrees(spec.origin[2] - straight.direction)  # rows of an image go downwards
    first = (turn + 45.0) % 90.0 - 45.0
    return (
        f"{straight.segments} of {sum(len(ring) - 1 for ring in rings)} segments straightened "
        f"into {straight.lines} walls along {first:.2f} and {first + 90.0:.2f} degrees, moved by "
        f"{straight.moved:.2f} pixels ({straight.moved * spec.resolution:.3g} m) at most"
    )


def _surface(points: FloatArray) -> Surface | None:
    """A surface through points without repeated ones; None if only one is left."""
    far = np.linalg.norm(np.diff(points, axis=0), axis=1) >= LEAST_SEGMENT_LENGTH
    kept = points[np.append(True, far)]
    return Surface(tuple([(x, y) for x, y in kept.tolist()])) if len(kept) > 1 else None
