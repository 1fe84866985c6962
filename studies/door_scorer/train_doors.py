"""Trains the scorer that tells doors from other gaps, on simulated scans of random offices.

    python -m studies train_doors features/semnav_features/door_scorer.json

makes the file that comes with the package, byte for byte on one machine. No floor plan that
comes with the package and no real scan is used.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import tyro
from numpy.random import Generator, default_rng
from numpy.typing import NDArray
from scipy.optimize import minimize

from semnav_env.world.lidar.lidar import Lidar
from semnav_features import ExtractorSettings
from semnav_features.frames import FloatArray
from semnav_features.kernels.evidence_layout import EVIDENCE_NAMES
from semnav_features.lidar_spec import LidarSpec
from semnav_features.lidars import TIM561
from semnav_features.scan import Scan
from semnav_features.scene import Door
from studies.door_scorer.door_candidates import apart, candidates_of
from studies.door_scorer.random_offices import random_office

HALF_DEGREE = LidarSpec("half_degree", 361, -math.pi / 2, math.radians(0.5))
TRAINING_LIDARS = (TIM561, HALF_DEGREE)
"""Offices are scanned by these in turn."""

RANGE_SIGMAS = (0.0, 0.01, 0.02, 0.03)
"""Standard deviations of the simulated ranges, metres."""

EDGE_JUMP = 0.1
"""Least difference of neighbouring ranges at an edge, metres."""

MIXED_SHARE = 0.2
"""Share of the beams at edges that read a mixture of both ranges."""

MAX_DOOR_ERROR = 0.2
"""A gap is a door if both its jambs are this near to those of a door, metres."""

MIN_OTHER_ERROR = 0.3
"""A gap is no door if a jamb is farther off than this, metres; gaps between the two limits are not
used."""


@dataclass(frozen=True)
class Arguments:
    """Train the scorer that tells doors from other gaps, on simulated scans of random offices.

    Attributes:
        out: file to write.
        offices: how many random offices.
        poses: scans in each.
        hidden: units.
        decay: weight of the squared weights in the loss.
        seed: of offices, poses, noise and first weights.
    """

    out: tyro.conf.Positional[Path]
    offices: int = 1500
    poses: int = 8
    hidden: int = 8
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
    for scan, doors in simulated_scans(training.offices, training.poses, training.seed):
        gaps = candidates_of(scan, settings)
        nearest = apart(gaps.ends, doors).min(axis=1, initial=math.inf)
        decided = (nearest <= MAX_DOOR_ERROR) | (nearest > MIN_OTHER_ERROR)
        parts.append((gaps.evidence[decided], nearest[decided] <= MAX_DOOR_ERROR))
    evidence, labels = zip(*parts, strict=True)
    return np.concatenate(evidence), np.concatenate(labels).astype(np.float64)


def simulated_scans(offices: int, poses: int, seed: int) -> Iterator[tuple[Scan, tuple[Door, ...]]]:
    """Scans from corridors and rooms, with the doors of the office in the lidar frame."""
    for number in range(offices):
        rng = default_rng((seed, number))
        office = random_office(rng, furnished=number % 8 != 0)
        spec = replace(
            TRAINING_LIDARS[number % 2], sigma=RANGE_SIGMAS[number // 2 % len(RANGE_SIGMAS)]
        )
        lidar = Lidar(office.floor_plan, spec)
        for k in range(poses):
            pose = office.any_pose(rng) if k % 2 else office.corridor_pose(rng)
            scan = blurred(lidar.scan(pose, (seed, number, k)), rng)
            yield scan, office.doors_from(pose)


def blurred(scan: Scan, rng: Generator) -> Scan:
    """The scan with some beams that met an edge with half of their width, and read a mixture."""
    ranges = scan.ranges.copy()
    with np.errstate(invalid="ignore"):  # no return beside no return
        jumps = np.abs(np.diff(ranges)) > EDGE_JUMP
    edges = np.flatnonzero(jumps & (rng.random(len(jumps)) < MIXED_SHARE))
    share = rng.random(len(edges))
    ranges[edges] = share * scan.ranges[edges] + (1.0 - share) * scan.ranges[edges + 1]
    return replace(scan, ranges=ranges)


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
