"""Which importer reads which file."""

from __future__ import annotations

from pathlib import Path

from semnav_env.maps.importers.building import load_building
from semnav_env.maps.importers.imported import Imported
from semnav_env.maps.importers.occupancy import IMAGES, read_occupancy
from semnav_env.maps.importers.segments import load_csv, load_vector_map
from semnav_env.maps.importers.tracing import Tracing, trace
from semnav_env.maps.rules import FloorPlanError

KINDS = (
    "a map_server map (.yaml, or its image with a resolution)",
    "a vector map (.json)",
    "a list of segments (.csv)",
)


def import_map(
    path: str | Path, resolution: float | None = None, tracing: Tracing | None = None
) -> Imported:
    """A floor plan from somebody else's map, by the suffix of its file.

    Args:
        path: .yaml or .yml of ROS's map_server, with the labels beside it if there are any; its
            image alone; .json with the segments of a vector map; or .csv or .txt with segments.
        resolution: metres per pixel of an image alone.
        tracing: how walls are made of the pixels of an occupancy map.

    Returns:
        The plan, and what was understood.

    Raises:
        FloorPlanError: names the file, what is wrong and what would be right.
    """
    where = Path(path)
    suffix = where.suffix.lower()
    if suffix in IMAGES:
        return trace(read_occupancy(where, resolution), tracing)
    if resolution is not None:
        raise FloorPlanError(f"{where}: only an image alone needs a resolution; leave it out")
    if suffix in (".yaml", ".yml"):
        return load_building(where, tracing)
    if suffix == ".json":
        return load_vector_map(where)
    if suffix in (".csv", ".txt"):
        return load_csv(where)
    raise FloorPlanError(f"{where}: no map of a known kind; give {', '.join(KINDS)}")
