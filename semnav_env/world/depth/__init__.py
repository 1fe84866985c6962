"""Simulated depth cameras: a floor plan raised to its ceiling, and the clouds seen in it."""

from semnav_env.world.depth.depth_camera import DepthCamera
from semnav_env.world.depth.depth_rig import DepthRig, RigHits
from semnav_env.world.depth.raised_plan import (
    NO_JAMB,
    Closet,
    FaceKind,
    PlanWindow,
    RaisedPlan,
)
from semnav_env.world.depth.raising import RaiseSettings, raise_plan

__all__ = [
    "NO_JAMB",
    "Closet",
    "DepthCamera",
    "DepthRig",
    "FaceKind",
    "PlanWindow",
    "RaiseSettings",
    "RaisedPlan",
    "RigHits",
    "raise_plan",
]
