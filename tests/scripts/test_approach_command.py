"""`semnav approach`: the poses before a door, on the command line."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from semnav_scripts.main import main
from tests.approach.test_thesis_tables import DOORS, TABLE_7_2


def said(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str]:
    code = main(["approach", "--map", "villa_hall", *words])
    output = capsys.readouterr()
    return code, output.out or output.err


def test_the_poses_are_printed_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    code, text = said(capsys, "--door", "parents", "--json")
    found = json.loads(text)
    assert code == 0
    assert (found["evaluated"], found["clear_of_walls"], found["safe"]) == (25, 5, 3)
    first, *rest = found["poses"]
    assert (first["x"], first["y"]) == (-5.57, 4.35)
    assert first["heading"] == pytest.approx(math.pi, abs=1e-4)
    assert first["refusal"] is None
    assert len(rest) == 4
    assert len(found["refused"]) == 20
    assert all(each["refusal"] for each in found["refused"])
    assert found["after"]["x"] < -6.2


@pytest.mark.parametrize("door", DOORS)
def test_in_her_hall_the_command_prints_the_table_of_mes(
    capsys: pytest.CaptureFixture[str], door: str
) -> None:
    poses = json.loads(said(capsys, "--door", door, "--json")[1])["poses"]
    for (_, _, _, area_error, angle_error), found in zip(TABLE_7_2[door], poses, strict=False):
        assert found["area_error"] == pytest.approx(area_error, abs=1e-4)
        if angle_error is not None:
            assert found["angle_error"] == pytest.approx(angle_error, abs=0.01)


@pytest.mark.parametrize("more", [("--obstacle", "-3,4.3,0.1"), ("--from", "1.3,2,0")], ids=str)
def test_elsewhere_the_command_measures_angles_right(
    capsys: pytest.CaptureFixture[str], more: tuple[str, ...]
) -> None:
    """At (1.35, 0.63) the kitchen's door is straight ahead at -pi/2."""
    poses = json.loads(said(capsys, "--door", "kitchen", "--json", *more)[1])["poses"]
    straight = [each for each in poses if (each["x"], each["y"]) == (1.35, 0.63)]
    assert len(straight) == 5
    for each in straight:
        off = abs(math.remainder(each["heading"] + math.pi / 2, math.tau))
        assert each["angle_error"] == pytest.approx(off, abs=1e-4)


def test_the_text_tells_the_safe_ellipse_from_the_safe_body(
    capsys: pytest.CaptureFixture[str],
) -> None:
    _, text = said(capsys, "--door", "parents")
    assert "3 safe for the ellipse, 1 of these for the whole body" in text
    assert text.count("safe for the ellipse, but a corner of the body touches a wall") == 2


def test_robot_start_obstacle_and_picture_are_taken(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    picture = tmp_path / "new" / "poses.png"
    words = ("--door", "kitchen", "--robot", "wheelchair", "--from=-0.5,-2,0")
    code, text = said(capsys, *words, "--obstacle", "1.35,-1,0.2", "--plot", str(picture))
    assert code == 0
    assert "y, m" in text
    assert all(float(line.split()[1]) < 0.0 for line in text.splitlines()[3:-1])
    assert picture.stat().st_size > 10_000


def test_without_a_pose_the_exit_code_is_1(capsys: pytest.CaptureFixture[str]) -> None:
    code, text = said(capsys, "--door", "kitchen", "--obstacle", "1.35,0.6,0.8")
    assert code == 1
    assert "no pose lets the body stand before the door" in text


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--door", "attic"), "has no door 'attic'; there are: parents, living"),
        (("--door", "kitchen", "--from", "0,0"), "is not x,y,heading"),
        (("--door", "kitchen", "--from=0,0,0"), "pose 0,0,0: a spot at"),
        (("--door", "kitchen", "--obstacle", "1,2"), "is not x,y,radius"),
        (("--door", "kitchen", "--obstacle", "1,2,0"), "radius more than 0"),
        (("--door", "kitchen", "--obstacle", "nan,2,1"), "is not x,y,radius"),
        (("--door", "kitchen", "--robot", "car"), "no robot named 'car'"),
        (("--door", "kitchen", "--plot", "poses.txt"), "poses.txt"),
        ((), "--door"),
    ],
)
def test_bad_input_is_named(
    capsys: pytest.CaptureFixture[str], words: tuple[str, ...], message: str
) -> None:
    code, text = said(capsys, *words)
    assert code == 2
    assert message in text
    assert text.count("\n") == 1
