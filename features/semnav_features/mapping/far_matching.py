"""Matches scans whose first guess is far off, from guesses by corners."""

from __future__ import annotations

from semnav_features.extraction import extract
from semnav_features.frames import ORIGIN, Pose
from semnav_features.mapping.corner_guess import guesses_by_corners
from semnav_features.mapping.corner_sightings import corner_sightings
from semnav_features.mapping.matching import (
    DEFAULT_MATCH_SETTINGS,
    Match,
    MatchError,
    match_surfaces,
    surface_of,
)
from semnav_features.mapping.settings import MatchSettings
from semnav_features.scan import Scan


def match_by_corners(
    reference: Scan,
    scan: Scan,
    guess: Pose = ORIGIN,
    settings: MatchSettings = DEFAULT_MATCH_SETTINGS,
) -> Match:
    """Find the pose of a scan in the frame of another one, though the first guess is far off.

    `match_scans` pairs nearest points, so it needs a guess within some 0.5 m and 15 degrees. Here
    the guess and those of `guesses_by_corners` are tried in turn, and the match on which the
    largest share of the scan's points fits is taken.

    Args:
        reference: a scan.
        scan: another one, of the same surroundings.
        guess: of the scan's pose in the frame of the reference, within 3 m, whatever its heading.
        settings: every limit of the matcher.

    Raises:
        MatchError: no guess leads to a match.
    """
    known, seen = (corner_sightings(extract(each), each) for each in (reference, scan))
    surfaces = surface_of(reference, settings), surface_of(scan, settings)
    matches, reason = list[Match](), MatchError()
    for start in (guess, *guesses_by_corners(known, seen, guess)):
        try:
            matches.append(match_surfaces(*surfaces, start, settings))
        except MatchError as error:
            reason = error
    if not matches:
        raise reason
    return max(matches, key=lambda match: match.inliers)
