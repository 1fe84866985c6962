"""Figures of a study."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

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
from studies.features.study import Study

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

KIND_COLOURS = ("#1c7ed6", "#1a9e3f", "#e8590c", "#f2a900", "#8e3bb8", "#d62728")
"""Of walls, doors, full corners, potential corners, corridors and arcs."""

MIN_DRAWN_COUNT = 20
"""A share of fewer features than this is not drawn."""


def save_figures(study: Study, sigma: float, folder: Path) -> list[Path]:
    """Write all figures as PNG into a folder, which must exist; returns their paths.

    Those by range, bearing and confidence are for one noise, `sigma` metres.
    """
    figures = {
        "by_noise": by_noise(study),
        "by_range": by_bin(study, sigma, "range", RANGE_BORDERS, 1.0, "range, m"),
        "by_bearing": by_bin(
            study,
            sigma,
            "bearing",
            BEARING_BORDERS,
            math.degrees(1.0),
            "bearing to either side, degrees",
        ),
        "confidence": reliability(study, sigma),
        "strategies": strategies(study),
    }
    paths = []
    for name, figure in figures.items():
        paths.append(folder / f"{name}.png")
        figure.savefig(paths[-1], dpi=110)
    return paths


def by_noise(study: Study) -> Figure:
    """Recall, precision and F1 of every kind against the noise."""
    figure, axes = _three()
    millimetres = [1e3 * sigma for sigma in study.sigmas]
    pools = [study.pooled(sigma=sigma) for sigma in study.sigmas]
    for kind in FeatureKind:
        scores = [score(pool.sightings, pool.detections, kind) for pool in pools]
        _draw(axes, kind, millimetres, scores)
    _finish(axes, "sigma, mm", millimetres)
    return figure


def by_bin(
    study: Study, sigma: float, column: str, borders: Sequence[float], unit: float, label: str
) -> Figure:
    """Recall, precision and F1 of every kind by range or bearing."""
    figure, axes = _three()
    pool = study.pooled(sigma=sigma)
    edges = unit * np.array(borders)
    for kind in FeatureKind:
        scores = binned(pool.sightings, pool.detections, kind, column, borders)
        _draw(axes, kind, (0.5 * (edges[:-1] + edges[1:])).tolist(), scores)
    _finish(axes, label, edges.tolist())
    figure.suptitle(f"sigma {1e3 * sigma:g} mm")
    return figure


def reliability(study: Study, sigma: float) -> Figure:
    """Share of true doors against the confidence that they were found with."""
    figure = _figure(4.8, 4.2)
    ax = figure.subplots()
    bins = calibration(study.pooled(sigma=sigma).detections)
    ax.plot([0, 1], [0, 1], "--", color="0.6", label="as it should be")
    mean, share = [b.confidence for b in bins], [b.precision for b in bins]
    ax.plot(mean, share, "o-", color=KIND_COLOURS[FeatureKind.DOOR], label="doors")
    for each in bins:
        where = (each.confidence, each.precision)
        ax.annotate(
            str(each.detections), where, (0, -14), textcoords="offset points", ha="center", size=8
        )
    ax.set(xlabel="confidence", ylabel="share that are doors", xlim=(0, 1.03), ylim=(0, 1.03))
    ax.set_title(f"sigma {1e3 * sigma:g} mm; number of detections", size=10)
    ax.legend(loc="upper left")
    ax.grid(alpha=0.3)
    return figure


def strategies(study: Study) -> Figure:
    """Segmentation rate of every strategy at every noise."""
    names = list(study.strategies)
    figure = _figure(7.0, 1.4 + 0.45 * len(names))
    ax = figure.subplots()
    height = 0.8 / len(study.sigmas)
    for k, sigma in enumerate(study.sigmas):
        rates = [segmentation_rates(study.pooled(name, sigma).sightings)[1] for name in names]
        places = [row + (k + 0.5) * height - 0.4 for row in range(len(names))]
        shade = 0.35 + 0.5 * k / len(study.sigmas)
        ax.barh(places, rates, height, color=str(shade), label=f"{1e3 * sigma:g} mm")
    ax.set_yticks(range(len(names)), names)
    ax.invert_yaxis()
    ax.set(xlabel="segmentation rate by the longest piece", xlim=(0, 1))
    ax.grid(axis="x", alpha=0.3)
    ax.legend(title="sigma", loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure


def _three() -> tuple[Figure, list[Axes]]:
    figure = _figure(11.5, 4.0)
    axes = list(figure.subplots(1, 3, sharey=True))
    for ax, name in zip(axes, ("recall, in good view", "precision", "F1"), strict=True):
        ax.set_title(name)
        ax.grid(alpha=0.3)
    return figure, axes


_READ: tuple[Callable[[Score], float], ...] = (
    lambda each: each.recall if each.gated >= MIN_DRAWN_COUNT else math.nan,
    lambda each: each.precision if each.detections >= MIN_DRAWN_COUNT else math.nan,
    lambda each: each.f1 if min(each.gated, each.detections) >= MIN_DRAWN_COUNT else math.nan,
)


def _draw(axes: list[Axes], kind: FeatureKind, places: list[float], scores: list[Score]) -> None:
    for ax, read in zip(axes, _READ, strict=True):
        values = [read(each) for each in scores]
        ax.plot(places, values, "o-", color=KIND_COLOURS[kind], label=kind.label, markersize=4)


def _finish(axes: list[Axes], label: str, ticks: list[float]) -> None:
    axes[0].set_ylim(top=1.01)
    axes[0].legend(fontsize=8)
    for ax in axes:
        ax.set_xlabel(label)
        ax.set_xticks(ticks)


def _figure(width: float, height: float) -> Figure:
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")
