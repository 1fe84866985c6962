"""Measures of episodes, on numbers that can be checked by hand."""

from __future__ import annotations

import pytest

from semnav_env.agents.evaluation import SUITES, Result, suite, summarise
from semnav_env.commands import parse
from semnav_env.maps import load_floor_plan
from semnav_env.maps.placement import placement_error
from semnav_env.robots import ROBOTS
from semnav_env.verifier import plan_goals


def result(success: bool, path: float, route: float, collisions: int = 0, seed: int = 0) -> Result:
    verdict = "done" if success else "wrong door"
    return Result("stop", seed, success, (verdict,), collisions, 3.0, path, route)


@pytest.mark.parametrize(
    ("success", "path", "route", "spl"),
    [(True, 10.0, 5.0, 0.5), (True, 4.0, 5.0, 1.0), (False, 5.0, 5.0, 0.0), (True, 0.0, 0.0, 1.0)],
)
def test_spl_is_success_weighted_by_path_length(
    success: bool, path: float, route: float, spl: float
) -> None:
    assert result(success, path, route).spl == spl


def test_a_summary_counts_shares_and_names_failures() -> None:
    results = [result(True, 10, 5), result(False, 5, 5, collisions=2, seed=7)]
    summary = summarise("all", results)
    assert (summary.success, summary.contact_free, summary.spl) == (0.5, 0.5, 0.25)
    assert summary.failures == ("seed 7: wrong door",)


@pytest.mark.parametrize("trial", suite("all"), ids=lambda trial: trial.command)
def test_every_trial_is_feasible_from_its_start(trial) -> None:  # type: ignore[no-untyped-def]
    plan = load_floor_plan(trial.floor_plan)
    assert plan_goals(plan, parse(trial.command), trial.pose)
    assert all(placement_error(plan, robot, trial.pose) is None for robot in ROBOTS.values())


def test_the_office_suite_has_twenty_commands_of_one_to_three_clauses() -> None:
    commands = {trial.command for trial in SUITES["office_cross"]}
    clauses = {len(parse(command).clauses) for command in commands}
    assert len(commands) >= 20
    assert clauses == {1, 2, 3}


def test_an_unknown_suite_is_an_error_that_lists_the_known_ones() -> None:
    with pytest.raises(ValueError, match="heidelberg, office_cross, all"):
        suite("moon")
