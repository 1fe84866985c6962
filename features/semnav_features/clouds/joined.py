"""One door from two detections of it, such as by cameras and by a 2D lidar."""

from __future__ import annotations

import numpy as np

from semnav_features.clouds.detected_door import DetectedDoor
from semnav_features.frames import FloatArray, Point

JAMB_GATE = 13.8
"""Squared Mahalanobis distance within which two jambs are one: 99.9 % for two unknowns."""


def joined(first: DetectedDoor | None, second: DetectedDoor | None) -> DetectedDoor | None:
    """The door by two detectors in one frame, in place of what one of them did not see.

    A jamb that both saw, and in one place, is fused by least squares. Where they disagree the first
    is right: give the more reliable detector first. A jamb that only one saw is taken from it, if
    the other jamb, where both saw it, agrees. The errors of both jambs count as independent.

    Args:
        first: the more reliable one.
        second: the other one.
    """
    if first is None or second is None:
        return first or second
    ends = (first.start, second.start), (first.end, second.end)
    seen = (first.start_seen, second.start_seen), (first.end_seen, second.end_seen)
    blocks = [(d.covariance[:2, :2], d.covariance[2:, 2:]) for d in (first, second)]
    pairs = [(blocks[0][k], blocks[1][k]) for k in (0, 1)]
    if any(all(seen[k]) and not _agree(ends[k], pairs[k]) for k in (0, 1)):
        return first
    found = [_joined_jamb(ends[k], seen[k], pairs[k]) for k in (0, 1)]
    covariance = np.zeros((4, 4))
    covariance[:2, :2], covariance[2:, 2:] = found[0][1], found[1][1]
    both = [first.confidence, second.confidence]
    start, end = found[0][0], found[1][0]
    return DetectedDoor(start, end, max(both), covariance, any(seen[0]), any(seen[1]))


def _agree(places: tuple[Point, Point], covariances: tuple[FloatArray, FloatArray]) -> bool:
    off = np.subtract(*places)
    return bool(off @ np.linalg.solve(sum(covariances), off) <= JAMB_GATE)


def _joined_jamb(
    places: tuple[Point, Point],
    seen: tuple[bool, bool],
    covariances: tuple[FloatArray, FloatArray],
) -> tuple[Point, FloatArray]:
    """A jamb with its covariance: fused if both, or neither, saw it."""
    if seen[0] != seen[1]:
        k = 0 if seen[0] else 1
        return places[k], covariances[k]
    gain = np.linalg.solve(sum(covariances), covariances[0]).T
    x, y = (places[0] + gain @ np.subtract(places[1], places[0])).tolist()
    return (x, y), covariances[0] - gain @ covariances[0]
