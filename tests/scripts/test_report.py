"""`semnav evaluate --html`: one file with the tables and the failures, which plays them."""

from __future__ import annotations

import json
import re
from collections import Counter
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_agents.evaluation import Result, runner, summarise
from semnav_agents.evaluation.kept_drive import MAX_MOMENTS, keep
from semnav_agents.evaluation.results import short_cause
from semnav_env.judge.metrics import Recording
from semnav_env.robots import robot_spec
from semnav_env.world.maps import load_floor_plan
from semnav_scripts.main import main
from semnav_scripts.report.gallery import MAX_SHOWN, chosen, without_excess
from semnav_scripts.report.html_report import save_report
from tests.support.evaluated import result, statues
from tests.support.kept_drives import MOMENTS, failure

WHO = {"agent": "blind", "training_seed": -1, "split": "heidelberg", "robot": "spot"}
MADE_BY = {"version": "0.2.0", "commit": "", "rules": "0" * 16}


def report(path: Path, *results: Result) -> str:
    """The text of a report on some results."""
    everything = summarise("all", results)
    save_report(path, WHO | MADE_BY, [everything], everything, results)
    return path.read_text("utf-8")


def data(page: str) -> dict[str, Any]:
    """What the page draws."""
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>', page)
    assert found
    document: dict[str, Any] = json.loads(found[1])
    return document


def test_a_report_says_why_each_episode_failed_and_keeps_its_drive(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(runner, "make_team", statues)
    path = tmp_path / "new" / "report.html"
    assert main(["evaluate", "heidelberg", "--seeds", "1", "--html", str(path)]) == 0
    assert capsys.readouterr().out.endswith(f"wrote {path}\n")
    page = path.read_text("utf-8")
    assert page.count("<article") == len(data(page)["drives"]) == 4
    assert "not done: the first door on the right" in page
    assert "95 % interval" in page
    assert len(data(page)["plans"]) == len(data(page)["bodies"]) == 1


def test_a_report_loads_nothing_from_elsewhere(tmp_path: Path) -> None:
    page = report(tmp_path / "report.html", failure()).replace("http://www.w3.org/2000/svg", "")
    assert not re.search(r"https?://|url\(|@import", page)
    assert "default-src 'none'" in page


def test_words_of_a_report_are_no_markup(tmp_path: Path) -> None:
    evil = "</script><script>alert(1)</script>"
    page = report(tmp_path / "report.html", failure(cause=evil), failure(kind=evil))
    assert evil not in page
    assert "&lt;/script&gt;&lt;script&gt;alert(1)" in page


def test_the_drive_of_a_report_is_in_whole_centimetres(tmp_path: Path) -> None:
    [drive] = data(report(tmp_path / "report.html", failure()))["drives"]
    assert (drive["x"][0], drive["y"][0], drive["heading"][0]) == (-250, -30, 240)
    assert len(drive["x"]) == len(drive["people"]) == MOMENTS
    assert drive["touched"] == [MOMENTS // 2]
    assert drive["people"][0] == [0, 50, 25]


def test_a_report_of_successes_says_that_nothing_failed(tmp_path: Path) -> None:
    page = report(tmp_path / "report.html", result(True))
    assert "Nothing failed." in page
    assert "<article" not in page


def test_a_report_shows_a_bounded_number_of_failures(tmp_path: Path) -> None:
    page = report(tmp_path / "report.html", *(failure(seed) for seed in range(MAX_SHOWN + 5)))
    assert page.count("<article") == MAX_SHOWN
    assert f"{MAX_SHOWN} of them are shown" in page
    assert len(page) < 200_000


@given(st.lists(st.sampled_from(("Turn", "Wait", "GoToDoor", "")), max_size=3 * MAX_SHOWN))
def test_every_cause_is_shown_and_few_drives_are_kept(kinds: list[str]) -> None:
    made = failure()
    results = [SimpleNamespace(**{**vars(made), "kind": kind}) for kind in kinds]
    found = chosen(results)  # type: ignore[arg-type]
    assert len(found) == min(len(kinds), MAX_SHOWN)
    assert {short_cause(each) for each in found} == {short_cause(each) for each in results}  # type: ignore[arg-type]


def test_of_each_cause_a_bounded_number_of_drives_is_kept() -> None:
    kinds = ["Turn"] * (MAX_SHOWN + 3) + ["Wait"] * 2
    left = list(without_excess(failure(kind=kind) for kind in kinds))
    assert [each.kind for each in left] == kinds
    kept = Counter(each.kind for each in left if each.kept is not None)
    assert kept == {"Turn": MAX_SHOWN, "Wait": 2}


@given(st.lists(st.integers(0, 2), min_size=1, max_size=4 * MAX_MOMENTS))
def test_no_contact_is_lost_in_the_moments_that_are_kept(contacts: list[int]) -> None:
    count = len(contacts)
    poses = np.column_stack((np.arange(count), np.zeros((count, 2)))).astype(float)
    nothing = np.zeros(count)
    recording = Recording(poses, np.zeros((count, 3)), np.array(contacts), nothing, 0.1)
    plan = load_floor_plan("heidelberg_hallway")
    said = SimpleNamespace(clauses=("stop",))
    mission = SimpleNamespace(floor_plan=plan, command=said, route=poses[:, :2], goals=())
    kept = keep(recording, SimpleNamespace(mission=mission), robot_spec("spot"), None)  # type: ignore[arg-type]
    assert len(kept.poses) == min(count, MAX_MOMENTS)
    assert (kept.poses[0] == poses[0]).all()
    assert (kept.poses[-1] == poses[-1]).all()
    rows = kept.poses[:, 0].astype(int)
    spans = zip([-1, *rows[:-1]], rows, strict=True)
    assert kept.touched.tolist() == [any(contacts[a + 1 : b + 1]) for a, b in spans]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["heidelberg", "--html", "report.txt"], "must end in .html"),
        (["heidelberg", "--html", "a.html", "--out", "a.html"], "--html: 'a.html' is --out, too"),
        (["test_ambiguous", "--html", "a.html"], "--html shows drives"),
    ],
)
def test_what_can_be_no_report_is_refused(
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    words: list[str],
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["evaluate", *words]) == 2
    assert message in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []
