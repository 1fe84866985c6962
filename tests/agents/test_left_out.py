"""Episodes whose command is void where doors have changed are left out, and counted."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from semnav_agents.evaluation import LeftOut, Trial, run_suite
from semnav_env.judge.episodes import Episode, find_episode, write_episodes
from semnav_env.mind.grounding import GroundingError
from semnav_env.world.dynamics import Dynamics
from semnav_scripts.main import main
from tests.support.evaluated import Statue

CHANGING = Dynamics(changing_doors=0.3)
VOID, PLAIN = "val_unseen-00760", ("val_unseen-00000", "val_unseen-00010")
"""An episode that says "leave the room" where a second door swings, and two others."""


def episodes(*names: str) -> list[Episode]:
    return [find_episode(name) for name in names]


@pytest.mark.parametrize("order", [(VOID, *PLAIN), (*PLAIN, VOID), (VOID, PLAIN[0], VOID)])
def test_an_episode_that_cannot_begin_is_left_out_and_the_others_are_driven(
    order: tuple[str, ...],
) -> None:
    left_out: list[LeftOut] = []
    some = episodes(*order)
    results = list(run_suite(some, Statue, "wheelchair", dynamics=CHANGING, left_out=left_out))
    assert [result.episode for result in results] == [name for name in order if name != VOID]
    assert [each.episode for each in left_out] == [VOID] * order.count(VOID)
    assert "by which door?" in left_out[0].why


def test_results_beside_an_episode_that_is_left_out_are_those_without_it() -> None:
    with_it, left_out = episodes(VOID, *PLAIN), list[LeftOut]()
    beside = list(run_suite(with_it, Statue, "wheelchair", dynamics=CHANGING, left_out=left_out))
    assert beside == list(run_suite(episodes(*PLAIN), Statue, "wheelchair", dynamics=CHANGING))


def test_without_a_list_for_it_an_episode_that_cannot_begin_is_an_error() -> None:
    with pytest.raises(ValueError, match=f"{VOID}.*by which door"):
        list(run_suite(episodes(VOID), Statue, "wheelchair", dynamics=CHANGING))


def test_in_an_unchanged_world_a_void_command_is_an_error() -> None:
    """Then the episode itself is wrong, and nothing is to be hidden."""
    void = Trial("heidelberg_hallway", "go through the ninth door on the left", (-2.5, -0.3, 0.24))
    with pytest.raises(GroundingError):
        list(run_suite([void], Statue, "wheelchair", (0,), left_out=[]))


def test_the_evaluation_says_how_many_were_left_out_and_which(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, out = tmp_path / "some.jsonl", tmp_path / "out.jsonl"
    write_episodes(episodes(VOID, PLAIN[0]), file)
    words = ["evaluate", str(file), "--agent", "blind", "--changing-doors", "0.3"]
    assert main([*words, "--out", str(out)]) == 0
    said = capsys.readouterr().out
    assert "1 episode\n" in said
    assert "1 more episode was left out" in said
    assert f"left out: {VOID}" in said
    driven, other = map(json.loads, out.read_text().splitlines())
    assert (driven["episode"], other["episode"]) == (PLAIN[0], VOID)
    assert "by which door?" in other["left_out"]
    assert main([*words, "--json"]) == 0
    *_, everything = json.loads(capsys.readouterr().out)
    assert (everything["episodes"], everything["left_out"]) == (1, 1)


def test_an_evaluation_in_which_no_episode_can_begin_says_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "void.jsonl"
    write_episodes(episodes(VOID), file)
    assert main(["evaluate", str(file), "--agent", "blind", "--changing-doors", "0.3"]) == 2
    assert "no episode could begin; the first: " in capsys.readouterr().err
