"""Two agents are compared on the same episodes, and only on them."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from semnav_agents.evaluation.attempts import Attempt, write_attempts
from semnav_agents.evaluation.comparison import compare
from semnav_agents.evaluation.intervals import paired_interval, sign_test
from semnav_scripts.main import main

RULES = "0123456789abcdef"


def attempts(successes: list[int], agent: str = "drive", **changes: object) -> list[Attempt]:
    first = Attempt(
        agent, -1, "val_seen", "spot", "", 1, True, True, 0.0, "0.2.0", commit="", rules=RULES
    )
    return [
        replace(first, episode=f"e{k:03}", success=bool(won), spl=0.5 * won, **changes)  # type: ignore[arg-type]
        for k, won in enumerate(successes)
    ]


@pytest.mark.parametrize(
    ("counts", "interval"),
    [
        ((36, 12, 2, 0), (0.0569, 0.3404)),
        ((20, 12, 2, 16), (0.0562, 0.3292)),
        ((1, 1, 7, 12), (-0.507, -0.026)),
    ],
)
def test_the_interval_of_a_difference_is_newcombes(
    counts: tuple[int, int, int, int], interval: tuple[float, float]
) -> None:
    """The first two are examples of Newcombe 1998, the third is one of Fagerland et al. 2014."""
    assert paired_interval(*counts) == pytest.approx(interval, abs=5e-4)


@pytest.mark.parametrize("both", range(4))
@pytest.mark.parametrize("first", range(4))
@pytest.mark.parametrize("second", range(4))
def test_exchanging_the_agents_mirrors_the_interval(both: int, first: int, second: int) -> None:
    low, high = paired_interval(both, first, second, 1)
    assert paired_interval(both, second, first, 1) == pytest.approx((-high, -low))
    assert -1.0 <= low <= (first - second) / (both + first + second + 1) <= high <= 1.0


def test_the_sign_test_counts_coins_that_fall_as_unevenly() -> None:
    rng = np.random.default_rng(0)
    heads = rng.integers(0, 2, (200_000, 12)).sum(axis=1)
    for better in range(13):
        share = np.mean(np.abs(heads - 6) >= abs(better - 6))
        assert sign_test(better, 12 - better) == pytest.approx(share, abs=0.005)


def test_agents_that_never_differ_have_a_p_value_of_one() -> None:
    [found] = compare(attempts([1, 0, 1]), attempts([1, 0, 1], agent="scripted"))
    success = found.measures["success"]
    assert (success.difference.mean, success.p_value) == (0.0, 1.0)
    assert success.difference.low < 0.0 < success.difference.high


def test_each_measure_is_compared_episode_by_episode() -> None:
    [found] = compare(attempts([1, 1, 1, 0]), attempts([0, 0, 1, 1], agent="scripted"))
    assert (found.split, found.robot, found.episodes) == ("val_seen", "spot", 4)
    assert found.agents == ("drive", "scripted")
    assert (found.only_first, found.only_second) == (("e000", "e001"), ("e003",))
    success, spl = found.measures["success"], found.measures["spl"]
    assert (success.first, success.second, success.difference.mean) == (0.75, 0.5, 0.25)
    assert (success.first_better, success.second_better, success.p_value) == (2, 1, 1.0)
    assert spl.difference.mean == 0.125


def test_the_order_of_episodes_does_not_matter() -> None:
    first, second = attempts([1, 0, 0, 1, 1]), attempts([0, 0, 1, 1, 0], agent="scripted")
    assert compare(first[::-1], second) == compare(first, second)


def test_a_mean_difference_lies_within_resampled_episodes() -> None:
    """Of 400 differences of 0 or 0.5, half of them each, the mean deviates by 0.0125."""
    [found] = compare(attempts([1, 0] * 200), attempts([0, 0] * 200))
    low, high = found.measures["spl"].difference[1:]
    assert (low, high) == pytest.approx((0.25 - 1.96 * 0.0125, 0.25 + 1.96 * 0.0125), abs=0.003)


def test_spl_is_left_out_where_an_episode_has_none() -> None:
    impossible = [replace(each, spl=float("nan")) for each in attempts([1, 1])]
    assert [*compare(impossible, impossible)[0].measures] == ["success", "contact_free"]


@pytest.mark.parametrize(
    ("second", "message"),
    [
        (attempts([1, 1]), "2 of 3 and 2 are in both; only the first has the episode of val_seen"),
        (attempts([1] * 4), "only the second has the episode of val_seen with spot 'e003'"),
        (attempts([1] * 3, robot="wheelchair"), "the first has the split and body val_seen, spot"),
        (attempts([1] * 3, version="0.3.0"), "different versions .* with 0.2.0, drive with 0.3.0"),
        (attempts([1] * 3, rules="f" * 16), "different rules are not compared unless --mixed"),
        (attempts([1]) * 2, "drive drove 'e000' twice; compare one training at a time"),
    ],
)
def test_what_is_not_comparable_is_refused(second: list[Attempt], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        compare(attempts([1, 0, 1]), second)


def test_mixed_versions_are_compared_on_request() -> None:
    [found] = compare(attempts([1]), attempts([1], version="0.3.0", rules="f" * 16), mixed=True)
    assert found.versions == ("0.2.0", "0.3.0")


def test_the_command_prints_the_comparison(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    files = tmp_path / "a.jsonl.gz", tmp_path / "b.jsonl.gz"
    write_attempts(attempts([1] * 30), files[0])
    write_attempts(attempts([1] * 24 + [0] * 6, agent="scripted"), files[1])
    words = ["leaderboard", "--compare", *map(str, files)]
    assert main(words) == 0
    shown = capsys.readouterr().out
    assert max(map(len, shown.splitlines())) <= 80
    assert "val_seen, spot, 30 episodes, 0.2.0, rules 01234567" in shown
    assert "+0.200" in shown
    assert "0.031" in shown
    assert main([*words, "--json"]) == 0
    [row] = json.loads(capsys.readouterr().out)
    assert row["measures"]["success"]["difference"][0] == pytest.approx(0.2)
    assert row["only_first"] == [f"e{k:03}" for k in range(24, 30)]


def test_the_command_refuses_other_episodes_in_one_line(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    files = tmp_path / "a.jsonl.gz", tmp_path / "b.jsonl.gz"
    write_attempts(attempts([1]), files[0])
    write_attempts(attempts([1, 1]), files[1])
    words = ["leaderboard", "--compare", *map(str, files)]
    assert main(words) == 2
    assert "only the same episodes are compared: 1 of 1 and 2" in capsys.readouterr().err
    assert main([*words, "--markdown"]) == 2
    assert "--compare takes two files" in capsys.readouterr().err
