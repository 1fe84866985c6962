"""Floor plans from maps of other programs: occupancy maps, vector maps, buildings, drawings."""

from semnav_env.world.maps.importers.building import load_building
from semnav_env.world.maps.importers.drawing import Drawing
from semnav_env.world.maps.importers.dxf import load_dxf
from semnav_env.world.maps.importers.imported import ImportedPlan, ImportReport
from semnav_env.world.maps.importers.occupancy import OccupancyMap, OccupancySpec, read_occupancy
from semnav_env.world.maps.importers.opening import import_map, register_importer
from semnav_env.world.maps.importers.segments import load_csv, load_vector_map
from semnav_env.world.maps.importers.svg import load_svg
from semnav_env.world.maps.importers.tracing import Tracing, trace

__all__ = [
    "Drawing",
    "ImportReport",
    "ImportedPlan",
    "OccupancyMap",
    "OccupancySpec",
    "Tracing",
    "import_map",
    "load_building",
    "load_csv",
    "load_dxf",
    "load_svg",
    "load_vector_map",
    "read_occupancy",
    "register_importer",
    "trace",
]
