"""Measures of episodes, on numbers that can be checked by hand, and the suites they are of."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from semnav_agents.evaluation import SUITES, runner, suite, summarise, usual_agent
from semnav_agents.evaluation.drive import drive
from semnav_agents.evaluation.jobs import TRIAL_SECONDS, SuiteJob
from semnav_agents.evaluation.suites import Trial
from semnav_agents.hearing.agent import HearingAgent
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.judge import plan_goals
from semnav_env.judge.episodes import (
    StaleEpisodeError,
    load_episodes,
)
from semnav_env.judge.metrics import METRIC_NAMES
from semnav_env.language import parse
from semnav_env.language.finding_clauses import FindingClause
from semnav_env.rescue.environment import MAX_SEARCH_SECONDS, search_and_rescue
from semnav_env.robots import ROBOTS
from semnav_env.world.dynamics import NO_DYNAMICS
from semnav_env.world.dynamics.victims import victims_of
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.placement import placement_error
from semnav_features.frames import compose, relative, to_parent
from tests.support.evaluated import Statue, result


def test_a_summary_has_means_and_the_worst_and_names_failures() -> None:
    results = [result(True), result(False, collisions=2, seed=7, rechecked="done")]
    summary = summarise("all", results)
    row = summary.row()
    assert (row["success"], row["contact_free"], row["spl"], row["collisions"]) == (
        0.5,
        0.5,
        0.5,
        1,
    )
    assert row["cvar"]["5%"]["success"] == 0.0
    assert row["cvar"]["5%"]["collisions"] == 2.0
    assert row["failures"] == ["seed 7: wrong door (crossed a, wanted b)"]
    assert row["disagreements"] == 1


def test_the_row_of_an_episode_is_flat_json() -> None:
    row = json.loads(json.dumps(result(True).row()))
    assert row["success"] is True
    assert set(METRIC_NAMES) < set(row)


@pytest.mark.parametrize("trial", suite("all"), ids=lambda trial: trial.command)
def test_every_trial_is_feasible_from_its_start(trial) -> None:  # type: ignore[no-untyped-def]
    plan = load_floor_plan(trial.floor_plan)
    assert plan_goals(plan, parse(trial.command, rooms=plan.room_names), trial.pose)
    assert all(placement_error(plan, robot, trial.pose) is None for robot in ROBOTS.values())


def test_the_office_suite_has_one_to_three_clauses() -> None:
    commands = {trial.command for trial in SUITES["office_cross"]}
    clauses = {len(parse(command).clauses) for command in commands}
    assert len(commands) >= 20
    assert clauses == {1, 2, 3}


def test_the_suites_of_the_villa_have_a_hundred_episodes_each_with_ten_seeds() -> None:
    names = ("villa_doors", "villa_turns", "villa_rooms", "villa_exits")
    assert [len(suite(name)) for name in names] == [10, 10, 10, 10]
    assert suite("villa") == tuple(trial for name in names for trial in suite(name))
    assert not any(trial.is_search for trial in suite("all"))


def test_a_suite_of_searches_is_driven_by_the_searcher_if_none_is_named() -> None:
    assert usual_agent(suite("villa_search")) == "searcher"
    assert usual_agent(suite("villa")) == "scripted"
    assert usual_agent(load_episodes("test_real")) == "scripted"


def test_a_search_has_its_own_time_limit_and_two_victims() -> None:
    [trial, *_] = suite("villa_search")
    [result] = runner.run_suite([trial], Statue, "spot", (0,))
    assert result.verdicts == ("incomplete",)
    assert result.cause.startswith("not done in full: search the house")
    assert SuiteJob(trial, 0).max_seconds == MAX_SEARCH_SECONDS
    assert SuiteJob(suite("villa")[0], 0).max_seconds == TRIAL_SECONDS


def test_the_suite_of_finding_has_a_hundred_episodes_with_five_seeds() -> None:
    trials = suite("villa_find")
    assert len({trial.group for trial in trials}) == len(trials) == 20
    assert usual_agent(trials) == "finder"
    rooms = load_floor_plan("villa_hall").room_names
    for trial in trials:
        assert any(isinstance(c, FindingClause) for c in parse(trial.command, "en", rooms).clauses)


@pytest.mark.parametrize("robot", ["spot", "wheelchair"])
def test_the_person_to_be_found_lies_in_the_room_that_the_trial_names(robot: str) -> None:
    env = search_and_rescue("raw", robot=robot, dynamics=NO_DYNAMICS)
    for trial in suite("villa_find"):
        plan = SuiteJob(trial, 1).options(env)["floor_plan"]
        [person] = victims_of(plan)
        room = next(each for each in plan.rooms if each.name == trial.person_in)
        assert room.polygon.contains(person.centroid)


def test_an_unknown_suite_is_an_error_that_lists_the_known_ones() -> None:
    with pytest.raises(ValueError, match=r"office_cross, villa_doors, .*, villa, all, and the sp"):
        suite("moon")


def test_a_listener_is_drawn_with_the_goal_that_it_found_itself() -> None:
    agent = make_agent("listener")
    env = SemNavEnv(observation=agent.observation, max_seconds=2.0)
    episode = load_episodes("test_real")[0]
    driven = drive(env, agent, episode.number, {"episode": episode})
    assert isinstance(agent, HearingAgent)
    odometry_frame = compose(env.world.pose, relative(env.belief.pose, (0.0, 0.0, 0.0)))
    assert driven.belief is not None
    assert driven.belief.goal == to_parent(odometry_frame, agent.own_goal()[:2])


def test_an_episode_that_names_itself_is_named_once() -> None:
    stale = replace(load_episodes("test_real")[7], plan_hash="0" * 16)
    with pytest.raises(StaleEpisodeError, match="test_real-00007") as caught:
        list(runner.run_suite([stale], Statue, "wheelchair"))
    assert not hasattr(caught.value, "__notes__")


def test_the_same_command_on_two_plans_is_counted_apart() -> None:
    trials = [
        Trial("heidelberg_hallway", "stop", (-2.5, -0.3, 0.24)),
        Trial("office_cross", "stop", (1.3, 9.1, 0.0)),
    ]
    results = list(runner.run_suite(trials, "oracle", "wheelchair", (0,)))
    assert [each.floor_plan for each in results] == ["heidelberg_hallway", "office_cross"]
    assert [each.group for each in results] == [trial.group for trial in trials]
    assert len({trial.group for trial in suite("all")}) == len(suite("all"))


def test_a_trial_whose_pose_is_never_free_is_refused_by_name() -> None:
    trial = Trial("office_cross", "turn around", (100.0, 100.0, 0.0))
    with pytest.raises(ValueError, match=r"office_cross: turn around: no free pose .* is outside"):
        next(iter(runner.run_suite([trial], "oracle", "wheelchair", (0,))))
