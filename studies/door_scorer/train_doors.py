"""Trains the scorer that tells doors from other gaps, on simulated scans.

    python -m studies train_doors features/semnav_features/door_scorer.json --kth KTH_FLOORS

makes the file that comes with the package, byte for byte on one machine, from random offices and
from drawn floors of real buildings. No floor plan that comes with the package and no real scan is
used.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import tyro
from numpy.random import default_rng
from numpy.typing import NDArray
from scipy.optimize import minimize

from semnav_features import ExtractorSettings
from semnav_features.frames import FloatArray
from semnav_features.kernels.evidence_layout import EVIDENCE_NAMES
from semnav_features.scan import Scan
from semnav_features.scene import Door
from studies.door_scorer.door_candidates import apart, candidates_of
from studies.door_scorer.drawn_floors import drawn_floors
from studies.door_scorer.training_scans import scans_of_floors, scans_of_offices

MAX_DOOR_ERROR = 0.2
"""A gap is a door if both its jambs are this near to those of a door, metres."""

MIN_OTHER_ERROR = 0.3
"""A gap is no door if a jamb is farther off than this, metres; gaps between the two limits are not
used."""


@dataclass(frozen=True)
class Arguments:
    """Train the scorer that tells doors from other gaps, on simulated scans.

    Attributes:
        out: file to write.
        kth: folder with the floors of the KTH data set as BUILDING/FLOOR.xml; without it only
            random offices are trained on.
        offices: how many random offices.
        poses: scans in each.
        layouts: how many times each drawn floor is furnished anew.
        floor_poses: scans in each layout.
        hidden: units.
        decay: weight of the squared weights in the loss.
        seed: of offices, poses, noise and first weights.
    """

    out: tyro.conf.Positional[Path]
    kth: Path | None = None
    offices: int = 1500
    poses: int = 8
    layouts: int = 16
    floor_poses: int = 30
    hidden: int = 12
    decay: float = 1e-4
    seed: int = 0

    def run(self) -> int:
        """Train and write the file."""
        evidence, labels = collect(self)
        scorer = fit(evidence, labels, self)
        self.out.write_text(json.dumps(scorer, indent=1) + "\n", encoding="utf-8")
        print(f"{len(labels)} gaps, {labels.mean():.1%} of them doors: {self.out}")
        return 0


def collect(training: Arguments) -> tuple[FloatArray, FloatArray]:
    """The evidence of every decided gap, shape (n, k), and whether it is a door (1) or not (0)."""
    settings = ExtractorSettings(door_confidence_min=0.0)
    parts = []
    for scan, doors in training_scans(training):
        gaps = candidates_of(scan, settings)
        nearest = apart(gaps.ends, doors).min(axis=1, initial=math.inf)
        decided = (nearest <= MAX_DOOR_ERROR) | (nearest > MIN_OTHER_ERROR)
        parts.append((gaps.evidence[decided], nearest[decided] <= MAX_DOOR_ERROR))
    evidence, labels = zip(*parts, strict=True)
    return np.concatenate(evidence), np.concatenate(labels).astype(np.float64)


def training_scans(training: Arguments) -> Iterator[tuple[Scan, tuple[Door, ...]]]:
    """Scans of the random offices, then of the drawn floors, with the doors in the lidar frame."""
    yield from scans_of_offices(training.offices, training.poses, training.seed)
    if training.kth is not None:
        floors = drawn_floors(training.kth)
        yield from scans_of_floors(floors, training.layouts, training.floor_poses, training.seed)


def fit(evidence: FloatArray, labels: FloatArray, training: Arguments) -> dict[str, object]:
    """Least cross-entropy by L-BFGS on standardised evidence; see `features.door_scorer`."""
    mean, scale = evidence.mean(axis=0), evidence.std(axis=0) + 1e-9
    inputs = (evidence - mean) / scale
    size, count = training.hidden, inputs.shape[1]
    rng = default_rng(training.seed)
    first = np.zeros(size * (count + 2) + 1)
    first[: size * count] = rng.normal(0.0, count**-0.5, size * count)
    first[-size - 1 : -1] = rng.normal(0.0, size**-0.5, size)
    options = {"maxiter": 1000}
    found = minimize(
        _loss,
        first,
        args=(inputs, labels, size, training.decay),
        jac=True,
        method="L-BFGS-B",
        options=options,
    )
    weights, bias, output, offset = _unpacked(found.x, size, count)
    return {
        "inputs": list(EVIDENCE_NAMES),
        "weights": _rounded(weights / scale),
        "bias": _rounded(bias - weights @ (mean / scale)),
        "output": _rounded(output),
        "offset": round(float(offset), 6),
    }


def _rounded(values: FloatArray) -> list[float]:
    rounded: list[float] = np.round(values, 6).tolist()
    return rounded


def _unpacked(
    flat: FloatArray, size: int, count: int
) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    weights = flat[: size * count].reshape(size, count)
    bias, output = flat[size * count : -1].reshape(2, size)
    return weights, bias, output, float(flat[-1])


def _loss(
    flat: FloatArray, inputs: FloatArray, labels: FloatArray, size: int, decay: float
) -> tuple[float, NDArray[np.float64]]:
    """Mean cross-entropy with weight decay, and its gradient."""
    weights, bias, output, offset = _unpacked(flat, size, inputs.shape[1])
    level = inputs @ weights.T + bias
    slope = 1.0 / (1.0 + np.abs(level))
    total = (level * slope) @ output + offset
    loss = np.logaddexp(0.0, -total * (2.0 * labels - 1.0)).mean() + decay * (flat @ flat) / 2.0
    error = (1.0 / (1.0 + np.exp(-total)) - labels) / len(labels)
    back = np.outer(error, output) * slope**2
    parts = ((back.T @ inputs).ravel(), back.sum(axis=0), (level * slope).T @ error, [error.sum()])
    return float(loss), np.concatenate(parts) + decay * flat
