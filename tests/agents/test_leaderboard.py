"""The table of agents: what is read, what is counted, and how sure it is."""

from __future__ import annotations

import json
import re
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest

from semnav_agents.evaluation.attempts import Attempt, read_attempts, write_attempts
from semnav_agents.evaluation.leaderboard import Standing, standings
from semnav_agents.evaluation.provenance import UNKNOWN, provenance
from semnav_scripts.main import main

RULES = "0123456789abcdef"
DOCS = Path(__file__).parents[2] / "docs"


def attempts(successes: list[int], clauses: int = 1, **changes: object) -> list[Attempt]:
    drive = "drive", 0, "val_seen", "spot", "", clauses
    first = Attempt(*drive, True, True, 0.0, version="0.2.0", commit="", rules=RULES)
    return [
        replace(first, episode=f"e{clauses}-{k}", success=bool(won), spl=0.5 * won, **changes)  # type: ignore[arg-type]
        for k, won in enumerate(successes)
    ]


def only(rows: list[Standing]) -> Standing:
    [row] = rows
    return row


def test_a_row_has_the_means_of_its_episodes() -> None:
    row = only(standings(attempts([1, 1, 1, 0])))
    assert (row.episodes, row.seeds) == (4, 1)
    assert (row.success.mean, row.contact_free.mean, row.spl.mean) == (0.75, 1.0, 0.375)
    assert row.worst == 0.0
    assert row.interquartile is None


def test_the_interval_of_a_share_is_that_of_the_binomial() -> None:
    """Of 400 episodes with share 0.8 the standard deviation is 0.02."""
    row = only(standings(attempts([1, 1, 1, 1, 0] * 80)))
    assert row.success.low == pytest.approx(0.8 - 1.96 * 0.02, abs=0.006)
    assert row.success.high == pytest.approx(0.8 + 1.96 * 0.02, abs=0.006)


@pytest.mark.parametrize(("won", "interval"), [(0, (0.0, 0.2425)), (1, (0.7575, 1.0))])
def test_the_interval_of_episodes_that_all_agree_is_wilsons(
    won: int, interval: tuple[float, float]
) -> None:
    """Of twelve episodes; a bootstrap would know no spread."""
    row = only(standings(attempts([won] * 12)))
    assert row.success.mean == won
    assert (row.success.low, row.success.high) == pytest.approx(interval, abs=1e-4)


def test_the_bootstrap_is_stratified_by_the_number_of_clauses() -> None:
    """Where two clauses never succeed, only one clause adds to the spread."""
    row = only(standings(attempts([1, 1, 1, 0] * 100) + attempts([0] * 400, clauses=2)))
    half = 1.96 * 0.5 * (0.75 * 0.25 / 400) ** 0.5
    assert row.success.low == pytest.approx(0.375 - half, abs=0.003)
    assert row.success.high == pytest.approx(0.375 + half, abs=0.003)


def test_strata_that_each_agree_have_wilsons_interval() -> None:
    row = only(standings(attempts([1] * 30) + attempts([0] * 10, clauses=2)))
    assert row.success == pytest.approx((0.75, 0.5981, 0.8581), abs=1e-4)


def test_trainings_differ_more_than_episodes_tell() -> None:
    """Two trainings that always and never succeed leave the mean open."""
    won, lost = attempts([1] * 50), attempts([0] * 50, training_seed=1)
    row = only(standings(won + lost))
    assert (row.episodes, row.seeds) == (100, 2)
    assert row.success == (0.5, 0.0, 1.0)


def test_the_interquartile_mean_leaves_the_best_and_the_worst_training_out() -> None:
    shares = (0, 5, 6, 7, 10)
    some = [e for n in shares for e in attempts([1] * n + [0] * (10 - n), training_seed=n)]
    assert only(standings(some)).interquartile == pytest.approx(0.6)


def test_rows_are_sorted_by_success_within_a_split_and_a_body() -> None:
    found = standings(
        attempts([1, 0])
        + attempts([1, 1], agent="scripted")
        + attempts([0, 0], agent="random")
        + attempts([0, 0], robot="wheelchair")
    )
    names = [(row.robot, row.agent) for row in found]
    expected = [("spot", "scripted"), ("spot", "drive"), ("spot", "random")]
    assert names == [*expected, ("wheelchair", "drive")]


def test_the_same_results_give_the_same_table_in_any_order() -> None:
    some = attempts(list(np.random.default_rng(0).integers(0, 2, 60)))
    assert standings(some) == standings(some[::-1])


def test_an_episode_counts_once() -> None:
    with pytest.raises(ValueError, match="drive drove 'e1-0' twice; leave one out"):
        standings(attempts([1]) * 2)


def test_written_attempts_come_back(tmp_path: Path) -> None:
    some, path = attempts([1, 0, 1]), tmp_path / "a.jsonl.gz"
    write_attempts(some, path)
    assert read_attempts(path) == some


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "holds no results"),
        ("{", ":1: is no JSON"),
        ("[]", ":1: is a list; a result is an object"),
        ("{}", ":1: agent is None, not of type str; evaluate anew with --out"),
        (json.dumps(asdict(attempts([1])[0]) | {"success": 1}), ":1: success is 1, not of type"),
    ],
)
def test_a_wrong_file_is_refused_by_line(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "a.jsonl"
    path.write_text(text)
    with pytest.raises(ValueError, match=message):
        read_attempts(path)


def test_a_damaged_compressed_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.jsonl.gz"
    write_attempts(attempts([1] * 50), path)
    path.write_bytes(path.read_bytes()[:-20])
    with pytest.raises(ValueError, match="is not gzip-compressed, or is cut off"):
        read_attempts(path)


def test_what_evaluate_wrote_becomes_a_table(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    out, kept = tmp_path / "random.jsonl", tmp_path / "kept"
    words = ["evaluate", "test_real", "--agent", "random", "--episodes", "2", "--out", str(out)]
    assert main(words) == 0
    capsys.readouterr()
    assert main(["leaderboard", str(out), "--json", "--keep", str(kept)]) == 0
    [row] = json.loads(capsys.readouterr().out)
    assert (row["agent"], row["split"], row["robot"]) == ("random", "test_real", "wheelchair")
    assert (row["episodes"], row["seeds"]) == (2, 1)
    [file] = kept.iterdir()
    assert file.name == "random.test_real.wheelchair.jsonl.gz"
    for words in ([], ["--markdown"]):
        assert main(["leaderboard", str(out), *words]) == 0
        shown = capsys.readouterr().out
        assert main(["leaderboard", str(file), *words]) == 0
        assert capsys.readouterr().out == shown
        assert "test_real" in shown


def test_rows_say_by_which_version_and_rules_they_were_made(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """Also after `--keep`, and in the table."""
    out, kept = tmp_path / "random.jsonl", tmp_path / "kept"
    words = ["evaluate", "test_real", "--agent", "random", "--episodes", "1", "--out", str(out)]
    assert main(words) == 0
    now = provenance().row()
    assert json.loads(out.read_text()).items() >= now.items()
    capsys.readouterr()
    assert main(["leaderboard", str(out), "--json", "--keep", str(kept)]) == 0
    assert json.loads(capsys.readouterr().out)[0].items() >= now.items()
    [file] = kept.iterdir()
    assert [asdict(each).items() >= now.items() for each in read_attempts(file)] == [True]
    assert main(["leaderboard", str(file)]) == 0
    assert f"{now['version']}, {str(now['rules'])[:8]}" in capsys.readouterr().out


def test_rows_that_say_nothing_of_it_are_unknown(tmp_path: Path) -> None:
    path = tmp_path / "old.jsonl"
    row = asdict(attempts([1])[0])
    path.write_text(json.dumps({n: row[n] for n in row if n not in ("version", "commit", "rules")}))
    [old] = read_attempts(path)
    assert (old.version, old.commit, old.rules) == ("unknown, before 0.2", "", UNKNOWN)
    path.write_text(json.dumps({n: row[n] for n in row if n != "rules"}))
    with pytest.raises(ValueError, match=":1: rules is None, not of type str; evaluate anew"):
        read_attempts(path)


def test_different_rules_are_not_compared_unless_asked(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    now, then = tmp_path / "now.jsonl.gz", tmp_path / "then.jsonl.gz"
    write_attempts(attempts([1, 0]), now)
    write_attempts(attempts([1, 1], rules=UNKNOWN, agent="scripted"), then)
    assert main(["leaderboard", str(now), str(then)]) == 2
    said = capsys.readouterr().err
    assert "different rules are not compared unless --mixed is given" in said
    assert f"rules {RULES}: drive (val_seen, spot)" in said
    assert f"rules {UNKNOWN}: scripted (val_seen, spot)" in said
    assert main(["leaderboard", str(now), str(then), "--mixed"]) == 0
    table = capsys.readouterr().out
    assert re.search(r"0\.2\.0, 01234567\ndrive ", table)
    assert re.search(rf"{UNKNOWN}\nscripted ", table)


def test_an_agent_under_other_rules_is_another_row() -> None:
    """It may drive the same episodes again."""
    before, after = standings(attempts([1, 0]) + attempts([1, 1], rules="f" * 16))
    assert (before.rules, before.success.mean) == ("f" * 16, 1.0)
    assert (after.rules, after.success.mean) == (RULES, 0.5)


def test_commits_under_the_same_rules_are_joined() -> None:
    some = zip(attempts([1] * 3), "bab", strict=True)
    row = only(standings([replace(attempt, commit=commit) for attempt, commit in some]))
    assert row.commit == "a, b"


def test_a_run_among_people_is_not_compared_with_runs_without(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    out, moved = tmp_path / "people.jsonl", ["--pedestrians", "2", "--walking.radius", "0.3"]
    words = ["evaluate", "test_real", "--agent", "random", "--episodes", "1", "--out", str(out)]
    assert main([*words, *moved]) == 0
    row = json.loads(out.read_text())
    assert row["dynamics"]["pedestrians"] == 2
    assert set(row["dynamics"]) == {"pedestrians", "walking"}
    capsys.readouterr()
    assert main(["leaderboard", str(out)]) == 2
    assert "people.jsonl:1: was driven with {'pedestrians': 2" in capsys.readouterr().err


@pytest.mark.parametrize("page", ["guides/command_line.md", "guides/leaderboard.md"])
def test_the_documented_agent_is_not_on_the_leaderboard_yet(page: str) -> None:
    """The table takes no episode of an agent twice."""
    text = (DOCS / page).read_text()
    [file] = re.findall(r"semnav leaderboard (\S+) docs/results", text)
    [agent] = re.findall(rf"--agent (\S+) .*--out {file}", text)
    kept = {path.name.split(".")[0].split("-")[0] for path in (DOCS / "results").iterdir()}
    assert agent not in kept
