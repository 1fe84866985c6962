"""`semnav view`: a kept run is driven again, and goes as it went."""

from __future__ import annotations

import gzip
import json
import re
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from semnav_agents.evaluation.kept_results import is_results, read_kept_result
from semnav_agents.evaluation.provenance import rules_fingerprint
from semnav_env.judge.episodes import Episode, find_episode, write_episodes
from semnav_env.world.dynamics import Dynamics
from semnav_scripts import view
from semnav_scripts.main import main
from tests.support.command_line import run
from tests.support.evaluated import Statue

pytest.importorskip("pygame", reason="pictures need the extra `render`")

TRIAL = {
    "agent": "blind",
    "robot": "wheelchair",
    "split": "heidelberg",
    "floor_plan": "heidelberg_hallway",
    "command": "go through the second door on the right",
    "seed": 3,
}
FROZEN = {"agent": "blind", "robot": "spot", "split": "test_real", "episode": "test_real-00130"}


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What `semnav evaluate` keeps of four episodes in which somebody stands still."""
    path: Path = tmp_path_factory.mktemp("kept") / "rows.jsonl"
    words = ["heidelberg", "--agent", "blind", "--seeds", "1", "--out", str(path)]
    assert main(["evaluate", *words]) == 0
    return path


def rows(path: Path, *some: dict[str, Any]) -> Path:
    """A file of such rows, which all failed."""
    lines = (json.dumps({"success": False, **row}) + "\n" for row in some)
    path.write_text("".join(lines))
    return path


def test_a_kept_run_goes_as_it_went(
    capsys: pytest.CaptureFixture[str], results: Path, tmp_path: Path
) -> None:
    """The file alone is its first failure."""
    kept = [json.loads(line) for line in results.read_text().splitlines()]
    number = next(n for n, row in enumerate(kept, 1) if not row["success"])
    for which in (str(results), f"{results}:{number}"):
        code, text, _ = run(capsys, "view", which, "--out", tmp_path / "run.gif", "--json")
        row = json.loads(text)
        assert code == 0
        assert row["notes"] == []
        assert {name: row[name] for name in kept[number - 1] if name in row}.items() <= (
            kept[number - 1] | {"agent": "blind", "robot": "wheelchair"}
        ).items()
    with Image.open(tmp_path / "run.gif") as film:
        assert film.size == (640, 480)


def test_a_run_that_ends_otherwise_is_told(
    capsys: pytest.CaptureFixture[str], results: Path, tmp_path: Path
) -> None:
    row = json.loads(results.read_text().splitlines()[1])
    changed = rows(tmp_path / "changed.jsonl", row | {"verdicts": ["done"], "rules": "0" * 16})
    code, text, _ = run(capsys, "view", changed, "--out", tmp_path / "end.png", "--width", 160)
    assert code == 1
    assert "it ended otherwise than it is kept: done" in text
    assert f"other rules, {'0' * 16}; now {rules_fingerprint()}" in text
    with Image.open(tmp_path / "end.png") as picture:
        assert picture.size == (160, 120)


def test_an_episode_is_viewed_by_its_id_and_from_its_file(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(view, "make_agent", lambda name: Statue())
    file = tmp_path / "one.jsonl"
    write_episodes([find_episode("test_real-00130")], file)
    for which in ("test_real-00130", file, f"{file}:test_real-00130"):
        code, text, _ = run(capsys, "view", which, "--robot", "spot", "--out", tmp_path / "a.png")
        assert code == 0
        assert text.startswith("test_real-00130, agent scripted, robot spot\n")
        assert "stopped short" in text


def test_without_a_file_a_window_shows_the_run(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    modes = []
    usual = view.make_env

    def noted(*arguments: Any) -> Any:
        modes.append(arguments[-1])
        return usual(*arguments[:-1], None)

    monkeypatch.setattr(view, "make_env", noted)
    code, text, _ = run(capsys, "view", rows(tmp_path / "rows.jsonl", TRIAL))
    assert (code, modes) == (0, ["human"])
    assert "wrote" not in text


def test_a_row_says_who_drove_with_what_among_whom(tmp_path: Path) -> None:
    moved = {"pedestrians": 2, "swinging": {"open_for": [1, 2], "closed_for": [4, 10], "rate": 0.5}}
    row = TRIAL | {"dynamics": moved, "lidar": "rplidar_a1", "verdicts": ["wrong door"]}
    kept = read_kept_result(rows(tmp_path / "rows.jsonl", row), "1")
    assert (kept.setup.agent, kept.setup.robot, kept.setup.lidar) == (
        "blind",
        "wheelchair",
        "rplidar_a1",
    )
    assert isinstance(kept.setup.dynamics, Dynamics)
    assert kept.setup.dynamics.pedestrians == 2
    assert kept.setup.dynamics.swinging.open_for == (1.0, 2.0)
    assert (kept.job.name, kept.job.seed) == (TRIAL["command"], 3)


def test_rows_of_the_leaderboard_are_results_too(tmp_path: Path) -> None:
    path = tmp_path / "kept.jsonl.gz"
    path.write_bytes(gzip.compress(json.dumps({"success": True, **FROZEN}).encode() + b"\n"))
    assert is_results(path)
    kept = read_kept_result(path, "test_real-00130")
    assert isinstance(kept.job.trial, Episode)
    assert (kept.job.trial.id, kept.verdicts, kept.success) == ("test_real-00130", (), True)


def test_the_file_of_the_episodes_is_looked_for_beside_the_results(tmp_path: Path) -> None:
    write_episodes([find_episode("test_real-00130")], tmp_path / "mine.jsonl")
    path = rows(tmp_path / "rows.jsonl", FROZEN | {"split": "mine.jsonl"})
    found = read_kept_result(path).job.trial
    assert isinstance(found, Episode)
    assert found.start == find_episode("test_real-00130").start
    (tmp_path / "mine.jsonl").rename(tmp_path / "elsewhere.jsonl")
    with pytest.raises(ValueError, match=r"its episodes are of .*; give --episodes FILE"):
        read_kept_result(path)
    assert read_kept_result(path, "", tmp_path / "elsewhere.jsonl").name == "test_real-00130"


@pytest.mark.parametrize(
    ("row", "message"),
    [
        ({"agent": 3}, "agent is 3, not of type str"),
        ({"success": "no"}, "success is 'no', not of type bool"),
        ({"verdicts": "done"}, "verdicts must be a list"),
        ({"dynamics": {"ghosts": 1}}, "dynamics is {'ghosts': 1}"),
        ({"dynamics": {"pedestrians": -1}}, "dynamics: pedestrians"),
        ({"dynamics": []}, "it must be fields of Dynamics"),
        ({"command": "fly"}, "names no command of heidelberg with a seed"),
        ({"seed": -1}, "names no command of heidelberg with a seed"),
        ({"split": "test_real"}, "episode is None"),
        ({"split": "test_real", "episode": "test_real-99999"}, "no episode 'test_real-99999'"),
        ({"split": "../x", "episode": "x-1"}, "its episodes are of '../x'"),
    ],
)
def test_a_row_that_cannot_be_driven_again_is_refused(
    tmp_path: Path, row: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        read_kept_result(rows(tmp_path / "rows.jsonl", TRIAL | row), "1")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["{rows}:2"], "has no result '2'; give the id of an episode, or a line from 1 to 1"),
        (["{rows}:seven"], "has no result 'seven'"),
        (["{rows}", "--robot", "spot"], "--robot is for episodes; this result is of wheelchair"),
        (["{rows}", "--out", "run.avi"], "must end in .gif, .mp4 or .png"),
        (["{rows}", "--width", "9999"], "--width is 9999; it must be from 160 to 960"),
        (["{rows}", "--speed", "0"], "--speed is 0"),
        (["nowhere.jsonl:3"], "cannot open 'nowhere.jsonl'"),
        (["test_rael-00000"], "no split 'test_rael'"),
        (["test_real-00000", "--episodes", "x.jsonl"], "--episodes is for results"),
        (["{done}"], "nothing failed there"),
        (["{code}"], "of 'antigravity:fly', which is no bundled agent; give --agent"),
        (["{text}"], "is no JSON"),
    ],
)
def test_what_is_no_kept_run_is_refused_in_one_line(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, words: list[str], message: str
) -> None:
    files = {
        "rows": rows(tmp_path / "rows.jsonl", TRIAL),
        "code": rows(tmp_path / "code.jsonl", TRIAL | {"agent": "antigravity:fly"}),
        "done": rows(tmp_path / "done.jsonl", TRIAL | {"success": True}),
        "text": tmp_path / "text.jsonl",
    }
    files["text"].write_text("words\n")
    code, out, said = run(capsys, "view", *(word.format(**files) for word in words))
    assert (code, out) == (2, "")
    assert message in said
    assert said.count("\n") == 1
