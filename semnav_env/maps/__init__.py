"""Floor plans: the geometry of a storey and the names of its doors and regions."""

from semnav_env.maps.floor_plan import FloorPlan, Material, PlanDoor, Region, Surface
from semnav_env.maps.generator import DISTRIBUTIONS, OfficeSettings, generate_office
from semnav_env.maps.library import bundled_names, load_floor_plan
from semnav_env.maps.rules import FloorPlanError
from semnav_env.maps.writer import save_floor_plan

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
