"""Semantic features from 2D lidar scans: walls, doors, corners and corridors.

Needs NumPy and Numba only, so it runs on a robot's own logs without the simulator.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from semnav_env.features.extract import extract
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

if TYPE_CHECKING:
    from semnav_env.features.polyline import polylines

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


def __getattr__(name: str) -> Any:
    """Import `polylines` when it is asked for: a simulator does not need it."""
    if name != "polylines":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from semnav_env.features.polyline import polylines

    return polylines
