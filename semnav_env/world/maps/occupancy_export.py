"""Floor plans as maps of ROS's map_server, with the labels that the importer reads."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import shapely
import yaml
from numpy.typing import NDArray
from PIL import Image

from semnav_env.world.grid.occupancy import clear_near
from semnav_env.world.maps.floor_plan import FloorPlan, Material
from semnav_env.world.maps.importers.labels import ALL_DOORS, DOORS_FILE, PLACE_KINDS, PLACES_FILE
from semnav_env.world.maps.importers.raster import MAX_PIXELS
from semnav_env.world.maps.rules import FloorPlanError
from semnav_features.frames import Point
from semnav_features.writing import replacing, write_file

SOLID_GREY = 0
"""Brightness of solid pixels, as map_saver writes them."""

FREE_GREY = 254
"""Brightness of free pixels, as map_saver writes them."""

UNKNOWN_GREY = 205
"""Brightness of unknown pixels, as map_saver writes them."""

IMAGE_SUFFIXES = (".pgm", ".png")
"""Formats that the image can be written in."""


BORDER_PIXELS = 2
"""Pixels between the boundary and the edge of the image."""


@dataclass(frozen=True, eq=False)
class PixelPlan:
    """A floor plan in pixels.

    Attributes:
        grey: brightness, shape (rows, columns), row 0 at the top.
        origin: lower left corner of the image, (x, y) in metres.
        resolution: metres a pixel.
    """

    grey: NDArray[np.uint8]
    origin: Point
    resolution: float

    def to_pixels(self, point: Point) -> tuple[float, float]:
        """Column and row of a place in metres; (0, 0) is the upper left corner of the image."""
        x, y = (point[0] - self.origin[0], point[1] - self.origin[1])
        return x / self.resolution, len(self.grey) - y / self.resolution


@dataclass(frozen=True)
class ExportReport:
    """Report of an export: the files, how much was written, and what the format cannot hold.

    Attributes:
        files: their paths.
        written: how many of each kind of thing were written.
        left_out: what the format cannot hold, one line each.
    """

    files: tuple[str, ...]
    written: dict[str, int]
    left_out: tuple[str, ...]

    def __str__(self) -> str:
        """The report as lines of text."""
        written = ", ".join(f"{count} {name}" for name, count in self.written.items())
        lines = [f"written: {written}", *(f"left out: {line}" for line in self.left_out)]
        return "\n".join([*lines, *(f"wrote {file}" for file in self.files)])


def export_map(
    plan: FloorPlan, path: str | Path, resolution: float = 0.05, image: str = ".pgm"
) -> ExportReport:
    """Write a plan as a map of map_server: YAML, image, `doors.yaml` and `locations.yaml`.

    `import_map` of the YAML file reads them all again.

    Args:
        plan: the plan.
        path: of the YAML file; the others lie beside it, so give each plan a folder of its own.
        resolution: metres a pixel.
        image: .pgm or .png.

    Raises:
        FloorPlanError: a bad name or resolution, or other labels lie in that folder.
    """
    where = Path(path)
    _check(where, image)
    pixels = draw_pixels(plan, resolution)
    picture, doors, places = (
        where.with_suffix(image),
        where.with_name(DOORS_FILE),
        where.with_name(PLACES_FILE),
    )
    with replacing(picture) as part:
        Image.fromarray(pixels.grey).save(part)
    _write(doors, _door_rows(plan))
    _write(places, _place_rows(plan, pixels))
    _write(where, _description(picture.name, pixels))
    rows, columns = pixels.grey.shape
    written = {
        "columns": columns,
        "rows": rows,
        "doors": len(plan.doors),
        "places": len(plan.regions),
    }
    files = tuple(str(file) for file in (where, picture, doors, places))
    return ExportReport(files, written, _left_out(plan))


def draw_pixels(plan: FloorPlan, resolution: float) -> PixelPlan:
    """The plan in pixels: solid within half a pixel of what is solid, else free in the boundary.

    What lies at a multiple of the resolution runs through the middles of pixels.

    Raises:
        FloorPlanError: the resolution is out of range, or makes too large an image.
    """
    if not (math.isfinite(resolution) and 0.001 <= resolution <= 10.0):
        raise FloorPlanError(f"resolution is {resolution}; it must be 0.001 to 10 metres a pixel")
    west, south, east, north = plan.boundary.bounds
    first = [math.floor(low / resolution) - BORDER_PIXELS for low in (west, south)]
    last = [math.ceil(high / resolution) + BORDER_PIXELS for high in (east, north)]
    columns, rows = (b - a + 1 for a, b in zip(first, last, strict=True))
    if columns * rows > MAX_PIXELS:
        coarse = resolution * math.sqrt(columns * rows / MAX_PIXELS)
        raise FloorPlanError(
            f"resolution {resolution} makes {columns} x {rows} pixels; at most {MAX_PIXELS:,} are "
            f"read again: give at least {coarse:.3f}"
        )
    left, bottom = (resolution * low for low in first)
    clear = np.ones((rows, columns), dtype=bool)
    reach = 0.5 * resolution + 1e-9
    clear_near(clear, plan.segments, left, bottom, resolution, reach)
    x, y = left + resolution * np.arange(columns), bottom + resolution * np.arange(rows)
    grey = np.full(clear.shape, UNKNOWN_GREY, np.uint8)
    grey[shapely.contains_xy(plan.boundary, x, y[:, None])] = FREE_GREY
    grey[~clear] = SOLID_GREY
    origin = left - 0.5 * resolution, bottom - 0.5 * resolution
    return PixelPlan(np.flipud(grey).copy(), origin, resolution)


def _check(where: Path, image: str) -> None:
    if where.suffix.lower() not in (".yaml", ".yml"):
        raise FloorPlanError(f"{where}: a map's name ends in .yaml")
    if image not in IMAGE_SUFFIXES:
        raise FloorPlanError(f"image is {image!r}; it is one of {', '.join(IMAGE_SUFFIXES)}")
    if where.name in (DOORS_FILE, PLACES_FILE):
        raise FloorPlanError(f"{where}: that name is of the labels; give another one")
    labels = [where.with_name(name) for name in (DOORS_FILE, PLACES_FILE)]
    if not where.exists() and (there := [str(file) for file in labels if file.exists()]):
        raise FloorPlanError(
            f"{there[0]}: labels of another map are there; export into a folder of its own"
        )


def _write(path: Path, content: Any) -> None:
    write_file(path, yaml.safe_dump(content, sort_keys=False, allow_unicode=True))


def _description(image: str, pixels: PixelPlan) -> dict[str, Any]:
    return {
        "image": image,
        "resolution": pixels.resolution,
        "origin": [*map(float, pixels.origin), 0.0],
        "negate": 0,
        "occupied_thresh": 0.65,
        "free_thresh": 0.196,
    }


def _door_rows(plan: FloorPlan) -> list[dict[str, Any]]:
    return [
        {
            "name": door.name,
            "door_corner_pt_1": [float(value) for value in door.start],
            "door_corner_pt_2": [float(value) for value in door.end],
        }
        for door in plan.doors
    ]


def _place_rows(plan: FloorPlan, pixels: PixelPlan) -> dict[str, Any]:
    kinds = zip(
        PLACE_KINDS, (plan.rooms, plan.corridors, plan.intersections, plan.areas), strict=True
    )
    places = [(kind, place) for kind, regions in kinds for place in regions]
    rings = [
        [
            round(value, 3)
            for x, y in place.polygon.exterior.coords
            for value in pixels.to_pixels((x, y))
        ]
        for _, place in places
    ]
    return {
        ALL_DOORS: True,
        "locations": [place.name for _, place in places],
        "kinds": [kind for kind, _ in places],
        "polygons": rings,
    }


def _left_out(plan: FloorPlan) -> tuple[str, ...]:
    """Kinds of solid things that the map cannot tell from walls, one line each."""
    counts = Counter(surface.material for surface in plan.surfaces)
    named = {
        Material.GLASS: "panes of glass",
        Material.LEAF: "leaves of doors",
        Material.FURNITURE: "pieces of furniture",
        Material.PERSON: "people on the floor",
    }
    return tuple(
        f"{counts[material]} {name}; they are walls in the map"
        for material, name in named.items()
        if counts[material]
    )
