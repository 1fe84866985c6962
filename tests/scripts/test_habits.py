"""`semnav habits`: how drivers pass doorways, from logs and episodes."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import load_floor_plan
from semnav_scripts.main import main


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A drive through the south door of the hallway, 3 cm to the right of its middle."""
    plan = load_floor_plan("heidelberg_hallway")
    door = next(each for each in plan.doors if each.name == "south_1")
    along = np.subtract(door.end, door.start) / door.width
    through = np.array((along[1], -along[0]))  # out of the hallway
    lidar, lines = Lidar(plan), []
    for k in range(50):
        x, y = np.array(door.midpoint) + (-1.2 + 0.04 * k) * through - 0.03 * along
        pose = float(x), float(y), float(np.arctan2(through[1], through[0]))
        half_turn = lidar.scan(pose, key=(1, 2, k)).ranges[135::3][:181]
        ranges = " ".join(f"{r:.3f}" for r in half_turn)
        place = " ".join(f"{value:.4f}" for value in pose)
        lines.append(f"FLASER 181 {ranges} {place} {place} {k / 10} robot {k / 10}\n")
    path = tmp_path_factory.mktemp("habits") / "drive.log"
    path.write_text("".join(lines))
    return path


def test_a_drive_through_a_door_is_one_passage(
    log: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["habits", str(log), "--beam-spacing", "1.0", "--json"]
    assert main([*words, "--plot", str(tmp_path / "h.png")]) == 0
    (passage,) = json.loads(capsys.readouterr().out)["drive.log"]["passages"]
    assert passage["angle"] == pytest.approx(0.0, abs=0.1)
    assert passage["offset"] == pytest.approx(-0.03, abs=0.06)
    assert passage["speed"] == pytest.approx(0.4, abs=0.01)
    assert (tmp_path / "h.png").stat().st_size > 1000


def test_agents_are_measured_beside_one_another(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--agents", "oracle", "random", "--count", "4", "--json"]
    main(["habits", "--episodes", "val_seen", *words])
    said = json.loads(capsys.readouterr().out)
    assert set(said) == {"oracle", "random"}
    assert said["oracle"]["habits"]["passages"] >= 1


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ([], "give a log, or --episodes"),
        (["--episodes", "val_seen", "--count", "0"], "--count is 0"),
        (["a.log", "--limit", "0"], "--limit is 0"),
        (["a.log", "--plot", "a.txt"], "must end in .png, .pdf or .svg"),
        (["none.log"], "none.log"),
    ],
)
def test_bad_input_gets_one_line(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["habits", *words]) == 2
    assert said in capsys.readouterr().err
