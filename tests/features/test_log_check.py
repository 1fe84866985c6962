"""What looks wrong in a log as a whole is noted, with where it begins and a cure; no more is."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

from semnav_features import Scan
from semnav_features.frames import Pose
from semnav_features.readers import LogCheck, LogRecord, open_log
from semnav_features.readers.log_check import PoseSource
from tests.support.paths import DATA

REAL_LOGS = (*sorted(DATA.glob("carmen/*.log.gz")), *DATA.glob("breezyslam/*.dat.gz"))


def drive(scans: int = 200, distance: float = 0.1) -> list[LogRecord]:
    """A robot on a circle of 5 m in a room of 20 m, at 1 m/s, with a scan every 0.1 s."""
    return [_record(k, distance) for k in range(scans)]


def _record(k: int, distance: float) -> LogRecord:
    angle = distance * k / 5.0
    pose = 5.0 * math.sin(angle), -5.0 * math.cos(angle), math.remainder(angle, math.tau)
    directions = pose[2] + np.radians(np.arange(360.0))
    with np.errstate(divide="ignore"):
        along = [
            (10.0 - np.sign(part) * place) / np.abs(part)
            for place, part in zip(pose[:2], (np.cos(directions), np.sin(directions)), strict=True)
        ]
    scan = Scan(np.minimum(*along), 0.0, math.radians(1.0), range_max=50.0, stamp=100.0 + 0.1 * k)
    return LogRecord(scan, pose, pose, k + 1)


def notes(records: Sequence[LogRecord], uses: Sequence[PoseSource] = ("pose",)) -> list[str]:
    check = LogCheck("line", uses)
    assert list(check.watched(records)) == list(records)
    return check.notes()


def moved(records: Sequence[LogRecord], change: Callable[[int, Pose], Pose]) -> list[LogRecord]:
    poses = [record.pose or (0.0, 0.0, 0.0) for record in records]
    changed = [change(k, pose) for k, pose in enumerate(poses)]
    return [replace(r, pose=p, odometry=p) for r, p in zip(records, changed, strict=True)]


def rescanned(
    records: Sequence[LogRecord], stamp: Callable[[int, float], float], factor: float = 1.0
) -> list[LogRecord]:
    return [
        replace(
            r,
            scan=Scan(
                factor * r.scan.ranges,
                0.0,
                r.scan.angle_increment,
                range_max=50.0,
                stamp=stamp(k, r.stamp or 0.0),
            ),
        )
        for k, r in enumerate(records)
    ]


def test_a_sound_drive_is_not_noted() -> None:
    assert notes(drive(), ("pose", "odometry")) == []


@pytest.mark.skipif(not REAL_LOGS, reason="no recorded logs beside the checkout")
@pytest.mark.parametrize("path", REAL_LOGS, ids=lambda path: path.name)
def test_a_real_log_is_not_noted_but_for_a_time_that_truly_stands(path: Path) -> None:
    """The times of csail were written with six digits, 1.13486e+09, so that they stand."""
    with open_log(path) as log:
        found = LogCheck(log.unit)
        for _ in found.watched(islice(log, 1200)):
            pass
    stands = ["line 184: the time stands for 365 scans"] if "csail" in path.name else []
    assert [note.partition(";")[0] for note in found.notes()] == stands


def test_headings_in_degrees_are_noted() -> None:
    (note,) = notes(moved(drive(), lambda _, p: (p[0], p[1], math.degrees(p[2]))))
    assert note.startswith("line 7: the heading of the pose fits the way it moves only in degrees")


def test_headings_that_were_not_wrapped_are_not_noted() -> None:
    assert notes(moved(drive(800), lambda k, p: (p[0], p[1], 0.02 * k))) == []


@pytest.mark.parametrize("heading", [0.0, 90.0])
def test_a_straight_drive_has_no_unit_of_its_heading(heading: float) -> None:
    """A heading that never changes does as well in degrees: the map is turned as a whole."""
    assert notes(moved(drive(), lambda k, p: (0.05 * k, 0.0, heading))) == []


@pytest.mark.parametrize(("factor", "size"), [(100.0, "10 m in 0.1 s"), (1000.0, "100 m in 0.1 s")])
def test_poses_in_centimetres_are_noted(factor: float, size: str) -> None:
    (note,) = notes(moved(drive(), lambda _, p: (factor * p[0], factor * p[1], p[2])))
    assert note.startswith(
        f"line 2: the pose jumps by {size}, and so do most; it must be in metres"
    )


def test_ranges_in_centimetres_are_noted() -> None:
    (note,) = notes(rescanned(drive(), lambda _, stamp: stamp, 40.0))
    assert note.startswith("line 1: most ranges lie beyond 50 m")
    assert "in 200 of 200 scans" in note
    assert "divide centimetres by 100" in note


def test_a_jump_is_noted_once() -> None:
    (note,) = notes(moved(drive(), lambda k, p: (p[0] + 500.0 * (k > 100), p[1], p[2])))
    assert note.startswith("line 102: the pose jumps by 500")
    (note,) = notes(moved(drive(), lambda k, p: (p[0] + 500.0 * (k == 100), p[1], p[2])))
    assert "(the first of 2 jumps)" in note


def test_times_that_fall_or_stand_are_noted() -> None:
    (note,) = notes(rescanned(drive(), lambda k, stamp: stamp - 5.0 * (k > 100)))
    assert note.startswith("line 102: the time falls (the first of 1 falls in 200 scans")
    (note,) = notes(rescanned(drive(), lambda k, stamp: 1000.0 - stamp))
    assert note.startswith("line 2: the time falls (the first of 199 falls")
    (note,) = notes(rescanned(drive(), lambda k, stamp: min(stamp, 110.0)))
    assert note.startswith("line 101: the time stands for 100 scans")


def test_times_that_are_not_set_or_fall_by_a_little_once_are_not_noted() -> None:
    assert notes(rescanned(drive(), lambda *_: 0.0)) == []
    assert notes(rescanned(drive(), lambda k, stamp: stamp - 0.5 * (k > 100))) == []


def test_odometry_that_stands_while_the_robot_drives_is_noted() -> None:
    frozen = moved(drive(), lambda k, p: (1.0, 2.0, 0.3))
    (note,) = notes(frozen, ("odometry",))
    assert note.startswith("line 1: the odometry stands still while the scans change")
    assert notes(rescanned(200 * frozen[:1], lambda k, stamp: stamp + 0.1 * k)) == []
