"""A command followed on a log: where the robot was, and with which lidar."""

from __future__ import annotations

import math

import numpy as np
import pytest

from semnav_env.language import parse
from semnav_env.mind.belief.log_following import follow_log, lidar_of
from semnav_features import Scan
from semnav_features.frames import Pose, compose
from semnav_features.lidar_spec import LidarSpec
from semnav_features.readers import LogError, LogRecord

BACKWARDS = (0.2, 0.1, math.pi)
"""A mount of the lidar."""


def record(line: int, pose: Pose | None, odometry: Pose | None) -> LogRecord:
    """A scan without returns."""
    return LogRecord(Scan(np.full(181, np.nan), -math.pi / 2, math.pi / 180), pose, odometry, line)


def driven(k: int) -> Pose:
    """Where the robot is at scan k, in the frame of its start."""
    return 0.1 * k, 0.0, 0.0


def poses(log: list[LogRecord]) -> list[Pose]:
    """Where the robot believed to be."""
    followed = follow_log(log, parse("turn around"), mount=BACKWARDS, corrects_drift=False)
    return [belief.pose for _, belief in followed]


def test_a_log_whose_odometry_begins_late_is_followed_by_its_poses() -> None:
    """The frames of the two need not agree, so that the first record says which is taken."""
    seen = [compose((20.0, 30.0, 1.5), compose(driven(k), BACKWARDS)) for k in range(6)]
    late = [record(k + 1, seen[k], driven(k) if k else None) for k in range(6)]
    np.testing.assert_allclose(poses(late), [driven(k) for k in range(6)], atol=1e-9)


def test_odometry_goes_before_poses() -> None:
    both = [record(k + 1, (9.0 * k, 0.0, 0.0), driven(k)) for k in range(6)]
    np.testing.assert_allclose(poses(both), [driven(k) for k in range(6)], atol=1e-9)


def test_scans_before_the_first_odometry_are_passed_over() -> None:
    log = [record(k + 1, None, driven(k) if k > 1 else None) for k in range(6)]
    np.testing.assert_allclose(poses(log), [driven(k) for k in range(4)], atol=1e-9)


@pytest.mark.parametrize("first", [(None, None), (driven(0), None), (None, driven(0))])
def test_a_scan_that_does_not_say_where_it_was_taken_is_an_error(first) -> None:
    with pytest.raises(
        LogError, match=r"has no (odometry|pose): a command needs odometry at every"
    ):
        poses([record(1, *first), record(2, first[1], first[0])])


@pytest.mark.parametrize("angles", [(math.pi / 2, 0.01), (-math.pi / 2, 0.02), (0.0, 0.01)])
def test_scans_that_look_elsewhere_than_the_first_are_refused(angles: tuple[float, float]) -> None:
    """As those of a second lidar at the back of the robot, with as many beams."""
    scans = [Scan(np.full(181, np.nan), *each) for each in ((-math.pi / 2, 0.01), angles)]
    with pytest.raises(LogError, match=r"scan 2 begins at .* follow the scans of one lidar"):
        poses([LogRecord(scan, driven(k), None, k + 1) for k, scan in enumerate(scans)])


@pytest.mark.parametrize("beams", [8, 77, 360, 431, 720, 862, 1440, 3000])
@pytest.mark.parametrize("repeated", [0, 1, 3])
@pytest.mark.parametrize("rounded", [float, np.float32, np.float16])
def test_a_rounded_full_circle_has_a_lidar(beams: int, repeated: int, rounded: type) -> None:
    """Of repeated beams at most the first stays, whichever way the increment was rounded."""
    increment = float(rounded(math.tau / beams))
    spec = lidar_of(Scan(np.full(beams + repeated, 2.0), -math.pi, increment))
    assert (spec.beams - 1) * spec.angle_increment == pytest.approx(math.tau, rel=2.0 / beams)
    if rounded is not np.float16:
        assert spec.beams == beams + min(repeated, 1)


def test_a_lidar_sees_a_full_turn_at_most() -> None:
    assert LidarSpec("full", 721, 0.0, math.radians(0.5)).beams == 721
    with pytest.raises(ValueError, match="at most 2 pi"):
        LidarSpec("more", 722, 0.0, math.radians(0.5))
