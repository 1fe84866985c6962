"""The environment with people, changing doors and moved furniture: determinism and info."""

from __future__ import annotations

import copy
import json
import pickle
import subprocess
import sys
from pathlib import Path

import gymnasium as gym
import numpy as np
import pytest

from semnav_agents.evaluation import run_suite, suite
from semnav_env.env import SemNavEnv
from semnav_env.world.dynamics import NO_DYNAMICS, Dynamics
from semnav_scripts.main import main
from tests.support.episodes import actions, digest, rollout
from tests.support.paths import ROOT

ALL = Dynamics(5, changing_doors=0.5, moved_furniture=0.5, added_boxes=3)
START = {"command": "go through the second door on the right", "pose": (9.0, 9.1, 3.14)}
models = pytest.mark.parametrize("model", ["social_force", "orca"])


def lively(model: str = "orca", seed: int = 5, dynamics: Dynamics | None = None) -> SemNavEnv:
    chosen = dynamics or Dynamics(5, model, 0.5, 0.5, 3)
    env = SemNavEnv(floor_plan="office_cross", observation="all", dynamics=chosen)
    env.reset(seed=seed)
    return env


@models
def test_two_instances_observe_the_same_bits(model: str) -> None:
    steps = actions(120, 2)
    digests = {digest(rollout(lively(model), steps)) for _ in range(2)}
    assert len(digests) == 1


def test_what_happened_before_a_reset_does_not_matter() -> None:
    env, steps = lively(), actions(80, 2)
    first = digest(rollout(env, steps))
    list(rollout(env, actions(50, 2, seed=1)))
    env.reset(seed=5)
    assert digest(rollout(env, steps)) == first


@models
@pytest.mark.parametrize("duplicate", [copy.deepcopy, lambda e: pickle.loads(pickle.dumps(e))])
def test_a_copy_made_in_mid_episode_goes_on_bit_for_bit(model: str, duplicate: object) -> None:
    env, steps = lively(model), actions(150, 2)
    list(rollout(env, steps[:90]))
    twin = duplicate(env)  # type: ignore[operator]
    assert twin.world.moving_shapes[0].tolist() == env.world.moving_shapes[0].tolist()
    assert digest(rollout(twin, steps[90:])) == digest(rollout(env, steps[90:]))


def test_a_copy_in_a_new_process_goes_on_bit_for_bit(tmp_path: Path) -> None:
    env, steps = lively(), actions(100, 2)
    list(rollout(env, steps[:60]))
    (tmp_path / "env.pickle").write_bytes(pickle.dumps((env, steps[60:])))
    command = [sys.executable, "-m", "tests.support.episodes", str(tmp_path / "env.pickle")]
    printed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert json.loads(printed) == digest(rollout(env, steps[60:]))


def test_workers_that_are_spawned_observe_what_one_alone_does() -> None:
    options = {"floor_plan": "office_cross", "observation": "all", "dynamics": ALL}
    envs = gym.make_vec(
        "semnav_env:SemNav-v0",
        num_envs=2,
        vectorization_mode="async",
        vector_kwargs={"context": "spawn"},
        **options,
    )
    alone = [SemNavEnv(**options) for _ in range(2)]  # type: ignore[arg-type]
    try:
        batch, _ = envs.reset(seed=3)
        single = [env.reset(seed=3 + i)[0] for i, env in enumerate(alone)]
        for action in actions(25, 2):
            for i, row in enumerate(single):
                assert all(np.array_equal(batch[name][i], row[name]) for name in row)
            batch, *_ = envs.step(np.stack([action, action]))
            single = [env.step(action)[0] for env in alone]
    finally:
        envs.close()


def test_another_seed_has_other_people() -> None:
    one, other = lively(seed=5), lively(seed=6)
    assert one.world.moving_shapes[0].tolist() != other.world.moving_shapes[0].tolist()


def test_off_is_the_default_and_changes_nothing() -> None:
    plain, off = (
        SemNavEnv(observation="all", **chosen) for chosen in ({}, {"dynamics": NO_DYNAMICS})
    )
    assert plain.world.moving is None
    assert plain.floor_plan is plain.world.still is plain.world.floor_plan
    steps = actions(40, 2)
    for env in (plain, off):
        env.reset(seed=5)
    assert digest(rollout(plain, steps)) == digest(rollout(off, steps))


def test_info_at_the_end_says_how_near_people_came() -> None:
    env = SemNavEnv(
        floor_plan="office_cross", observation="raw", dynamics=Dynamics(12), max_seconds=20.0
    )
    env.reset(seed=1, options=START)
    over = False
    while not over:
        _, _, terminated, truncated, info = env.step(np.array([0.4, 0.0]))
        over = terminated or truncated
    assert info["least_gap_to_people"] < 20.0
    assert (info["least_time_to_collision"] == 0.0) == (info["least_gap_to_people"] == 0.0)
    assert (info["personal_space_intrusions"] > 0) == (info["least_gap_to_people"] < 0.45)


def test_furniture_differs_by_episode_and_repeats_by_seed() -> None:
    env = lively(dynamics=Dynamics(added_boxes=5))
    first = env.floor_plan
    env.reset()
    second = env.floor_plan
    env.reset(seed=5)
    assert first.surfaces != second.surfaces
    assert env.floor_plan.surfaces == first.surfaces


def test_something_else_than_dynamics_is_refused() -> None:
    with pytest.raises(ValueError, match="dynamics is 'people'; it must be a"):
        SemNavEnv(dynamics="people")  # type: ignore[arg-type]


def test_the_picture_shows_people_and_leaves() -> None:
    env = SemNavEnv(floor_plan="office_cross", dynamics=ALL, render_mode="rgb_array")
    env.reset(seed=5)
    env.world.moving_shapes[0][0, :2] = env.world.pose[0] + 1.5, env.world.pose[1]
    with_people = env.render()
    env.world.moving_shapes[0][:, :2] = 1e4
    assert with_people is not None
    assert (with_people != env.render()).any()
    env.close()


def test_the_demo_command_says_how_near_people_came(
    capsys: pytest.CaptureFixture[str],
) -> None:
    words = ["demo", "stop", "--pedestrians", "2", "--model", "orca", "--changing-doors", "0.5"]
    main([*words, "--json"])
    outcome = json.loads(capsys.readouterr().out)
    assert {"personal_space_intrusions", "least_time_to_collision"} <= outcome.keys()


def test_the_command_line_refuses_people_that_make_no_sense(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["demo", "stop", "--pedestrians", "-1"]) == 2
    assert "a whole number from 0 to 200" in capsys.readouterr().err


def test_an_evaluation_with_people_measures_them() -> None:
    trial = suite("heidelberg")[0]
    [result] = run_suite([trial], "scripted", "spot", [0], dynamics=Dynamics(2))
    assert result.social["least_gap_to_people"] > 0.0
    assert json.loads(json.dumps(result.row(), allow_nan=False))["personal_space_seconds"] >= 0.0
    [alone] = run_suite([trial], "scripted", "spot", [0])
    assert alone.social == {}
