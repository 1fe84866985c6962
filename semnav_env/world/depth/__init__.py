"""Simulated depth cameras: a floor plan raised to its ceiling, and the clouds seen in it."""

from semnav_env.world.depth.raised_plan import (
    NO_JAMB,
    Closet,
    FaceKind,
    PlanWindow,
    RaisedPlan,
)
from semnav_env.world.depth.raising import RaiseSettings, raise_plan
from semnav_env.world.depth.rig_hits import RigHits, rig_hits

__all__ = [
    "NO_JAMB",
    "Closet",
    "FaceKind",
    "PlanWindow",
    "RaiseSettings",
    "RaisedPlan",
    "RigHits",
    "raise_plan",
    "rig_hits",
]
