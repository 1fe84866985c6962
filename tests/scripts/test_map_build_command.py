"""`semnav map build`: scans that are matched, with wheels to help."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest

from semnav_env.world.maps import load_floor_plan
from semnav_features import Scan
from semnav_features.frames import compose, relative
from semnav_features.mapping import ScanOdometry
from semnav_features.mapping.matched_log import matched
from semnav_features.readers import LogRecord
from tests.support.command_line import run

ANGLES = np.linspace(-math.pi, math.pi, 720, endpoint=False)


def corridor(heading: float, seed: int) -> Scan:
    """An endless corridor along x, 2 m wide, seen from its middle."""
    ranges = 1.0 / np.maximum(np.abs(np.sin(ANGLES + heading)), 1e-9)
    ranges += np.random.default_rng(seed).normal(0.0, 0.01, len(ranges))
    return Scan(ranges, ANGLES[0], ANGLES[1] - ANGLES[0], range_max=10.0)


@pytest.mark.parametrize("mount", [(0.0, 0.0, 0.0), (0.3, 0.1, math.pi), (0.2, 0.0, math.pi / 2)])
def test_wheels_help_a_lidar_however_it_is_mounted(mount) -> None:
    """Along the corridor the scans say nothing, so that the wheels alone tell how far."""
    drive = [(0.1 * k, 0.0, 0.0) for k in range(20)]
    records = [LogRecord(corridor(mount[2], k), None, pose, k) for k, pose in enumerate(drive)]
    poses = [pose for _, pose in matched(iter(records), ScanOdometry(), mount)]
    expected = relative(mount, compose(drive[-1], mount))
    assert poses[-1] == pytest.approx(expected, abs=0.05)


def carmen_line(k: int, scan: Scan) -> str:
    """What a robot with a lidar that looks back sends after 0.2 k metres."""
    numbers = " ".join(f"{r:.3f}" for r in np.minimum(scan.ranges, 20.0))
    return f"ODOM {0.2 * k} 0 0 0 0 0 0 r 0\nFLASER 720 {numbers} 0 0 0 0 0 0 0 r 0\n"


def test_a_map_says_how_many_scans_were_not_matched_and_knows_the_mount(capsys, tmp_path) -> None:
    log, out = tmp_path / "drive.log", tmp_path / "plan.geojson"
    nothing = Scan(np.full(len(ANGLES), 20.0), 0.0, 0.01)
    scans = [nothing if k in (3, 4) else corridor(math.pi, k) for k in range(20)]
    log.write_text("".join(map(carmen_line, range(20), scans)))
    words = ["map", "build", log, "--out", out, "--poses", "match", "--beam-spacing", "0.5"]
    words += ["--range-max", "6", "--mount", f"0,0,{math.pi}"]
    assert "\n2 scans found no match and count as moved as guessed\n" in run(capsys, *words)[1]
    along = load_floor_plan(out).segments.reshape(-1, 2)[:, 0]
    assert -10.0 < along.min() < -8.0
    assert 4.0 < along.max() < 6.0
    assert json.loads(run(capsys, *words, "--json")[1])["lost"] == 2
    assert "found no match" not in run(capsys, *words, "--limit", "3")[1]
