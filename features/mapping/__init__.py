"""From many scans to poses and maps: scan matching."""

from semnav_env.features.mapping.matching import (
    Match,
    MatchError,
    Surface,
    match_scans,
    match_surfaces,
    surface_of,
)
from semnav_env.features.mapping.settings import MatchSettings

__all__ = [
    "Match",
    "MatchError",
    "MatchSettings",
    "Surface",
    "match_scans",
    "match_surfaces",
    "surface_of",
]
