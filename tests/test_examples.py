"""Every example runs by itself and prints what its first lines promise."""

from __future__ import annotations

import ast
import importlib.util
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.paths import ROOT

FOLDER = ROOT / "examples"

SAYS = {
    "first_episode": "success: True",
    "own_floor_plan": "crossed: ('office_door',)  success: True",
    "own_robot": "walker: 0.7 m long, 2 numbers an action; success True",
    "own_lidar": "a step lasts 25 ms",
    "own_reward": "smoothness -0.",
    "own_observation": "nearest_hit: shape (2,)",
    "own_task": "now at stage 1",
    "own_clause": "StepAside: success True, the robot's goal: step aside by 1 metre",
    "own_agent": '"go through the first door on the right"',
    "command_on_log": "clause 1, StopGoal",
    "ppo": "decisions: reward",
    "rl_zoo": "total_timesteps | 1024",
    "optuna_study": "best of 1 trials: reward",
    "torchrl_collector": "2048 decisions: reward",
}
"""Words that each example prints, by its name."""

NEEDS = {
    "ppo": "torch",
    "rl_zoo": "rl_zoo3",
    "optuna_study": "optuna",
    "torchrl_collector": "torchrl",
}
"""The package without which an example says what to install."""

FEW = {
    "ppo": ["--steps", "1024"],
    "rl_zoo": ["-n", "1024", "--eval-freq", "-1", "--log-folder", ""],
    "optuna_study": ["--trials", "1", "--steps", "4096"],
    "torchrl_collector": ["--steps", "2048"],
}
"""Arguments that make an example short."""

LONGEST = 60
"""Most lines of an example; one that holds a whole learner may have twice as many."""

LEARNERS = {"ppo", "torchrl_collector"}


def run(name: str, *arguments: str) -> str:
    """What an example prints."""
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    file = str(FOLDER / f"{name}.py")
    command = [sys.executable, file, *FEW.get(name, []), *arguments]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_every_example_is_tested() -> None:
    assert {path.stem for path in FOLDER.glob("*.py")} == set(SAYS)


@pytest.mark.parametrize("name", SAYS)
def test_an_example_prints_what_it_promises(name: str) -> None:
    if name in NEEDS and importlib.util.find_spec(NEEDS[name]) is None:
        pytest.skip(f"{NEEDS[name]} is not installed")
    assert SAYS[name] in run(name)


def test_the_same_seed_gives_the_same_curve() -> None:
    pytest.importorskip("torch")
    first, again, other = (run("ppo", "--seed", seed) for seed in ("3", "3", "4"))
    assert first == again
    assert first != other


@pytest.mark.parametrize("name", NEEDS)
def test_an_example_without_its_package_says_what_it_needs(tmp_path: Path, name: str) -> None:
    missing = NEEDS[name]
    (tmp_path / f"{missing}.py").write_text(
        f"raise ModuleNotFoundError('No module named {missing}', name='{missing}')"
    )
    environment = os.environ | {"PYTHONPATH": f"{tmp_path}{os.pathsep}{ROOT}"}
    command = [sys.executable, str(FOLDER / f"{name}.py")]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "this example needs" in done.stderr
    assert missing in done.stderr


@pytest.mark.parametrize("name", SAYS)
def test_an_example_is_short_and_uses_public_names(name: str) -> None:
    text = (FOLDER / f"{name}.py").read_text()
    tree = ast.parse(text)
    assert ast.get_docstring(tree)
    code = [line for line in text.splitlines() if line.strip()]
    assert len(code) <= (2 * LONGEST if name in LEARNERS else LONGEST), len(code)
    names = [node.attr for node in ast.walk(tree) if isinstance(node, ast.Attribute)]
    names += [
        alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    ]
    assert not [each for each in names if each.startswith("_") and not each.endswith("__")]
