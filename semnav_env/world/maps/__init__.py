"""Floor plans: the geometry of a storey and the names of its doors and regions."""

from typing import TYPE_CHECKING

from semnav_env.world.maps.floor_plan import FloorPlan, Material, PlanDoor, Region, Surface
from semnav_env.world.maps.library import bundled_names, load_floor_plan
from semnav_env.world.maps.rules import FloorPlanError
from semnav_features.lazy_names import lazy_names

if TYPE_CHECKING:
    from semnav_env.world.maps.generator import DISTRIBUTIONS, OfficeSettings, generate_office
    from semnav_env.world.maps.writer import save_floor_plan

__all__ = [
    "DISTRIBUTIONS",
    "FloorPlan",
    "FloorPlanError",
    "Material",
    "OfficeSettings",
    "PlanDoor",
    "Region",
    "Surface",
    "bundled_names",
    "generate_office",
    "load_floor_plan",
    "save_floor_plan",
]

__getattr__ = lazy_names(
    __name__,
    {
        ".generator": ("DISTRIBUTIONS", "OfficeSettings", "generate_office"),
        ".writer": ("save_floor_plan",),
    },
)
