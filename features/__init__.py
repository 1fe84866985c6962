"""Semantic features from 2D lidar scans: walls, doors, corners and corridors.

Needs NumPy and Numba only, so it runs on a robot's own logs without the simulator.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

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
    from semnav_env.features.extraction import extract
    from semnav_env.features.polyline import polylines
    from semnav_env.features.scan import Scan

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

_LAZY = {"extract": "extraction", "polylines": "polyline", "Scan": "scan"}
"""Names that are imported when they are asked for, with their modules; a simulator needs none."""


def __getattr__(name: str) -> Any:
    if name not in _LAZY:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_LAZY[name]}"), name)
