"""A command followed on a recorded log: what the robot would have believed at every scan."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from semnav_env.belief.belief import Belief
from semnav_env.belief.tracker import NO_WAYS, BeliefTracker
from semnav_env.commands import Command
from semnav_env.features import ExtractorSettings, Scan
from semnav_env.features.frames import ORIGIN, Pose, compose, relative, wrap_angle
from semnav_env.features.lidar_spec import LidarSpec, most_beams
from semnav_env.features.readers import LogError, LogRecord
from semnav_env.grounding.ways import Way


def follow_log(
    records: Iterable[LogRecord],
    command: Command,
    ways: Mapping[int, Way] = NO_WAYS,
    mount: Pose = ORIGIN,
    extractor: ExtractorSettings = ExtractorSettings(),
    corrects_drift: bool = True,
) -> Iterator[tuple[LogRecord, Belief]]:
    """The records of a log, each with the belief after it.

    The odometry frame begins at the first record that says where it was taken; those before it
    are passed over, as a bag may begin with scans. If that one has no odometry, the poses of all
    records count instead: the two may have been counted from different places.

    Args:
        records: of a log, in order.
        command: that the robot is told at the beginning.
        ways: to the named rooms of the command, see `BeliefTracker.begin`.
        mount: pose of the lidar in the robot frame.
        extractor: limits of the feature extractor.
        corrects_drift: whether walls that are seen again correct the odometry.

    Raises:
        LogError: a record does not say where it was taken, or scans of several lidars are mixed.
    """
    tracker: BeliefTracker | None = None
    start, last, by_odometry = ORIGIN, None, True
    lost: LogRecord | None = None
    for record in records:
        if tracker is None:
            if record.odometry is None and record.pose is None:
                lost = lost or record
                continue
            by_odometry = record.odometry is not None
        robot = _robot_pose(record, mount, by_odometry)
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
    if tracker is None and lost is not None:
        _robot_pose(lost, mount, by_odometry)


def lidar_of(scan: Scan, rate_hz: float = 15.0) -> LidarSpec:
    """The lidar that takes such scans; beams beyond a full turn are left out.

    Args:
        scan: of that lidar.
        rate_hz: sweeps per second, where the log has no times.
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
    """Refuse a scan whose first or last beam points elsewhere than that of the first scan.

    Raises:
        LogError: by more than the angle between two beams.
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


def _robot_pose(record: LogRecord, mount: Pose, by_odometry: bool) -> Pose:
    given = record.odometry if by_odometry else record.pose
    if given is None:
        raise LogError(
            f"scan {record.line} has no {'odometry' if by_odometry else 'pose'}: a command needs "
            "odometry at every scan, or a pose at every scan"
        )
    return given if by_odometry else compose(given, relative(mount, ORIGIN))


def _elapsed(before: float | None, now: float | None) -> float | None:
    """Seconds between two stamps; None where they do not tell."""
    if before is None or now is None or not now > before:
        return None
    return now - before
