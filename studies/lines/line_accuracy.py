"""How true the walls are that `extract` finds in simulated scans of floor plans."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from semnav_features import Door, ExtractorSettings, Scan, Wall, extract
from semnav_features.extraction import beam_directions, sensor_of
from semnav_features.frames import FloatArray
from semnav_features.kernels.chain import extract_arrays
from semnav_features.kernels.scratch import allocate_features, allocate_scratch
from semnav_features.strategies import Segmentation, strategy_names
from studies.features.cases import Case

MIN_WALL_LENGTH = 0.3
"""Shorter walls do not count, metres."""

MAX_WALL_DISTANCE = 0.15
"""A wall that is farther from every true wall at some point is off, metres."""

WALL_SAMPLES = 11
"""Points of a wall that are compared with the truth."""

TIMING_ROUNDS = 5
"""The time is the best of so many rounds."""


def segmentations(sigma: float) -> dict[str, ExtractorSettings]:
    """What is compared on scans with that noise: default settings, and such as are told of it."""
    names = strategy_names(Segmentation)
    told = ExtractorSettings(sigma=sigma, split_distance=4.0 * sigma)
    return {name: ExtractorSettings(segmentation=name) for name in names} | {
        f"{name}, sigma known": replace(told, segmentation=name) for name in names
    }


@dataclass(frozen=True)
class WallAccuracy:
    """The walls of `MIN_WALL_LENGTH` and more that were found in some scans.

    Attributes:
        walls: how many a scan.
        off: share that is somewhere more than `MAX_WALL_DISTANCE` away from every true wall.
        median: of the angle between a wall and the true wall beside its middle, degrees.
        p90: 90th percentile of the same.
        bridging: walls that run across an open door.
        microseconds: what the whole chain takes for one scan, best of `TIMING_ROUNDS` rounds.
    """

    walls: float
    off: float
    median: float
    p90: float
    bridging: int
    microseconds: float


def wall_accuracy(cases: Sequence[Case], sigma: float, settings: ExtractorSettings) -> WallAccuracy:
    """Extract the walls of every case's scan with that noise and hold them against the truth."""
    scans = [dict(case.scans)[sigma] for case in cases]
    angles: list[float] = []
    count = bridging = 0
    for case, scan in zip(cases, scans, strict=True):
        truth = np.array([(wall.start, wall.end) for wall in case.truth.walls]).reshape(-1, 2, 2)
        for wall in extract(scan, settings).walls:
            if wall.length >= MIN_WALL_LENGTH:
                count += 1
                bridging += any(_crosses(wall, door) for door in case.truth.doors)
                angles += _angle(wall, truth)
    median, p90 = np.degrees(np.percentile(angles, (50, 90))) if angles else (math.nan, math.nan)
    return WallAccuracy(
        count / len(cases),
        1.0 - len(angles) / max(count, 1),
        float(median),
        float(p90),
        bridging,
        1e6 * seconds_a_scan(scans, settings),
    )


def _angle(wall: Wall, truth: FloatArray) -> list[float]:
    """The angle to the true wall beside the middle of a wall, radians; nothing if it is off."""
    points = np.linspace(wall.start, wall.end, WALL_SAMPLES)
    distances = _distances(points, truth)
    if not len(truth) or distances.min(axis=1).max() > MAX_WALL_DISTANCE:
        return []
    start, end = truth[np.argmin(distances[WALL_SAMPLES // 2])]
    (ax, ay), (bx, by) = end - start, points[-1] - points[0]
    return [math.atan2(abs(ax * by - ay * bx), abs(ax * bx + ay * by))]


def _distances(points: FloatArray, segments: FloatArray) -> FloatArray:
    """From every point to every segment, shape (points, segments), metres."""
    along = segments[:, 1] - segments[:, 0]
    offset = points[:, None] - segments[:, 0]
    share = (offset * along).sum(axis=2) / np.maximum((along**2).sum(axis=1), 1e-12)
    nearest = np.clip(share, 0.0, 1.0)[:, :, None] * along
    distances: FloatArray = np.hypot(*(offset - nearest).transpose(2, 0, 1))
    return distances


def _crosses(wall: Wall, door: Door) -> bool:
    """Whether a wall covers the middle half of an open door."""
    shares: NDArray[np.float64] = np.array((0.25, 0.5, 0.75))[:, None]
    points = (1.0 - shares) * door.start + shares * np.array(door.end)
    segment = np.array([(wall.start, wall.end)])
    return bool((_distances(points, segment) < MAX_WALL_DISTANCE).all())


def seconds_a_scan(scans: Iterable[Scan], settings: ExtractorSettings) -> float:
    """What the compiled chain takes for one of the scans, the best of some rounds."""
    sweeps = [
        (
            scan.ranges.copy(),
            beam_directions(len(scan.ranges), scan.angle_min, scan.angle_increment),
            sensor_of(scan),
        )
        for scan in scans
    ]
    record, features = settings.as_record()[0], allocate_features()
    scratch = allocate_scratch(max(len(sweep[0]) for sweep in sweeps))
    rounds = []
    for _ in range(TIMING_ROUNDS + 1):
        start = time.perf_counter()
        for sweep in sweeps:
            extract_arrays(*sweep, record, scratch, features, True)
        rounds.append(time.perf_counter() - start)
    return min(rounds[1:]) / len(sweeps)
