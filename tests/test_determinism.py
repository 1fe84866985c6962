"""Same version, platform, seed and actions: bit-identical observations, wherever they are made."""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from semnav_env.env import SemNavEnv
from tests.support.episodes import actions, digest, fresh, rollout, rounded_digest
from tests.support.paths import GOLDEN, ROOT

GOLDEN = GOLDEN / "thousand_steps.json"


@pytest.mark.parametrize("robot", ["wheelchair", "spot"])
def test_two_instances_observe_the_same_bits(robot: str) -> None:
    one, other = fresh(robot=robot), fresh(robot=robot)
    steps = actions(200, one.robot.action_size)
    assert digest(rollout(one, steps)) == digest(rollout(other, steps))


def test_what_happened_before_a_reset_does_not_matter() -> None:
    env, steps = fresh(), actions(150, 2)
    first = digest(rollout(env, steps))
    env.reset(seed=99)
    list(rollout(env, actions(120, 2, seed=1)))
    env.reset(seed=5, options={"command": "turn around", "pose": (5.0, 1.3, 0.24)})
    env.reset(seed=5, options={"command": env_command(), "pose": (-2.5, -0.3, 0.24)})
    assert digest(rollout(env, steps)) == first


def test_another_seed_gives_other_observations() -> None:
    env, other = fresh(), SemNavEnv(observation="all")
    other.reset(seed=6, options={"command": env_command(), "pose": (-2.5, -0.3, 0.24)})
    steps = actions(5, 2)
    assert digest(rollout(env, steps)) != digest(rollout(other, steps))


@pytest.mark.parametrize("before", [0, 60, 180])
def test_a_pickled_copy_goes_on_bit_for_bit(before: int) -> None:
    env, steps = fresh(), actions(before + 200, 2)
    list(rollout(env, steps[:before]))
    copy = pickle.loads(pickle.dumps(env))
    assert digest(rollout(copy, steps[before:])) == digest(rollout(env, steps[before:]))


def test_a_copy_in_a_new_process_goes_on_bit_for_bit(tmp_path: Path) -> None:
    env, steps = fresh(), actions(160, 2)
    list(rollout(env, steps[:80]))
    (tmp_path / "env.pickle").write_bytes(pickle.dumps((env, steps[80:])))
    command = [sys.executable, "-m", "tests.support.episodes", str(tmp_path / "env.pickle")]
    printed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert json.loads(printed) == digest(rollout(env, steps[80:]))


def test_observations_are_not_changed_by_later_steps() -> None:
    env = fresh()
    kept = next(rollout(env, actions(3, 2)))
    copy = {name: value.copy() for name, value in kept.items()}
    list(rollout(env, actions(20, 2)))
    assert all(np.array_equal(kept[name], copy[name]) for name in kept)


def test_a_thousand_steps_are_those_of_the_golden_run() -> None:
    env = fresh()
    assert rounded_digest(rollout(env, actions(1000, 2))) == json.loads(GOLDEN.read_text())


def env_command() -> str:
    return "go through the second door on the right"
