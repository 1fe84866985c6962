"""Semantic features from 2D lidar scans: walls, doors, corners and corridors.

Needs NumPy and Numba only, so it runs on a robot's own logs without the simulator.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from semnav_features.lazy_names import lazy_names
from semnav_features.scene import (
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
from semnav_features.settings import ExtractorSettings

if TYPE_CHECKING:
    from semnav_features.extraction import extract
    from semnav_features.polyline import polylines
    from semnav_features.scan import Scan

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

__getattr__ = lazy_names(
    __name__, {".extraction": ("extract",), ".polyline": ("polylines",), ".scan": ("Scan",)}
)
