"""Options of all commands on logs, for what the logs leave unsaid of their beams."""

from __future__ import annotations

import gzip
import json

import numpy as np
import pytest

from tests.support.command_line import run

RANGES = 1.0 / np.maximum(np.abs(np.sin(np.radians(np.arange(-80.0, 80.1, 2.0)))), 0.1)
"""Metres, as 81 beams two degrees apart see a corridor."""


@pytest.mark.parametrize("command", ["extract", "follow", "map build"])
@pytest.mark.parametrize("kind", ["csv", "log"])
def test_logs_without_angles_take_the_same_options_everywhere(capsys, tmp_path, command, kind):
    path = tmp_path / f"scans.{kind}"
    numbers = [f"{r:.2f}" for r in RANGES]
    if kind == "csv":
        header = ",".join(["x", "y", "theta", *(f"r{k}" for k in range(len(numbers)))])
        rows = [header, *(f"{0.1 * k},0,0,{','.join(numbers)}" for k in range(4))]
        said = ["--angle-min", "-1.396263", "--angle-increment", "0.034907"]
    else:
        rows = [f"FLASER 81 {' '.join(numbers)} {0.1 * k} 0 0 0 0 0 0 r 0" for k in range(4)]
        said = ["--beam-spacing", "2"]
    path.write_text("\n".join(rows) + "\n")
    words = [*command.split(), path, *(["turn around"] if command == "follow" else [])]
    words += ["--out", tmp_path / "plan.geojson"] if command == "map build" else []
    assert run(capsys, *words)[0] == 2
    code, text, _ = run(capsys, *words, *said)
    assert (code, bool(text)) == (1 if command == "follow" else 0, True)


@pytest.fixture
def drive(tmp_path):
    """A log of a straight drive of 2 m along a corridor, with one line that is cut."""
    numbers = " ".join(f"{r:.2f}" for r in RANGES)
    rows = [f"FLASER 81 {numbers} {0.1 * k} 0 0 0 0 0 0 r 0\n" for k in range(20)]
    path = tmp_path / "drive.log.gz"
    path.write_bytes(gzip.compress("".join([*rows, "FLASER 81 1\n", *rows[-2:]]).encode()))
    return path


def test_lines_that_could_not_be_read_are_counted_everywhere(capsys, tmp_path, drive):
    said = (
        "1 bad lines\n  1 x FLASER: fewer fields than its count of beams asks for (first: line 21)"
    )
    beams = ["--beam-spacing", "2"]
    build = ["map", "build", drive, "--out", tmp_path / "plan.geojson", *beams]
    assert said in run(capsys, *build)[1]
    assert sum(json.loads(run(capsys, *build, "--json")[1])["bad_lines"].values()) == 1
    assert said in run(capsys, "follow", drive, "turn around", *beams)[2]
    assert "bad line" not in run(capsys, "follow", drive, "turn around", "--limit", "9", *beams)[2]


def test_a_log_that_is_cut_short_is_followed_to_its_end(capsys, tmp_path, drive):
    whole, picture = drive.read_bytes(), tmp_path / "belief.png"
    drive.write_bytes(whole[:-30])
    words = ["follow", drive, "turn around", "--beam-spacing", "2", "--plot", picture]
    code, out, err = run(capsys, *words)
    assert (code, out.splitlines()[-2:]) == (
        2,
        ["believed to be done: 0 of 1 clauses", f"wrote {picture}"],
    )
    assert "is truncated or damaged: its data could be read up to scan" in err
    assert picture.stat().st_size > 0


def test_what_the_geometry_of_a_log_cannot_be_is_named(capsys, tmp_path):
    code, _, err = run(capsys, "follow", tmp_path / "a.log", "turn around", "--range-max", "-1")
    assert code == 2
    assert "range_max is -1.0; it must be a number from 0.01 to 1000 m" in err
