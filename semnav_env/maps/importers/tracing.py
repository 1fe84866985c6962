"""Walls from the pixels of an occupancy map."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from semnav_env.features.frames import FloatArray
from semnav_env.maps.floor_plan import FloorPlan, Surface
from semnav_env.maps.importers.imported import Imported, ImportReport, boundary_of
from semnav_env.maps.importers.occupancy import OccupancyMap
from semnav_env.maps.importers.outlines import outlines
from semnav_env.maps.importers.raster import mended
from semnav_env.maps.rules import SHORTEST, FloorPlanError


@dataclass(frozen=True)
class Tracing:
    """How walls are made of pixels.

    Attributes:
        mend: gaps of at most so many pixels in walls are closed; maps that a robot made have
            perforated walls, which beams would pass.
        simplify: pixels by which an outline may be simplified, see `outlines`; with 0 both here
            and in `mend`, the walls are exactly the pixels' edges.

    Raises:
        FloorPlanError: a value out of its range.
    """

    mend: int = 2
    simplify: float = 0.5

    def __post_init__(self) -> None:
        if not 0 <= self.mend <= 10:
            raise FloorPlanError(f"mend is {self.mend}; it must be 0 to 10 pixels")
        if not 0.0 <= self.simplify <= 5.0:
            raise FloorPlanError(f"simplify is {self.simplify}; it must be 0 to 5 pixels")


def trace(pixels: OccupancyMap, tracing: Tracing | None = None) -> Imported:
    """The floor plan of an occupancy map: the outlines of what is solid, along the pixels' edges.

    Args:
        pixels: the map.
        tracing: how; `Tracing()` if None.

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
    surfaces = tuple([s for ring in rings if (s := _surface(pixels.to_world(ring))) is not None])
    where = Path(pixels.files[0])
    boundary = boundary_of(surfaces)
    source = f"occupancy map {where.name}"
    plan = FloorPlan(where.stem, surfaces, (), (), (), (), boundary, source)
    rows, columns = solid.shape
    notes = (
        f"{spec.resolution:g} m a pixel, {columns} x {rows} pixels",
        f"{solid.mean():.1%} solid, {pixels.free.mean():.1%} free, the rest unknown (not a wall)",
    )
    taken = {"outlines": len(surfaces), "segments": len(plan.segments)}
    return Imported(plan, ImportReport(pixels.files, "occupancy map", taken, notes=notes))


def _surface(points: FloatArray) -> Surface | None:
    """A surface through these points without repeated ones; None if there is but one."""
    far = np.linalg.norm(np.diff(points, axis=0), axis=1) >= SHORTEST
    kept = points[np.append(True, far)]
    return Surface(tuple([(x, y) for x, y in kept.tolist()])) if len(kept) > 1 else None
