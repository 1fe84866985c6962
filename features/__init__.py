"""Semantic features from 2D lidar scans: walls, doors, corners and corridors.

Needs NumPy and Numba only, so it runs on a robot's own logs without the simulator.
"""

from semnav_env.features.extract import extract
from semnav_env.features.polyline import polylines
from semnav_env.features.scan import Scan
from semnav_env.features.scene import (
    Arc,
    Corner,
    CornerKind,
    CorridorProbe,
    Door,
    Rejection,
    Scene,
    SceneLeaf,
    Wall,
)
from semnav_env.features.settings import ExtractorSettings

__all__ = [
    "Arc",
    "Corner",
    "CornerKind",
    "CorridorProbe",
    "Door",
    "ExtractorSettings",
    "Rejection",
    "Scan",
    "Scene",
    "SceneLeaf",
    "Wall",
    "extract",
    "polylines",
]
