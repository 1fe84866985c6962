"""Poses and maps from many scans: scan matching, scan odometry, line maps."""

from semnav_features.mapping.line_map import LineMap
from semnav_features.mapping.map_settings import MapSettings
from semnav_features.mapping.matching import (
    Match,
    MatchError,
    ReferenceLines,
    match_scans,
    match_surfaces,
    surface_of,
)
from semnav_features.mapping.odometry import KeyframeRule, ScanOdometry
from semnav_features.mapping.settings import MatchSettings

__all__ = [
    "KeyframeRule",
    "LineMap",
    "MapSettings",
    "Match",
    "MatchError",
    "MatchSettings",
    "ReferenceLines",
    "ScanOdometry",
    "match_scans",
    "match_surfaces",
    "surface_of",
]
