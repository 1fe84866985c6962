"""Poses and maps from many scans: scan matching, odometry, maps of lines and of landmarks."""

from semnav_features.mapping.arc_sightings import ArcSighting, arc_sightings
from semnav_features.mapping.corner_guess import guesses_by_corners
from semnav_features.mapping.corner_sightings import CornerSighting, corner_sightings
from semnav_features.mapping.corrected_odometry import CorrectedOdometry, StepErrors
from semnav_features.mapping.far_matching import match_by_corners
from semnav_features.mapping.landmark_map import LandmarkFix, LandmarkMap
from semnav_features.mapping.landmark_settings import LandmarkSettings
from semnav_features.mapping.line_map import LineMap
from semnav_features.mapping.map_landmarks import MapArc, MapCorner
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
    "ArcSighting",
    "CornerSighting",
    "CorrectedOdometry",
    "KeyframeRule",
    "LandmarkFix",
    "LandmarkMap",
    "LandmarkSettings",
    "LineMap",
    "MapArc",
    "MapCorner",
    "MapSettings",
    "Match",
    "MatchError",
    "MatchSettings",
    "ReferenceLines",
    "ScanOdometry",
    "StepErrors",
    "arc_sightings",
    "corner_sightings",
    "guesses_by_corners",
    "match_by_corners",
    "match_scans",
    "match_surfaces",
    "surface_of",
]
