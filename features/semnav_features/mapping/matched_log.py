"""A log whose scans are placed by matching them, and by what they show again."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from semnav_features.frames import Pose, compose, relative
from semnav_features.mapping.corrected_odometry import CorrectedOdometry
from semnav_features.mapping.odometry import ScanOdometry
from semnav_features.readers import LogRecord

MAX_LOST, MAX_LOST_SHARE = 2, 0.05
"""Number and share of scans without a match beyond which the poses are unreliable: for a scan
without a match the guess is taken, and its error adds to all later poses. Of the logs in
docs/guides/mapping.md one loses more, and drifts five times as far as the others."""


def matched(
    records: Iterable[LogRecord], odometry: ScanOdometry, mount: Pose
) -> Iterator[tuple[LogRecord, Pose]]:
    """The records with poses of the lidar from their scans, in the frame of the first scan.

    Each scan is matched with the ones just before (`ScanOdometry`), and the drift that is left is
    corrected by walls, corners and columns that were seen long before (`CorrectedOdometry`).

    Args:
        records: of a log, in order.
        odometry: the scan odometry, without a scan so far.
        mount: pose of the lidar on the robot, whose motion wheel odometry gives.
    """
    wheels: Pose | None = None
    corrected, before = CorrectedOdometry(), odometry.pose
    for record in records:
        lidar = compose(record.odometry, mount) if record.odometry else None
        moved = relative(wheels, lidar) if wheels and lidar else None
        wheels = lidar
        matched_pose = odometry.update(record.scan, moved)
        yield record, corrected.update(record.scan, relative(before, matched_pose))
        before = matched_pose


def loss_of(odometry: ScanOdometry, scans: int) -> str:
    """The reason why poses are unreliable, with advice; empty if they are reliable."""
    if odometry.lost <= max(MAX_LOST, MAX_LOST_SHARE * scans):
        return ""
    return (
        f"{odometry.lost} of {scans} scans found no match, so that their poses are not to be "
        "trusted; give every scan, the odometry of the wheels, or poses (--poses log)"
    )
