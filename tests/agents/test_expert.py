"""An expert that keeps no state labels any state that an environment comes to."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

from semnav_agents.expert import Expert, true_goal
from semnav_env.env import SemNavEnv
from semnav_env.judge.episodes import evenly, load_episodes
from semnav_env.mind.grounding.goal import GoalKind
from semnav_env.mind.observations import SeenGoal
from semnav_env.vector import SemNavVectorEnv
from tests.support.episodes import START, actions


@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
def test_who_follows_the_labels_carries_out_the_command(robot: str) -> None:
    env, expert = SemNavEnv(robot, observation="raw", max_seconds=300.0), Expert()
    for episode in evenly(load_episodes("val_unseen"), 2):
        env.reset(seed=0, options={"episode": episode})
        over = False
        while not over:
            *_, terminated, truncated, info = env.step(expert.label(env))
            over = terminated or truncated
        assert info["is_success"]
        assert info["collisions"] == 0


def test_the_expert_leads_on_from_off_its_own_path() -> None:
    """The oracle's driver brakes until it stands, and answers nothing but zeros meanwhile."""
    env, expert = SemNavEnv(observation="command"), Expert()
    env.reset(seed=3, options=START)
    labels = []
    for action in actions(90, 2, seed=4):
        label = expert.label(env)
        assert env.action_space.contains(label)
        assert label.any() or max(map(abs, env.world.velocity)) > 0.05  # only to brake
        labels.append(label)
        if any(env.step(action * np.float32(0.6))[2:4]):
            break
    assert np.any(labels, axis=1).mean() > 0.9


def test_a_label_depends_on_the_state_alone() -> None:
    env, used = SemNavEnv(observation="command"), Expert()
    env.reset(seed=3, options=START)
    for action in actions(30, 2, seed=4):
        env.step(action * np.float32(0.5))
        used.label(env)
    copied = pickle.loads(pickle.dumps(env))
    before = copy.deepcopy(env.world.pose)
    label = used.label(env)
    np.testing.assert_array_equal(label, used.label(env))
    np.testing.assert_array_equal(label, Expert().label(copied))
    assert env.world.pose == before


def test_robots_of_a_vector_are_labelled_one_by_one() -> None:
    options = {"observation": "command", "task": START["command"]}
    envs, expert = SemNavVectorEnv(2, **options), Expert()
    single = SemNavEnv(**options)  # type: ignore[arg-type]
    envs.reset(seed=5)
    single.reset(seed=5)
    for action in actions(20, 2):
        envs.step(np.tile(action, (2, 1)))
        single.step(action)
    np.testing.assert_array_equal(expert.label(envs.envs[0]), expert.label(single))
    envs.close()


def test_the_true_goal_reads_back_as_the_entry_of_an_observation() -> None:
    env = SemNavEnv(observation="command")
    env.reset(seed=3, options=START)
    goal = true_goal(env)
    again = SeenGoal.read(goal.values)
    assert again.kind is goal.kind is GoalKind.PASS
    assert again.pose == pytest.approx(goal.pose, abs=1e-5)
    assert np.ravel(again.door) == pytest.approx(np.ravel(goal.door), abs=1e-5)
