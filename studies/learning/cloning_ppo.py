"""Cloning of half of the demonstrations, then PPO for as many steps: what does it add?"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from studies.learning.cloning import cloned
from studies.learning.command_envs import training_envs
from studies.learning.ppo import CLONED_LOG_STD, CLONED_RATE, ROBOTS, new_model, reinforced
from studies.learning.progress import Learned, points


def train(seed: int, steps: int, folder: Path) -> Iterator[Learned]:
    """Clone, then reinforce; gives the policy after each part of the second half."""
    half = steps // 2
    model = new_model(training_envs(ROBOTS), seed, CLONED_RATE, CLONED_LOG_STD)
    model.policy.load_state_dict(cloned(seed, half, folder, steps).state_dict())
    yield from reinforced(model, points(half, steps), before=half)
