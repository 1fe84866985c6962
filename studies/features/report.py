"""What a study found, as tables."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from studies.features.cases import PLACES
from studies.features.metrics import (
    BEARING_BORDERS,
    RANGE_BORDERS,
    Score,
    binned,
    calibration,
    score,
    segmentation_rates,
)
from studies.features.records import FeatureKind
from studies.features.study import Outcome, Study
from studies.sheets import Cell, ResultSheet

COUNT_COLUMNS = (
    *("in good view", "recall", "in view", "recall, all in view"),
    *("detections", "precision", "F1"),
)
"""Columns of `_counts`."""


def sheets(study: Study, sigma: float) -> list[ResultSheet]:
    """All tables; those by plan, range, bearing and confidence for one noise, `sigma`."""
    return [
        found_and_missed(study),
        doors_by_plan(study, sigma),
        errors(study),
        strategies(study),
        by_bin(study, sigma, "range", "range, m", RANGE_BORDERS, 1.0),
        by_bin(study, sigma, "bearing", "bearing, degrees", BEARING_BORDERS, math.degrees(1.0)),
        reliability(study, sigma),
    ]


def in_short(study: Study, sigma: float) -> list[ResultSheet]:
    """Recall and precision over all poses for one noise, of every strategy if there are several."""
    outcome = study.pooled(sigma=sigma)
    rows = [(kind.label, *_counts(outcome, kind)) for kind in FeatureKind]
    short = ResultSheet(
        f"Over all poses, sigma {1e3 * sigma:g} mm", ("feature", *COUNT_COLUMNS), rows
    )
    if len(study.strategies) == 1:
        return [short]
    return [features_by_strategy(study, sigma), strategies(study)]


def found_and_missed(study: Study) -> ResultSheet:
    """Recall and precision of every kind with the default settings."""
    rows = [
        (place, _yes(clutter), 1e3 * sigma, kind.label, *_counts(outcome, kind))
        for place in PLACES
        for clutter in (False, True)
        for sigma in study.sigmas
        for outcome in [study.pooled(sigma=sigma, place=place, clutter=clutter)]
        for kind in FeatureKind
        if outcome.scans
    ]
    columns = ("poses", "clutter", "sigma, mm", "feature", *COUNT_COLUMNS)
    return ResultSheet("Found and missed, default settings", columns, rows)


def doors_by_plan(study: Study, sigma: float) -> ResultSheet:
    """Recall and precision of doors in every plan."""
    rows = [
        (plan, place, _yes(clutter), *_counts(outcome, FeatureKind.DOOR))
        for plan in study.plans
        for place in PLACES
        for clutter in (False, True)
        for outcome in [study.pooled(sigma=sigma, place=place, clutter=clutter, plan=plan)]
        if outcome.scans
    ]
    title = f"Doors by floor plan, sigma {1e3 * sigma:g} mm"
    return ResultSheet(title, ("floor plan", "poses", "clutter", *COUNT_COLUMNS), rows)


def errors(study: Study) -> ResultSheet:
    """Errors of what was found in good view."""
    rows: list[tuple[Cell, ...]] = []
    for sigma in study.sigmas:
        outcome = study.pooled(sigma=sigma)
        for kind in FeatureKind:
            each = score(outcome.sightings, outcome.detections, kind)
            if not each.gated:
                continue
            degrees = tuple(math.degrees(angle) for angle in each.angle)
            share = tuple(100.0 * part for part in each.place_share)
            numbers = (*degrees, *each.place, *share, *each.size, each.type_right)
            rows.append((1e3 * sigma, kind.label, *numbers))
    named = ("angle, degrees", "place, m", "place, % of range", "door width, m, or radius, share")
    both = [f"{name}: {part}" for name in named for part in ("median", "90 %")]
    columns = ("sigma, mm", "feature", *both, "inner or outer right")
    return ResultSheet("Errors of what was found, default settings", columns, rows)


def strategies(study: Study) -> ResultSheet:
    """Every strategy at every noise."""
    rows = [
        (name, 1e3 * sigma, *_strategy(study.pooled(name, sigma)))
        for name in study.strategies
        for sigma in study.sigmas
    ]
    columns = (
        *("strategy", "sigma, mm", "segmentation rate", "by the longest piece"),
        *("wall recall", "wall precision", "door recall", "door precision", "corner F1"),
        *("corner F1, potential", "median us a scan"),
    )
    return ResultSheet("Strategies", columns, rows)


def features_by_strategy(study: Study, sigma: float) -> ResultSheet:
    """Recall and precision of every kind with every strategy, over all poses for one noise."""
    rows = [
        (name, kind.label, *_counts(study.pooled(name, sigma), kind))
        for name in study.strategies
        for kind in FeatureKind
    ]
    title = f"Features by strategy, sigma {1e3 * sigma:g} mm"
    return ResultSheet(title, ("strategy", "feature", *COUNT_COLUMNS), rows)


def by_bin(
    study: Study, sigma: float, column: str, title: str, borders: Sequence[float], unit: float
) -> ResultSheet:
    """Recall and precision of every kind by range or by the bearing to either side."""
    outcome = study.pooled(sigma=sigma)
    rows = [
        (kind.label, f"{unit * low:g} to {unit * high:g}", *_of(each))
        for kind in FeatureKind
        for low, high, each in zip(
            borders[:-1],
            borders[1:],
            binned(outcome.sightings, outcome.detections, kind, column, borders),
            strict=True,
        )
    ]
    return ResultSheet(
        f"By {column}, sigma {1e3 * sigma:g} mm", ("feature", title, *COUNT_COLUMNS), rows
    )


def reliability(study: Study, sigma: float) -> ResultSheet:
    """How often doors are doors that were found with some confidence."""
    bins = calibration(study.pooled(sigma=sigma).detections)
    rows = [(f"{b.low:.1f} to {b.high:.1f}", b.detections, b.confidence, b.precision) for b in bins]
    columns = ("confidence", "detections", "mean confidence", "share that are doors")
    return ResultSheet(f"Confidence of doors, sigma {1e3 * sigma:g} mm", columns, rows)


def _counts(outcome: Outcome, kind: FeatureKind) -> tuple[Cell, ...]:
    return _of(score(outcome.sightings, outcome.detections, kind))


def _of(each: Score) -> tuple[Cell, ...]:
    found = (each.gated, each.recall, each.seen, each.recall_ungated)
    return (*found, each.detections, each.precision, each.f1)


def _strategy(outcome: Outcome) -> Iterator[Cell]:
    yield from segmentation_rates(outcome.sightings)
    for kind in (FeatureKind.WALL, FeatureKind.DOOR):
        each = score(outcome.sightings, outcome.detections, kind)
        yield from (each.recall, each.precision)
    for kind in (FeatureKind.FULL_CORNER, FeatureKind.POTENTIAL_CORNER):
        yield score(outcome.sightings, outcome.detections, kind).f1
    yield float(1e6 * np.median(outcome.seconds)) if outcome.scans else math.nan


def _yes(clutter: bool) -> str:
    return "yes" if clutter else "no"
