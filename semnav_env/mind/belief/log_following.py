"""Follows a command on a recorded log: the belief that the robot would have had at every scan."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from typing import Literal, TypeAlias

from semnav_env.language import Command
from semnav_env.mind.belief.belief import Belief
from semnav_env.mind.belief.tracker import NO_WAYS, BeliefTracker
from semnav_env.mind.grounding.ways import Way
from semnav_features import ExtractorSettings, Scan
from semnav_features.frames import ORIGIN, Pose, compose, relative, wrap_angle
from semnav_features.lidar_spec import LidarSpec, most_beams
from semnav_features.mapping import ScanOdometry
from semnav_features.mapping.matched_log import matched
from semnav_features.readers import LogError, LogRecord

PoseChoice: TypeAlias = Literal["log", "odometry", "match"]
"""Source of a robot's poses: the poses of the log, its odometry, or its scans."""


def follow_log(
    records: Iterable[LogRecord],
    command: Command,
    ways: Mapping[int, Way] = NO_WAYS,
    mount: Pose = ORIGIN,
    extractor: ExtractorSettings = ExtractorSettings(),
    corrects_drift: bool = True,
    poses: PoseChoice | None = None,
    matcher: ScanOdometry | None = None,
) -> Iterator[tuple[LogRecord, Belief]]:
    """Yield the records of a log, each with the belief after it.

    The origin of the odom frame is the pose of the first record with a pose. Records before it are
    skipped, because a bag may begin with scans.

    Args:
        records: of a log, in order.
        command: the command of the robot.
        ways: ways to the named rooms of the command, see `BeliefTracker.begin`.
        mount: pose of the lidar in the robot frame.
        extractor: limits of the feature extractor.
        corrects_drift: whether walls that are seen again correct the odometry.
        poses: "odometry" takes the odometry of all records, "log" their poses, and "match" matches
            each scan with the earlier ones. None decides by the first record and prefers odometry;
            the two are not mixed, because they may have different origins.
        matcher: the scan odometry for "match", without a scan so far; a new one if None.

    Raises:
        LogError: a record has no pose, or scans of several lidars are mixed.
    """
    if poses == "match":
        placed = _matched(records, matcher or ScanOdometry(), mount)
    else:
        placed = _as_recorded(records, mount, poses)
    tracker: BeliefTracker | None = None
    start, last = ORIGIN, None
    for record, robot in placed:
        if tracker is None:
            tracker = BeliefTracker(lidar_of(record.scan), mount, extractor, corrects_drift)
            tracker.begin(command, ways)
            start = robot
        ranges = record.scan.ranges[: tracker.lidar.beams]
        if len(ranges) != tracker.lidar.beams:
            raise LogError(
                f"scan {record.line} has {len(ranges)} beams and the first one "
                f"{tracker.lidar.beams}: give the topic of one lidar"
            )
        _check_directions(record, tracker.lidar)
        seconds = _elapsed(last, record.stamp)
        yield record, tracker.update(ranges, relative(start, robot), seconds=seconds)
        last = record.stamp


def lidar_of(scan: Scan, rate_hz: float = 15.0) -> LidarSpec:
    """The specification of the lidar of a scan; beams beyond a full turn are left out.

    Args:
        scan: a scan of that lidar.
        rate_hz: scans per second, if the log has no times.
    """
    return LidarSpec(
        "log",
        min(len(scan.ranges), most_beams(scan.angle_increment)),
        wrap_angle(scan.angle_min),
        scan.angle_increment,
        scan.range_min,
        scan.range_max,
        rate_hz,
    )


def _check_directions(record: LogRecord, lidar: LidarSpec) -> None:
    """Refuse a scan whose first or last beam has another direction than in the first scan.

    Raises:
        LogError: the directions differ by more than the angle between two beams.
    """
    scan, step = record.scan, lidar.angle_increment
    turned = wrap_angle(scan.angle_min - lidar.angle_min)
    widened = (scan.angle_increment - step) * (lidar.beams - 1)
    if max(abs(turned), abs(turned + widened)) > step:
        raise LogError(
            f"scan {record.line} begins at {scan.angle_min:.4g} rad in steps of "
            f"{scan.angle_increment:.4g}, and the first one at {lidar.angle_min:.4g} in steps of "
            f"{step:.4g}: follow the scans of one lidar, which always looks the same way"
        )


def _matched(
    records: Iterable[LogRecord], matcher: ScanOdometry, mount: Pose
) -> Iterator[tuple[LogRecord, Pose]]:
    """The records with poses of the robot from their scans."""
    for record, lidar in matched(records, matcher, mount):
        yield record, compose(lidar, relative(mount, ORIGIN))


def _as_recorded(
    records: Iterable[LogRecord], mount: Pose, poses: Literal["log", "odometry"] | None
) -> Iterator[tuple[LogRecord, Pose]]:
    """The records from the first one with a pose on, with poses of the robot."""
    lost: LogRecord | None = None
    remaining = iter(records)
    for record in remaining:
        if _source_of(record, poses):
            by_odometry = _source_of(record, poses) == "odometry"
            for each in chain([record], remaining):
                yield each, _robot_pose(each, mount, by_odometry)
            return
        lost = lost or record
    if lost is not None:
        _robot_pose(lost, mount, poses != "log")


def _source_of(record: LogRecord, chosen: PoseChoice | None) -> PoseChoice | None:
    """Source of the poses of a log with this first record; None if it has no pose."""
    if chosen != "log" and record.odometry is not None:
        return "odometry"
    return "log" if chosen != "odometry" and record.pose is not None else None


def _robot_pose(record: LogRecord, mount: Pose, by_odometry: bool) -> Pose:
    given = record.odometry if by_odometry else record.pose
    if given is None:
        raise LogError(
            f"scan {record.line} has no {'odometry' if by_odometry else 'pose'}: a command needs "
            "odometry at every scan, or a pose at every scan; find them with --poses match"
        )
    return given if by_odometry else compose(given, relative(mount, ORIGIN))


def _elapsed(before: float | None, now: float | None) -> float | None:
    """Seconds between two stamps; None if they do not determine it."""
    if before is None or now is None or not now > before:
        return None
    return now - before
