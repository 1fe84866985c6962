"""An evaluation that ended early goes on, and its file becomes the same."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from semnav_agents.evaluation import run_suite, runner, summarise
from semnav_agents.evaluation.jobs import suite_jobs
from semnav_agents.evaluation.resuming import results_so_far, rows_so_far
from semnav_env.judge.episodes import Expected, load_episodes
from semnav_scripts.main import main
from tests.support.evaluated import statues

WORDS = ["evaluate", "test_infeasible", "--agent", "blind", "--episodes", "5", "--workers", "1"]


@pytest.fixture(autouse=True)
def _quick(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(runner, "make_team", statues)


def evaluated(out: Path, *more: str) -> bytes:
    assert main([*WORDS, "--out", str(out), *more]) == 0
    return out.read_bytes()


@pytest.mark.parametrize("kept", [0, 2, 5])
def test_a_resumed_evaluation_ends_with_the_same_bytes(
    kept: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    whole, said = evaluated(tmp_path / "whole.jsonl"), capsys.readouterr().out
    out = tmp_path / "out.jsonl"
    out.write_bytes(b"".join(whole.splitlines(keepends=True)[:kept]))
    if not kept:
        out.unlink()
    assert evaluated(out, "--resume") == whole
    assert capsys.readouterr().out.replace("out.jsonl", "whole.jsonl") == said


def test_what_a_killed_run_left_is_gone_on_with_and_removed(tmp_path: Path) -> None:
    whole = evaluated(tmp_path / "whole.jsonl")
    part = tmp_path / ".out-0123456789ab.part.jsonl"
    part.write_bytes(b"".join(whole.splitlines(keepends=True)[:3]) + b'{"agent": "bl')
    assert len(rows_so_far(tmp_path / "out.jsonl")) == 3
    assert evaluated(tmp_path / "out.jsonl", "--resume") == whole
    assert not part.exists()


def test_rows_are_read_as_the_results_that_they_were_made_from() -> None:
    episodes = [
        *load_episodes("val_unseen")[:2],
        *load_episodes("test_infeasible")[:2],
    ]
    assert {episode.expected for episode in episodes} == {Expected.FEASIBLE, Expected.INFEASIBLE}
    results = list(run_suite(episodes, "blind", "spot"))
    rows = [json.loads(json.dumps({"agent": "blind"} | result.row())) for result in results]
    again = results_so_far(rows, suite_jobs(episodes), {"agent": "blind"}, Path("out.jsonl"))
    for before, after in zip(results, again, strict=True):
        assert repr(after) == repr(before)
    assert math.isnan(again[-1].metrics.spl)
    assert repr(summarise("all", again)) == repr(summarise("all", results))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"rules": "other"}, "rules is"),
        ({"episode": "test_infeasible-99999"}, "is due"),
        ({"spl": "high"}, "lacks a measure"),
    ],
)
def test_rows_that_were_made_otherwise_are_refused(
    change: dict[str, str],
    message: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    out = tmp_path / "out.jsonl"
    rows = [json.loads(line) for line in evaluated(out).splitlines()]
    changed = "".join(json.dumps(row | change) + "\n" for row in rows[:2])
    out.write_text(changed)
    assert main([*WORDS, "--out", str(out), "--resume"]) == 2
    assert message in capsys.readouterr().err
    assert out.read_text() == changed


@pytest.mark.parametrize("more", [["--recheck"], ["--html", "a.html"], ["--pictures", "a"]])
def test_what_needs_all_drives_is_refused_with_resume(
    more: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main([*WORDS, "--out", "out.jsonl", "--resume", *more]) == 2
    assert main([*WORDS, "--resume"]) == 2
