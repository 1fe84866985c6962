"""Drift of odometry on real scans, corrected by nothing, by walls, and by walls and landmarks."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import FloorPlan
from semnav_env.world.simulator import WHEELCHAIR_ODOMETRY, OdometrySettings
from semnav_features.frames import ORIGIN, FloatArray, Pose, compose, relative
from semnav_features.mapping import CorrectedOdometry, ScanOdometry
from semnav_features.readers import open_log
from semnav_features.scan import Scan
from studies.matching.drift import stretch_errors

CORRECTIONS = {"none": None, "walls": False, "walls and landmarks": True}
"""Whether landmarks correct as well; None for odometry alone."""

LEAST_MOVE, LEAST_TURN = 0.1, math.radians(5.0)
"""Scans of a drive are this far apart at least, metres or radians."""


@dataclass(frozen=True, eq=False)
class ScannedDrive:
    """Scans with true poses, or those of a log.

    Attributes:
        name: of the log or plan.
        scans: in order.
        poses: of the lidar, as many.
    """

    name: str
    scans: Sequence[Scan]
    poses: Sequence[Pose]


def drive_of_log(path: Path, every_scan: bool = False) -> ScannedDrive:
    """The scans of a log with poses, those left out that have hardly moved."""
    scans, poses = list[Scan](), list[Pose]()
    with open_log(path) as log:
        for record in log:
            if record.pose is None:
                raise ValueError(f"{path.name} says no poses to compare with")
            if every_scan or not poses or _has_moved(poses[-1], record.pose):
                scans.append(record.scan)
                poses.append(record.pose)
    return ScannedDrive(path.name.split("-corrected")[0], scans, poses)


def drive_in_plan(plan: FloorPlan, poses: Sequence[Pose]) -> ScannedDrive:
    """Simulated scans of a plan, with the sensor's own noise."""
    lidar = Lidar(plan)
    return ScannedDrive(
        plan.name, [lidar.scan(p, key=(0, 0, k)) for k, p in enumerate(poses)], poses
    )


def motions(
    drive: ScannedDrive, seed: int, errors: OdometrySettings = WHEELCHAIR_ODOMETRY
) -> list[Pose]:
    """The motion before each scan by odometry that errs; none before the first."""
    rng = np.random.default_rng(seed)
    biases = np.array((errors.distance_bias, errors.turn_bias, errors.veer_bias))
    scale, turn, veer = (np.array((1.0, 1.0, 0.0)) + biases * rng.normal(size=3)).tolist()
    found = [ORIGIN]
    for a, b in pairwise(drive.poses):
        x, y, heading = relative(a, b)
        way, noise = math.hypot(x, y), rng.normal(size=3)
        stretched = scale + errors.distance_noise * noise[0] / math.sqrt(max(way, 1e-6))
        heading = turn * heading + errors.turn_noise * noise[1] * math.sqrt(abs(heading))
        heading += veer * way + errors.veer_noise * noise[2] * math.sqrt(way)
        found.append((stretched * x, stretched * y, heading))
    return found


def matched_motions(path: Path, wheels: bool) -> tuple[ScannedDrive, list[Pose]]:
    """The motion before each scan of a log by matching scans."""
    drive, odometry, last = drive_of_log(path, every_scan=True), ScanOdometry(), None
    found, before = list[Pose](), ORIGIN
    with open_log(path) as log:
        for record in log:
            moved = relative(last, record.odometry) if wheels and last and record.odometry else None
            last = record.odometry
            pose = odometry.update(record.scan, moved)
            found.append(relative(before, pose))
            before = pose
    return drive, found


def followed(drive: ScannedDrive, moved: Iterable[Pose], landmarks: bool | None) -> list[Pose]:
    """The poses of a drive by odometry, corrected as `CORRECTIONS` says."""
    if landmarks is None:
        return [*itertools.accumulate(moved, compose, initial=drive.poses[0])][1:]
    odometry = CorrectedOdometry(drive.poses[0], landmarks)
    return [odometry.update(s, m) for s, m in zip(drive.scans, moved, strict=True)]


def drift_row(drive: ScannedDrive, found: list[Pose]) -> FloatArray:
    """Errors: median and 90th percentile over 10 m, and of the turn there; mean and largest place.

    Metres and degrees.
    """
    position, angle = stretch_errors(found, drive.poses)
    away = [math.dist(a[:2], b[:2]) for a, b in zip(found, drive.poses, strict=True)]
    return np.array(
        (
            *np.percentile(position, (50, 90)),
            *np.degrees(np.percentile(angle, (50, 90))),
            np.mean(away),
            max(away),
        )
    )


def _has_moved(last: Pose, pose: Pose) -> bool:
    x, y, turn = relative(last, pose)
    return math.hypot(x, y) >= LEAST_MOVE or abs(turn) >= LEAST_TURN
