"""Segmentation rate: how much of every visible wall comes back in one piece."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.settings import ExtractorSettings
from studies.segmentation.segment_labels import (
    NO_SEGMENT,
    LabelledScan,
    Labels,
    found_lines,
    found_surfaces,
)

SPLIT_DISTANCE = ExtractorSettings().split_distance
"""The default, metres: walls that are built less straight than that need it at any noise."""


def detected_length(
    points: FloatArray, true: Labels, found: Labels, owners: Labels | None = None
) -> tuple[float, float]:
    """The sums of (11): the detected and the expected length of all segments.

    A segment's length is that of the way along the exact hits of its beams. Detected of it is
    the longest stretch with one found label. A found segment is a detection of one true owner
    only, the one it has most of, so a wall in pieces counts by its longest piece, and two walls
    taken for one count as the longer of them.

    Args:
        points: exact hits, metres, shape (n, 2).
        true: the segment that each beam hits, or `NO_SEGMENT`.
        found: the segment that each beam was put into, or `NO_SEGMENT`.
        owners: what each true segment is a part of; itself if None. A found segment may span
            several parts of its owner.

    Returns:
        Metres detected and metres expected.
    """
    if owners is None:
        owners = np.arange(true.max(initial=NO_SEGMENT) + 1)
    steps = np.hypot(*np.diff(points, axis=0).T)
    within = (true[1:] == true[:-1]) & (true[1:] != NO_SEGMENT)
    expected = float(steps[within].sum())
    same = within & (found[1:] == found[:-1]) & (found[1:] != NO_SEGMENT)
    shape = (true.max(initial=NO_SEGMENT) + 1, found.max(initial=NO_SEGMENT) + 1)
    shared = np.zeros(shape)
    np.add.at(shared, (true[1:][same], found[1:][same]), steps[same])
    whole = np.zeros((owners.max(initial=NO_SEGMENT) + 1, shape[1]))
    np.add.at(whole, owners, shared)
    if not shared.size:
        return 0.0, expected
    allowed = owners[:, None] == whole.argmax(axis=0)[None, :]
    return float(np.where(allowed, shared, 0.0).max(axis=1).sum()), expected


def segmentation_rate(
    points: FloatArray, true: Labels, found: Labels, owners: Labels | None = None
) -> float:
    """Weerakoon (11) of one scan, 0 to 1; NaN if nothing is in view. See `detected_length`."""
    detected, expected = detected_length(points, true, found, owners)
    return detected / expected if expected > 0.0 else math.nan


@dataclass(frozen=True)
class Rate:
    """Weerakoon (11) over many scans with one noise.

    Attributes:
        noise: standard deviation of the ranges, metres.
        surfaces: of connected surfaces, as the breakpoint rule alone finds them, 0 to 1.
        lines: of straight walls, as the whole chain finds them, 0 to 1.
        scans: how many there were.
    """

    noise: float
    surfaces: float
    lines: float
    scans: int


def known_noise(settings: ExtractorSettings, noise: float) -> ExtractorSettings:
    """The settings of one who knows the lidar: its noise, and a split distance of four of it.

    Sigma is not taken below 5 mm, as a line that must fit perfectly leaves no room for rounding.
    """
    sigma = max(noise, 0.005)
    return replace(settings, sigma=sigma, split_distance=max(4.0 * sigma, SPLIT_DISTANCE))


def measure(scans: Sequence[LabelledScan], settings: ExtractorSettings) -> list[Rate]:
    """The rates of one choice of settings, for each noise."""
    return [
        _measured(noise, [scan for scan in scans if scan.noise == noise], settings)
        for noise in sorted({scan.noise for scan in scans})
    ]


def _measured(noise: float, scans: list[LabelledScan], settings: ExtractorSettings) -> Rate:
    sums = np.zeros((2, 2))
    for labelled in scans:
        points, scan = labelled.points, labelled.scan
        surfaces, lines = found_surfaces(scan, settings), found_lines(scan, settings)
        sums += (
            detected_length(points, labelled.surfaces, surfaces),
            detected_length(points, labelled.lines, lines, labelled.walls),
        )
    surface, line = (sums[:, 0] / sums[:, 1]).tolist()
    return Rate(noise, surface, line, len(scans))
