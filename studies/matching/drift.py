"""How far odometry from scans strays from the poses of a log."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from semnav_features.frames import FloatArray, Pose, relative
from semnav_features.mapping import KeyframeRule, MatchSettings, ScanOdometry
from semnav_features.readers import LogRecord

DRIFT_STRETCH = 10.0
"""Length of the ways over which drift is told, metres."""


@dataclass(frozen=True, eq=False)
class Drift:
    """Odometry against the poses of a log.

    Attributes:
        scans: how many.
        path: length of the way, metres.
        lost: scans that could not be matched.
        position: error of the displacement over every way of `DRIFT_STRETCH` metres, metres.
        angle: error of the turn, radians, not negative.
    """

    scans: int
    path: float
    lost: int
    position: FloatArray
    angle: FloatArray


def drift_of(
    records: Iterable[LogRecord],
    wheels: bool,
    settings: MatchSettings = MatchSettings(),
    rule: KeyframeRule = KeyframeRule(),
) -> Drift:
    """Follow a log by its scans.

    Args:
        records: with poses to compare with.
        wheels: whether the log's odometry guides the matches; else only the motion before does.
        settings: of the matcher.
        rule: of its keyframes.

    Raises:
        ValueError: a record tells no pose.
    """
    odometry = ScanOdometry(settings, rule)
    last: Pose | None = None
    found: list[Pose] = []
    true: list[Pose] = []
    for record in records:
        if record.pose is None:
            raise ValueError("the log says no poses to compare with")
        moved = relative(last, record.odometry) if wheels and last and record.odometry else None
        last = record.odometry
        found.append(odometry.update(record.scan, moved))
        true.append(record.pose)
    position, angle = stretch_errors(found, true)
    return Drift(len(true), float(_way(true)[-1]), odometry.lost, position, angle)


def stretch_errors(found: Sequence[Pose], true: Sequence[Pose]) -> tuple[FloatArray, FloatArray]:
    """Errors of displacement, metres, and of the turn, radians, over each `DRIFT_STRETCH`."""
    way = _way(true)
    stops = np.searchsorted(way, way + DRIFT_STRETCH)
    errors = [
        relative(relative(true[i], true[j]), relative(found[i], found[j]))
        for i, j in enumerate(stops.tolist())
        if j < len(true)
    ]
    table = np.array(errors).reshape(-1, 3)
    return np.hypot(table[:, 0], table[:, 1]), np.abs(table[:, 2])


def _way(poses: Sequence[Pose]) -> FloatArray:
    """Length of the way up to each pose, metres."""
    steps = [math.dist(a[:2], b[:2]) for a, b in pairwise(poses)]
    way: FloatArray = np.concatenate(((0.0,), np.cumsum(steps)))
    return way
