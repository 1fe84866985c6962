"""`semnav approach`: the poses before a door, on the command line."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from semnav_env.scripts.main import main


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
        (("--door", "kitchen", "--obstacle", "nan,2,1"), "must be finite"),
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
