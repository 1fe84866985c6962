"""Agents carry out commands, and the scripted one knows no more than it is shown."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from semnav_agents.evaluation import SUITES, Trial, run_suite, suite
from semnav_agents.evaluation.conclusion import NO_EXTRAS
from semnav_agents.evaluation.drive import drive
from semnav_agents.evaluation.jobs import EPISODE_SECONDS, SuiteJob
from semnav_agents.evaluation.suites import JOINED
from semnav_agents.registry import make_agent
from semnav_agents.scripted import ScriptedAgent
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import evenly, load_episodes
from semnav_env.robots import ROBOTS
from semnav_env.world.dynamics import Dynamics
from semnav_env.world.maps.placement import placement_error
from tests.support.episodes import START, fresh

HEIDELBERG = SUITES["heidelberg"]
SHORT = (HEIDELBERG[0], HEIDELBERG[3])
VILLA = tuple(trial for trial in SUITES["villa_doors"] if "first door" in trial.command)
OFFICE = tuple(trial for trial in SUITES["office_cross"] if trial.pose[0] == 26.0)


@pytest.mark.parametrize(
    ("agent", "robot", "trial"), list(product(("scripted", "oracle"), ROBOTS, SHORT))
)
def test_agents_reach_the_doors_of_the_measured_hallway(
    agent: str, robot: str, trial: Trial
) -> None:
    [result] = run_suite([trial], agent, robot, seeds=[0])
    assert result.success
    assert result.metrics.contact_free
    assert 0.5 < result.metrics.spl <= 1.0


@pytest.mark.parametrize("trial", OFFICE, ids=lambda trial: trial.command)
def test_the_scripted_agent_finds_its_way_around_a_bend(trial: Trial) -> None:
    [result] = run_suite([trial], "scripted", "wheelchair", seeds=[1])
    assert result.success


@pytest.mark.parametrize("robot", ROBOTS)
def test_a_room_is_left_through_the_door_on_the_named_side(robot: str) -> None:
    """The robot looks along the wall that the door is in, so it must turn to it first."""
    said = "leave the room through the left door"
    trial = Trial("office_cross", said, (3.8, 12.2, np.pi), scatter=(0.1, 0.1, 0.1))
    [result] = run_suite([trial], "scripted", robot, seeds=[0])
    assert result.success


def test_scripted_agent_never_cuts_through_a_neighbouring_room() -> None:
    """The half-open leaf of that door makes the way through the room before it the wider one."""
    [trial] = [
        t for t in SUITES["office_cross"] if t.command == "enter the second door on the left"
    ]
    [result] = run_suite([trial], "scripted", "spot", seeds=[4])
    assert result.success


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("trial", VILLA, ids=lambda trial: trial.command)
def test_in_the_hall_of_the_villa_no_other_door_is_used(robot: str, trial: Trial) -> None:
    """The hall is as wide as the bodies are long, and behind its doors nothing is seen."""
    results = run_suite([trial], "scripted", robot, seeds=[0, 1])
    assert all(result.success for result in results)


@pytest.mark.slow
@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("name", JOINED["villa"])
def test_in_the_villa_ninety_seven_of_a_hundred_succeed(name: str, robot: str) -> None:
    """`semnav evaluate NAME --seeds 10`."""
    results = list(run_suite(suite(name), "scripted", robot, seeds=range(10), workers=2))
    assert sum(result.success for result in results) >= 97


@pytest.mark.slow
@pytest.mark.parametrize("name", JOINED["all"])
def test_the_scripted_agent_succeeds_nine_times_in_ten(name: str) -> None:
    results = list(run_suite(SUITES[name], "scripted", "wheelchair", seeds=range(3), workers=2))
    assert np.mean([result.success for result in results]) >= 0.9


def test_the_scripted_agent_acts_on_the_observation_alone() -> None:
    """Two worlds that look the same get the same actions."""
    env = fresh("all")
    agent, other = ScriptedAgent(), ScriptedAgent()
    observation, info = env.reset(seed=5, options=START)
    agent.reset(info)
    other.reset({name: info[name] for name in ("robot", "lidar")})
    for _ in range(10):
        action = agent.act(observation)
        assert np.array_equal(action, other.act(observation))
        observation = env.step(action)[0]


def test_results_do_not_depend_on_the_number_of_workers() -> None:
    alone = list(run_suite(HEIDELBERG[:1], "oracle", "spot", seeds=[0, 1]))
    shared = list(run_suite(HEIDELBERG[:1], "oracle", "spot", seeds=[0, 1], workers=2))
    assert alone == shared


def test_episodes_driven_together_end_as_driven_alone() -> None:
    jobs = [SuiteJob(each, each.number) for each in evenly(load_episodes("test_real"), 3)]
    together = list(run_suite([job.trial for job in jobs], "scripted", "wheelchair"))
    agent = make_agent("scripted")
    env = SemNavEnv(observation=agent.observation, max_seconds=EPISODE_SECONDS)
    alone = [drive(env, agent, job.seed, job.options(env)) for job in jobs]
    pairs = zip(jobs, alone, strict=True)
    assert together == [job.result(driven, NO_EXTRAS) for job, driven in pairs]


def test_an_agent_can_be_used_for_one_episode_after_another() -> None:
    agent = make_agent("scripted")
    env = SemNavEnv(observation=agent.observation)
    jobs = [SuiteJob(HEIDELBERG[0], 0), SuiteJob(HEIDELBERG[1], 1), SuiteJob(HEIDELBERG[0], 0)]
    first, _, again = (drive(env, agent, job.seed, job.options(env)).metrics for job in jobs)
    assert again == first


def test_an_episode_begins_where_no_added_box_stands() -> None:
    trial, dynamics = SUITES["office_cross"][0], Dynamics(added_boxes=20)
    env = SemNavEnv(observation="truth", dynamics=dynamics, max_seconds=0.5)
    env.reset(seed=8, options={"floor_plan": trial.floor_plan})
    assert placement_error(env.floor_plan, env.robot, trial.pose)  # where it was not asked for
    env.reset(seed=8, options=SuiteJob(trial, 8).options(env))
    assert placement_error(env.floor_plan, env.robot, trial.pose) is None


def test_an_unknown_agent_is_an_error_that_lists_the_known_ones() -> None:
    driving = "scripted, oracle, blind, random, searcher, explorer, finder"
    names = f"{driving}, listener_drives, drive, listener"
    with pytest.raises(ValueError, match=names):
        make_agent("psychic")


def test_the_scripted_agent_says_which_observation_it_needs() -> None:
    env = SemNavEnv(observation="semantic")
    observation, info = env.reset(seed=0)
    agent = make_agent("scripted")
    agent.reset(info)
    with pytest.raises(ValueError, match='observation="all"'):
        agent.act(observation)
