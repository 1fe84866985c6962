"""Semantic features from 2D lidar scans: walls, doors, corners and corridors.

Needs NumPy and Numba only, so it runs on a robot's own logs without the simulator.
"""

from semnav_env.features.extract import extract
from semnav_env.features.scan import Scan
from semnav_env.features.scene import Corner, CornerKind, Corridor, Door, Scene, Wall
from semnav_env.features.settings import ExtractorSettings

__all__ = [
    "Corner",
    "CornerKind",
    "Corridor",
    "Door",
    "ExtractorSettings",
    "Scan",
    "Scene",
    "Wall",
    "extract",
]
