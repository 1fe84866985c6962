"""Numbers from sightings and detections: recall, precision, errors, calibration."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from studies.features.overlap import segmentation_rate
from studies.features.records import FeatureKind

Table = NDArray[np.void]
"""Of `Sighting` or of `Detection`, see `records.as_table`."""

RANGE_BORDERS = (0.0, 2.0, 4.0, 6.0, 8.0, 10.0)
"""Borders of the range bins, metres."""

BEARING_BORDERS = tuple(math.radians(degrees) for degrees in (0.0, 30.0, 60.0, 90.0, 120.0, 180.0))
"""Borders of the bins of the bearing to either side, radians."""

CONFIDENCE_BORDERS = tuple(k / 10.0 for k in range(11))
"""Borders of the confidence bins."""


@dataclass(frozen=True)
class Score:
    """How one kind of feature was found. NaN where there is nothing to count.

    Attributes:
        seen: true features in view.
        gated: of them, in good view.
        recall: share of the gated ones that were found.
        recall_ungated: share of all in view that were found.
        detections: detected features.
        precision: share of the detections that are true features, in good view or not.
        angle: median and 90th percentile of a wall's error of direction, radians.
        place: the same for an error of place, metres, see `Sighting.place`.
        place_share: the same for the error of place over the range.
        size: the same for `Sighting.size`.
        type_right: share of the corners found that are inner or outer as they should be.
    """

    seen: int
    gated: int
    recall: float
    recall_ungated: float
    detections: int
    precision: float
    angle: tuple[float, float]
    place: tuple[float, float]
    place_share: tuple[float, float]
    size: tuple[float, float]
    type_right: float

    @property
    def f1(self) -> float:
        """Harmonic mean of recall (gated) and precision."""
        total = self.recall + self.precision
        return 2.0 * self.recall * self.precision / total if total else 0.0


def score(sightings: Table, detections: Table, kind: FeatureKind) -> Score:
    """The score of one kind of feature; errors are those of features in good view."""
    sightings = sightings[sightings["kind"] == kind]
    detections = detections[detections["kind"] == kind]
    gated = sightings[sightings["gated"]]
    return Score(
        len(sightings),
        len(gated),
        _mean(gated["found"]),
        _mean(sightings["found"]),
        len(detections),
        _mean(detections["right"]),
        _spread(gated["angle"]),
        _spread(gated["place"]),
        _spread(gated["place"] / np.maximum(gated["range"], 1e-9)),
        _spread(gated["size"]),
        _mean(gated["type_right"]),
    )


def segmentation_rates(sightings: Table) -> tuple[float, float]:
    """Weerakoon (11) over all walls in view: by all detections together, and by the longest."""
    walls = sightings[sightings["kind"] == FeatureKind.WALL]
    return (
        segmentation_rate(walls["length"], walls["covered"]),
        segmentation_rate(walls["length"], walls["longest"]),
    )


def binned(
    sightings: Table, detections: Table, kind: FeatureKind, column: str, borders: Sequence[float]
) -> list[Score]:
    """The score in each bin of the range or of the bearing to either side."""
    return [
        score(_between(sightings, column, a, b), _between(detections, column, a, b), kind)
        for a, b in pairwise(borders)
    ]


@dataclass(frozen=True)
class Bin:
    """Doors that were found with a similar confidence.

    Attributes:
        low: least confidence.
        high: greatest confidence.
        detections: how many.
        confidence: their mean.
        precision: share of them that are true doors.
    """

    low: float
    high: float
    detections: int
    confidence: float
    precision: float


def calibration(detections: Table, borders: Sequence[float] = CONFIDENCE_BORDERS) -> list[Bin]:
    """A reliability table of the doors' confidences; bins without doors are left out."""
    doors = detections[detections["kind"] == FeatureKind.DOOR]
    bins = []
    for low, high in pairwise(borders):
        inside = doors["confidence"] >= low
        inside &= (doors["confidence"] < high) | (high == borders[-1])
        chosen = doors[inside]
        if len(chosen):
            mean = _mean(chosen["confidence"])
            bins.append(Bin(low, high, len(chosen), mean, _mean(chosen["right"])))
    return bins


def calibration_error(bins: Sequence[Bin]) -> float:
    """Mean gap between confidence and precision, weighted by detections; NaN without any."""
    total = sum(each.detections for each in bins)
    gaps = sum(each.detections * abs(each.confidence - each.precision) for each in bins)
    return gaps / total if total else math.nan


def _between(table: Table, column: str, low: float, high: float) -> Table:
    values = np.abs(table[column])
    return np.asarray(table[(values >= low) & (values < high)])


def _mean(values: NDArray[np.generic]) -> float:
    numbers = values.astype(np.float64)
    numbers = numbers[~np.isnan(numbers)]
    return float(numbers.mean()) if len(numbers) else math.nan


def _spread(values: FloatArray) -> tuple[float, float]:
    """Median and 90th percentile of what is a number."""
    values = values[~np.isnan(values)]
    if not len(values):
        return math.nan, math.nan
    return float(np.median(values)), float(np.percentile(values, 90.0))
