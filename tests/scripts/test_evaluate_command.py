"""`semnav evaluate`, and `semnav demo` of an episode that it drives."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from semnav_agents.evaluation import misreading, runner
from semnav_agents.evaluation.intervals import wilson_interval
from semnav_agents.evaluation.provenance import provenance
from semnav_agents.evaluation.suites import Trial
from semnav_env.judge.episodes import (
    Expected,
    find_episode,
    load_episodes,
    write_episodes,
)
from semnav_env.judge.metrics.final_belief import FinalBelief
from semnav_env.world.maps import load_floor_plan
from semnav_scripts.main import main
from tests.support.evaluated import Statue, result, statues

TWENTIETH = {"command": "take the twentieth door", "language": "en"}


def test_evaluate_reports_shares_causes_and_failures(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An agent that stands still fails every episode, and both judges say so."""
    monkeypatch.setattr(runner, "make_team", statues)
    out, pictures = tmp_path / "out.jsonl", tmp_path / "pictures"
    words = ["heidelberg", "--seeds", "1", "--recheck", "--pictures", str(pictures)]
    assert main(["evaluate", *words, "--out", str(out)]) == 0
    text = capsys.readouterr().out
    assert "second opinion: 0 of 4 episodes judged differently" in text
    assert "stopped short (not done: the first door on the right" in text
    assert "drew 4 failures" in text
    for picture in pictures.iterdir():
        with Image.open(picture) as image:
            assert min(image.size) > 300
    assert len(list(pictures.iterdir())) == 4
    rows = [json.loads(line) for line in out.read_text().splitlines()]
    assert {row["goal_distance"] > 1.0 for row in rows} == {True}
    assert main(["evaluate", *words[:3], "--json"]) == 0
    *_, everything = json.loads(capsys.readouterr().out)
    assert everything["episodes"] == 4
    assert everything["cvar"]["10%"]["clauses"] == everything["success"] == 0.0


def test_where_nothing_failed_no_picture_is_spoken_of(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    trial = Trial("plan", "stop", (0.0, 0.0, 0.0))
    done = replace(result(True), group=trial.group)
    monkeypatch.setattr("semnav_scripts.evaluate.suite", lambda _: [trial])
    monkeypatch.setattr("semnav_scripts.evaluate.run_suite", lambda *_: iter([done]))
    assert main(["evaluate", "--pictures", str(tmp_path / "pictures")]) == 0
    assert capsys.readouterr().out.endswith("nothing failed, so there are no pictures\n")


def test_more_episodes_than_there_are_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "test_real", "--episodes", "201"]) == 2
    assert "--episodes is 201; test_real has 200" in capsys.readouterr().err


def test_a_suite_has_seeds_and_no_episodes(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["evaluate", "heidelberg", "--episodes", "3"]) == 2
    assert "give a suite --seeds" in capsys.readouterr().err


@pytest.mark.parametrize("words", [("--seeds", "5"), ("--first-seed", "3")])
def test_a_split_has_episodes_and_no_seeds(
    capsys: pytest.CaptureFixture[str], words: tuple[str, ...]
) -> None:
    assert main(["evaluate", "test_real", *words]) == 2
    assert f"{words[0]} is for suites; give a split --episodes" in capsys.readouterr().err


def test_a_split_is_evaluated_by_number_of_clauses(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Failures are named by their episodes."""
    monkeypatch.setattr(runner, "make_team", statues)
    out = tmp_path / "out.jsonl"
    words = ["test_real", "--episodes", "2", "--pictures", str(tmp_path), "--out", str(out)]
    assert main(["evaluate", *words, "--recheck"]) == 0
    text = capsys.readouterr().out
    assert '1 x stopped short, clause "go to door"' in text
    assert "test_real-00100" in text
    assert "clause" in text
    assert "second opinion: 0 of 2" in text
    assert len(list(tmp_path.glob("*test_real_00000*.png"))) == 1
    rows = [json.loads(line) for line in out.read_text().splitlines()]
    assert [row["episode"] for row in rows] == ["test_real-00000", "test_real-00100"]


def test_the_output_says_who_drove_where_and_how_sure_it_is(
    capsys: pytest.CaptureFixture[str],
) -> None:
    words = ["evaluate", "test_real", "--episodes", "2", "--robot", "spot", "--agent", "blind"]
    assert main([*words, "--json"]) == 0
    *_, everything = json.loads(capsys.readouterr().out)
    who = {"agent": "blind", "robot": "spot", "split": "test_real"}
    assert everything.items() >= (who | provenance().row()).items()
    low, high = everything["intervals"]["success"]
    assert (low, high) == wilson_interval(everything["success"], 2)
    assert main(words) == 0
    first, second, third, *_ = capsys.readouterr().out.splitlines()
    assert first == "agent blind, robot spot, test_real, 2 episodes"
    assert second.startswith(f"semnav-env {provenance().version}")
    assert second.endswith(f"rules {provenance().rules}")
    assert third.endswith(f"(95 % interval {low:.3f} to {high:.3f}, Wilson)")


def test_a_failure_is_filmed_and_its_picture_shows_what_was_believed(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(runner, "make_team", statues)
    shown: list[FinalBelief] = []
    monkeypatch.setattr(
        "semnav_env.judge.metrics.picture.draw_belief", lambda _, it: shown.append(it)
    )
    folders = ["--films", str(tmp_path / "films"), "--pictures", str(tmp_path / "pictures")]
    assert main(["evaluate", "test_real", "--episodes", "1", *folders]) == 0
    assert "filmed 1 failure into" in capsys.readouterr().out
    [film] = (tmp_path / "films").iterdir()
    assert film.stem == next((tmp_path / "pictures").iterdir()).stem
    with Image.open(film) as image:
        assert image.size == (960, 720)
    [belief] = shown
    plan = load_floor_plan("heidelberg_hallway")
    assert belief.doors
    for door in belief.doors:  # the statue observes the truth, so it remembers doors of the plan
        assert min(math.dist(door.midpoint, each.midpoint) for each in plan.doors) < 0.2


def test_a_demo_of_an_episode_is_what_evaluate_drives(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file, out = tmp_path / "one.jsonl", tmp_path / "out.jsonl"
    write_episodes([find_episode("test_real-00130")], file)
    assert main(["evaluate", str(file), "--agent", "blind", "--out", str(out)]) == 0
    row = json.loads(out.read_text())
    capsys.readouterr()
    for name in ("test_real-00130", f"{file}:test_real-00130"):
        code = main(["demo", "--episode", name, "--agent", "blind", "--json"])
        shown = json.loads(capsys.readouterr().out)
        assert code == (0 if row["success"] else 1)
        assert shown["verdicts"] == row["verdicts"]
        assert shown["path_length"] == round(row["path_length"], 3)
        assert shown["seconds"] == round(row["seconds"], 2)


def test_a_demo_of_an_impossible_episode_succeeds_by_saying_so(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["demo", "--episode", "test_infeasible-00000"]) == 0
    said = capsys.readouterr().out
    assert "der Roboter hielt den Befehl für unmöglich: die vierte Tür" in said


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--episode", "test_real-00200"], "there are: test_real-00000 to test_real-00199"),
        (["--episode", "test_rael-00000"], "no split 'test_rael'"),
        (["--episode", "seven"], "no split 'seven'"),
        (["stop", "--episode", "test_real-00000"], "leave out command 'stop'"),
        (["--episode", "test_real-00000", "--seed", "1"], "leave out --seed 1"),
        ([], "give a command for the robot, or --episode ID"),
    ],
)
def test_a_demo_has_a_command_or_an_episode(
    capsys: pytest.CaptureFixture[str], words: list[str], message: str
) -> None:
    assert main(["demo", *words]) == 2
    assert message in capsys.readouterr().err


def test_an_interrupted_evaluation_keeps_driven_episodes(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(runner, "make_team", statues)
    together = runner.drive_together

    def impatient(*arguments: Any) -> Any:
        yield from islice(together(*arguments), 2)
        raise KeyboardInterrupt

    monkeypatch.setattr(runner, "drive_together", impatient)
    out = tmp_path / "out.jsonl"
    assert main(["evaluate", "test_real", "--episodes", "4", "--out", str(out)]) == 130
    rows = [json.loads(line) for line in out.read_text().splitlines()]
    assert [row["episode"] for row in rows] == ["test_real-00000", "test_real-00050"]


def test_standing_still_is_no_answer_unless_the_robot_says_why(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """On the truth the robot knows at once that a one-clause command is impossible, and says so."""
    monkeypatch.setattr(runner, "make_team", statues)
    file = tmp_path / "short.jsonl"
    write_episodes([e for e in load_episodes("test_infeasible") if e.clauses == 1][:1], file)
    assert main(["evaluate", str(file), "--json"]) == 0
    *_, everything = json.loads(capsys.readouterr().out)
    assert (everything["success"], everything["failures"]) == (1.0, [])
    episode = replace(load_episodes("test_real")[0], expected=Expected.INFEASIBLE)
    [result] = runner.run_suite([episode], Statue, "wheelchair")
    assert not result.success
    assert "did not say that it is impossible" in result.cause


def test_an_infeasible_command_has_no_path_to_weigh_success_by(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """SPL and SDTW are left blank, and the oracle's success is no less than success."""
    monkeypatch.setattr(runner, "make_team", statues)
    file, out = tmp_path / "short.jsonl", tmp_path / "out.jsonl"
    write_episodes([e for e in load_episodes("test_infeasible") if e.clauses == 1][:1], file)
    assert main(["evaluate", str(file), "--json", "--out", str(out)]) == 0
    *_, mean = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    [row] = [json.loads(line, parse_constant=pytest.fail) for line in out.read_text().splitlines()]
    for told in (mean, mean["cvar"]["5%"], row):
        assert told["spl"] is None
        assert told["sdtw"] is None
        assert told["oracle_success"] == told["success"] == 1.0
    assert main(["evaluate", str(file)]) == 0
    assert "nan" not in capsys.readouterr().out
    assert main(["leaderboard", str(out), "--json", "--keep", str(tmp_path)]) == 0
    assert json.loads(capsys.readouterr().out, parse_constant=pytest.fail)[0]["spl"] is None
    assert main(["leaderboard", *map(str, tmp_path.glob("*.gz"))]) == 0
    assert "nan" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("changed", "why", "workers"),
    [
        (TWENTIETH, "no twentieth door: .* after [0-9]+", 1),
        (TWENTIETH, "no twentieth door: .* after [0-9]+", 2),
        ({"readings": ("sing a song",)}, "these are not the canonical words of a command", 1),
    ],
)
def test_an_episode_that_cannot_be_begun_is_named(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, changed: Any, why: str, workers: int
) -> None:
    file = tmp_path / "wrong.jsonl"
    write_episodes(
        [replace(load_episodes("test_real")[7], programs=(), token_rows=(), **changed)], file
    )
    words = ["evaluate", str(file), "--agent", "oracle", "--workers", str(workers)]
    assert main(words) == 2
    last = capsys.readouterr().err.splitlines()[-1]
    assert re.fullmatch(f"semnav: {why}; episode test_real-00007", last)


def test_an_ambiguous_command_needs_all_its_readings(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["evaluate", "test_ambiguous", "--episodes", "20"]) == 0
    assert re.search("1[0-9] of 20 understood|20 of 20", capsys.readouterr().out)
    episode = load_episodes("test_ambiguous")[0]
    assert "taken for" in misreading(
        replace(episode, readings=episode.readings[:1] * 2, programs=())
    )
    assert "not understood" in misreading(replace(episode, command="fly to the moon"))
