"""Parts of one's own in a vector: each robot has its own, as in an environment of its own."""

import gc
from dataclasses import replace
from weakref import ref

import gymnasium as gym
import numpy as np
import pytest

from semnav_agents.learning.sb3_vec_env import as_sb3_vec_env
from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import EpisodeRequest, RewardWeights
from semnav_env.mind.observations import EntryObservation, PaceEntry
from semnav_env.rescue import PersonSearch
from semnav_env.vector import SemNavVectorEnv
from semnav_env.vector.observations import EntryRows
from semnav_features.lidars import TIM561

COARSE = replace(TIM561, name="coarse", beams=271, angle_increment=3.0 * TIM561.angle_increment)
AHEAD = np.full((2, 2), 0.3, np.float32)


class Smoothness:
    """A reward that remembers the last action."""

    def __init__(self):
        self.last = None

    def terms(self, tick):
        change = 0.0 if self.last is None else float(np.abs(tick.action - self.last).sum())
        self.last = tick.action.copy()
        return {"smooth": -change}


class WithoutGoal(EntryObservation):
    """Hides the goal."""

    def observe(self, moment):
        entries = super().observe(moment)
        return entries | {"goal": np.zeros_like(entries["goal"])}


@pytest.mark.parametrize("lidars", [(COARSE, TIM561), (TIM561, COARSE)])
def test_robots_may_have_lidars_of_different_numbers_of_beams(lidars):
    envs = SemNavVectorEnv(2, each=[{"lidar": each} for each in lidars], threads=1)
    singles = [SemNavEnv(lidar=each) for each in lidars]
    envs.reset(seed=0)
    for k, env in enumerate(singles):
        env.reset(seed=k)
    for _ in range(30):
        rows = envs.step(AHEAD)[0]
        for k, env in enumerate(singles):
            for name, value in env.step(AHEAD[k])[0].items():
                np.testing.assert_array_equal(rows[name][k], value)


def test_one_observation_object_serves_environments_of_different_lidars():
    observation = EntryObservation("all")
    envs = [SemNavEnv(observation=observation, lidar=each) for each in (TIM561, COARSE)]
    for env in envs:
        assert env.observation_space.contains(env.reset(seed=0)[0])


def test_what_is_given_for_all_robots_remembers_for_each_by_itself():
    envs = SemNavVectorEnv(2, rewards=Smoothness())
    envs.reset(seed=0)
    rewards = [envs.step(np.array([[1, 0], [-1, 0]], np.float32))[1] for _ in range(3)]
    assert np.abs(rewards).max() == 0.0
    first, second = SemNavVectorEnv(2, payload=PersonSearch()).envs
    assert first.payload is not second.payload


def test_the_payload_that_is_given_to_many_searching_robots_is_used():
    mine = PersonSearch()
    mine.mark = "mine"
    envs = gym.make_vec(
        "semnav_env:SearchAndRescue-v0", 2, "vector_entry_point", payload=mine
    ).unwrapped
    assert [env.payload.mark for env in envs.envs] == ["mine", "mine"]


def test_each_robot_observes_by_its_own_type():
    each = [{"observation": "semantic"}, {"observation": WithoutGoal("semantic")}]
    envs = SemNavVectorEnv(2, each=each)
    goals = envs.reset(seed=0)[0]["goal"]
    assert goals[0].any()
    assert not goals[1].any()


def test_rewards_that_are_set_count_from_the_next_step():
    envs = SemNavVectorEnv(2)
    envs.reset(seed=0)
    envs.set_attr("rewards", RewardWeights(progress=0.0, time=-7.0))
    assert envs.step(np.zeros((2, 2)))[1].tolist() == [-7.0, -7.0]
    taught = as_sb3_vec_env(2)
    taught.reset()
    taught.set_attr("rewards", RewardWeights(progress=0.0, time=-7.0), indices=1)
    assert taught.step(np.zeros((2, 2)))[1][1] == -7.0


def test_a_robot_whose_reset_was_refused_must_be_reset_itself():
    envs = SemNavVectorEnv(2)
    envs.reset(seed=0)
    with pytest.raises(ValueError, match="blargh"):
        envs.reset(options={"reset_mask": np.array([True, False]), "command": "blargh"})
    envs.reset(options={"reset_mask": np.array([False, True])})
    with pytest.raises(RuntimeError, match=r"reset robots \[0\] first"):
        envs.step(AHEAD)
    envs.reset(options={"reset_mask": np.array([True, False])})
    envs.step(AHEAD)


def test_after_an_autoreset_that_failed_no_finished_episode_goes_on():
    drawn = []

    def task(rng):
        drawn.append(1)
        ordinal = "ninth" if len(drawn) == 3 else "first"
        return EpisodeRequest(f"go through the {ordinal} door on the right")

    envs = SemNavVectorEnv(2, task=task, max_seconds=0.2)
    envs.reset(seed=0)
    over = np.zeros(2, dtype=bool)
    while not over.all():
        over = envs.step(np.zeros((2, 2)))[3]
    with pytest.raises(ValueError, match="robot 0"):
        envs.step(np.zeros((2, 2)))
    with pytest.raises(RuntimeError, match=r"reset robots \[0 1\] first"):
        envs.step(np.zeros((2, 2)))
    envs.reset()
    assert not envs.step(np.zeros((2, 2)))[3].any()


def test_a_mind_that_was_replaced_is_not_kept() -> None:
    """One that knows the floor plan is replaced with it."""
    envs = SemNavVectorEnv(2, threads=1, observation="truth")
    envs.reset(seed=0)
    before = [ref(env.tracker) for env in envs.envs]
    envs.reset(seed=1, options={"floor_plan": "office_cross"})
    envs.step(np.zeros((2, 2)))
    gc.collect()
    assert [each() for each in before] == [None, None]


def test_entries_of_ones_own_leave_the_others_on_the_fast_path():
    kinds = [EntryObservation("all", [PaceEntry()]) for _ in range(2)]
    each = [{"observation": kind} for kind in kinds]
    envs, singles = SemNavVectorEnv(2, each=each, threads=1), [SemNavEnv(**own) for own in each]
    told = {"command": "drive slowly, then go to the end of the hallway"}
    rows = envs.reset(seed=0, options=told)[0]
    assert isinstance(envs._observations, EntryRows)
    alone = [env.reset(seed=k, options=told)[0] for k, env in enumerate(singles)]
    for _ in range(20):
        for k, row in enumerate(alone):
            assert set(row) == set(rows)
            for name, value in row.items():
                np.testing.assert_array_equal(rows[name][k], value)
        rows = envs.step(AHEAD)[0]
        alone = [env.step(AHEAD[k])[0] for k, env in enumerate(singles)]
    assert rows["pace"].shape == (2, 1)
    assert rows["pace"].any()


def test_a_robot_that_rests_leaves_the_other_as_it_would_be_alone():
    envs = SemNavVectorEnv(2, autoreset_mode="Disabled", max_seconds=2.0, threads=1)
    single = SemNavEnv(max_seconds=9.0)
    for k in range(2):
        envs.begin(k, k)
    envs.envs[0].max_steps = 10_000
    envs.read_settings()
    rows, alone = envs.observe(), single.reset(seed=0)[0]
    over = False
    for _ in range(60):
        for name, value in alone.items():
            np.testing.assert_array_equal(rows[name][0], value)
        rows, _, terminated, truncated, _ = envs.step(AHEAD)
        alone = single.step(AHEAD[0])[0]
        if terminated[1] or truncated[1]:
            over = True
            with pytest.raises(RuntimeError, match="must be reset first"):
                envs.step(AHEAD)
            envs.rest(1)
    assert over
    envs.begin(1, 7)
    expected = SemNavEnv(max_seconds=2.0).reset(seed=7)[0]
    for name, value in expected.items():
        np.testing.assert_array_equal(envs.observe()[name][1], value)
