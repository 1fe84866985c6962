"""Occupancy maps of ROS's map_server: a YAML file and an image."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from semnav_env.world.maps.importers.documents import finite, read_yaml
from semnav_env.world.maps.importers.raster import free_pixels, read_grey, solid_pixels
from semnav_env.world.maps.rules import FloorPlanError
from semnav_features.checked_fields import Bounds, Share, check_fields, require_order
from semnav_features.frames import FloatArray, Point, Pose, points_to_parent, to_local
from semnav_features.validation import shown

IMAGE_SUFFIXES = (".pgm", ".png", ".ppm", ".bmp", ".tif", ".tiff", ".gif")
"""Endings of the names of images that may be maps."""


@dataclass(frozen=True)
class OccupancySpec:
    """Contents of a YAML file of map_server.

    Attributes:
        image: the image's path.
        resolution: metres per pixel.
        origin: pose of the lower left corner of the image in the world.
        occupied_thresh: pixels with a greater occupancy are solid.
        free_thresh: pixels with a smaller one are free; in between nothing is known.
        negate: light pixels are solid.

    Raises:
        ValueError: a value of another kind or out of its range; names it.
    """

    image: Path
    resolution: Annotated[float, Bounds(0.001, 10.0, "metres a pixel")]
    origin: Pose = (0.0, 0.0, 0.0)
    occupied_thresh: Share = 0.65
    free_thresh: Share = 0.196
    negate: bool = False

    def __post_init__(self) -> None:
        check_fields(self)
        require_order(self, ("free_thresh", "occupied_thresh"))

    def to_world(self, pixels: FloatArray, rows: int) -> FloatArray:
        """Metres of points (column, row) in an image of so many rows; row 0 is at the top."""
        columns, lines = np.asarray(pixels, dtype=np.float64).T
        local = self.resolution * np.stack((columns, rows - lines), axis=1)
        return np.asarray(points_to_parent(self.origin, local))


@dataclass(frozen=True, eq=False)
class OccupancyMap:
    """A map of pixels.

    Attributes:
        files: it was read from.
        spec: meaning of its pixels.
        grey: their brightness, shape (rows, columns).
    """

    files: tuple[str, ...]
    spec: OccupancySpec
    grey: FloatArray

    @cached_property
    def solid(self) -> NDArray[np.bool_]:
        """Mask of the occupied pixels."""
        return solid_pixels(self.grey, self.spec.occupied_thresh, self.spec.negate)

    @cached_property
    def free(self) -> NDArray[np.bool_]:
        """Which pixels are known to be free."""
        return free_pixels(self.grey, self.spec.free_thresh, self.spec.negate)

    def to_world(self, pixels: FloatArray) -> FloatArray:
        """Metres of points (column, row), shape (n, 2); (0, 0) is the upper left corner."""
        return self.spec.to_world(pixels, len(self.grey))

    def is_free(self, point: Point) -> bool:
        """Whether a point in metres lies in a pixel that is known to be free."""
        x, y = to_local(self.spec.origin, point)
        rows, columns = self.grey.shape
        column, row = x // self.spec.resolution, rows - 1 - y // self.spec.resolution
        inside = 0 <= column < columns and 0 <= row < rows
        return inside and bool(self.free[int(row), int(column)])


def read_occupancy(path: str | Path, resolution: float | None = None) -> OccupancyMap:
    """The pixels of an occupancy map.

    Args:
        path: the YAML file of a map, or an image alone: black solid, the lower left corner at the
            origin.
        resolution: metres per pixel of an image alone.

    Raises:
        FloorPlanError: names the file, what is wrong and what would be right.
    """
    spec = _spec(Path(path), resolution)
    files = tuple(dict.fromkeys((str(path), str(spec.image))))
    return OccupancyMap(files, spec, read_grey(spec.image))


def read_spec(path: Path) -> OccupancySpec:
    """Read the YAML file of a map.

    Raises:
        FloorPlanError: not such a file; names what is wrong with which entry.
    """
    fields = read_yaml(path)
    if not isinstance(fields, dict):
        raise FloorPlanError(f"{path}: no map description; it has image, resolution, origin")
    if fields.get("mode", "trinary") == "raw":
        raise FloorPlanError(f"{path}: mode raw is not read; save the map as trinary or scale")
    try:
        image = path.parent / str(fields["image"])
        if not _is_file(image):
            shown_name = shown(str(fields["image"]))
            raise FloorPlanError(f"its image {shown_name} cannot be read: there is no such file")
        origin = [finite(value) for value in fields["origin"]]
        x, y, heading = origin if len(origin) == 3 else (*origin, 0.0)
        return OccupancySpec(
            image,
            finite(fields["resolution"]),
            (x, y, heading),
            finite(fields.get("occupied_thresh", 0.65)),
            finite(fields.get("free_thresh", 0.196)),
            bool(finite(fields.get("negate", 0))),
        )
    except KeyError as error:
        raise FloorPlanError(
            f"{path}: lacks {error}; a map has image, resolution, origin"
        ) from None
    except FloorPlanError as error:
        raise FloorPlanError(f"{path}: {error}") from None
    except (TypeError, ValueError) as error:
        raise FloorPlanError(
            f"{path}: {error}; resolution is a number, origin is [x, y, heading]"
        ) from None


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # a name that is too long, or holds a null
        return False


def _spec(path: Path, resolution: float | None) -> OccupancySpec:
    if path.suffix.lower() in IMAGE_SUFFIXES:
        if resolution is None:
            raise FloorPlanError(
                f"{path}: an image alone has no scale; give the resolution in metres a pixel, "
                "such as 0.05, or the map's YAML file"
            )
        return OccupancySpec(path, resolution)
    spec = read_spec(path)
    if resolution is not None and resolution != spec.resolution:
        raise FloorPlanError(
            f"{path}: says resolution {spec.resolution}, not {resolution}; leave resolution out"
        )
    return spec
