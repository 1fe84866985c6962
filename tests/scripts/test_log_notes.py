"""Commands on logs say what looks wrong in them, and take poses from where they are told."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from semnav_env.language import parse
from semnav_env.mind.belief.log_following import PoseChoice, follow_log
from semnav_env.world.lidar import Lidar
from semnav_features import Scan
from semnav_features.frames import Pose
from semnav_features.readers import Geometry, open_log
from tests.support.command_line import run
from tests.support.small_plans import empty_hall

BEAMS = ["--beam-spacing", "1"]
SCANS = 24


def carmen_lines(scan: Scan, pose: Pose, odometry: Pose, stamp: float) -> str:
    """A scan of 181 beams, and the odometry before it."""
    numbers = " ".join(f"{r:.3f}" for r in np.minimum(scan.ranges, 60.0))
    where, wheels = (" ".join(map(str, each)) for each in (pose, odometry))
    return (
        f"ODOM {wheels} 0 0 0 {stamp} r {stamp}\n"
        f"FLASER 181 {numbers} {where} {wheels} {stamp} r {stamp}\n"
    )


def write_drive(path: Path, wheels: float = 1.0, blind: int = 0) -> Path:
    """A drive of 2.3 m through an empty hall, looking to the left.

    Args:
        path: to write.
        wheels: share of the distance that the wheels count.
        blind: number of scans in the middle that see nothing.
    """
    lidar = Lidar(empty_hall(), "tim561")
    lines = []
    for k in range(SCANS):
        pose = 0.1 * k - 1.0, 0.2, math.pi / 2
        seen = lidar.scan(pose, key=(1, 2, k))
        directions = np.radians(np.arange(-90.0, 91.0))
        ranges = np.interp(directions, seen.angles, np.minimum(seen.ranges, 60.0))
        if 6 <= k < 6 + blind:
            ranges[:] = 60.0
        scan = Scan(ranges, -math.pi / 2, math.radians(1.0))
        odometry = wheels * 0.1 * k, 0.0, math.pi / 2
        lines.append(carmen_lines(scan, pose, odometry, 100.0 + 0.1 * k))
    path.write_text("".join(lines))
    return path


def last_place(log: Path, poses: PoseChoice | None) -> float:
    """How far the robot believes to have come, metres."""
    with open_log(log, Geometry(beam_spacing=1.0)) as records:
        beliefs = [b for _, b in follow_log(records, parse("stop"), poses=poses)]
    return math.hypot(*beliefs[-1].pose[:2])


@pytest.mark.parametrize("command", ["extract", "follow", "map build"])
def test_every_command_notes_what_looks_wrong(capsys, tmp_path, command) -> None:
    log = write_drive(tmp_path / "drive.log")
    words = [*command.split(), log, *BEAMS, *(["stop"] if command == "follow" else [])]
    words += ["--out", tmp_path / "plan.geojson"] if command == "map build" else []
    assert "note:" not in run(capsys, *words)[2]
    log.write_text(log.read_text().replace("101.2", "51.2"))
    assert "note: line 26: the time falls" in run(capsys, *words)[2]
    if command != "follow":
        (note,) = json.loads(run(capsys, *words, "--json")[1])["notes"]
        assert note.startswith("line 26: the time falls")


def test_a_command_is_followed_by_the_poses_that_are_chosen(tmp_path) -> None:
    """The wheels count a tenth less than the way; the log's poses and the scans all of it."""
    log = write_drive(tmp_path / "drive.log", wheels=0.9)
    assert last_place(log, "log") == pytest.approx(2.3, abs=0.03)
    assert last_place(log, "match") == pytest.approx(2.3, abs=0.03)
    reckoned = last_place(log, None)
    assert reckoned == last_place(log, "odometry")
    assert reckoned != pytest.approx(last_place(log, "log"), abs=1e-6)


def test_a_log_without_wheels_is_not_followed_by_them(capsys, tmp_path) -> None:
    log = write_drive(tmp_path / "drive.log")
    lines = log.read_text().splitlines(keepends=True)
    log.write_text("".join(line for line in lines if line.startswith("FLASER")))
    words = ["follow", log, "stop", *BEAMS, "--poses"]
    assert "has no odometry" in run(capsys, *words, "odometry")[2]
    assert run(capsys, *words, "log")[0] == run(capsys, *words, "match")[0]


@pytest.mark.parametrize("command", ["follow", "map build"])
def test_scans_that_are_not_matched_end_with_1_and_one_line(capsys, tmp_path, command) -> None:
    words = ["stop"] if command == "follow" else ["--out", tmp_path / "plan.geojson"]
    few, many = (write_drive(tmp_path / f"{n}.log", blind=n) for n in (1, 9))
    options = [*words, "--poses", "match", *BEAMS]
    assert "found no match, so that" not in run(capsys, *command.split(), few, *options)[2]
    code, _, said = run(capsys, *command.split(), many, *options)
    assert code == 1
    assert re.fullmatch(r"\d+ of 24 scans found no match, so that their poses are not .*\n", said)
