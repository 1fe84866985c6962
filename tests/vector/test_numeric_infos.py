"""Gymnasium's `NumpyToTorch` around one robot and around many."""

from __future__ import annotations

from typing import Any

import gymnasium as gym
import numpy as np
import pytest

from semnav_env.vector import NumericInfos
from semnav_env.vector.numeric_infos import numbers_of

torch = pytest.importorskip("torch", reason='needs the extra "rl"')
pytest.importorskip("array_api_compat", reason="NumpyToTorch needs array-api-compat")

ID = "semnav_env:SemNav-v0"


def test_one_robot_can_be_driven_with_tensors() -> None:
    from gymnasium.wrappers import NumpyToTorch

    env: Any = NumpyToTorch(gym.make(ID, max_seconds=0.2))
    seen, _ = env.reset(seed=0)
    truncated = False
    while not truncated:
        seen, _, _, truncated, info = env.step(torch.zeros(2))
    assert isinstance(seen["odometry"], torch.Tensor)
    assert float(info["path_length"]) >= 0.0


@pytest.mark.parametrize("mode", ["vector_entry_point", "sync"])
def test_many_robots_can_be_driven_with_tensors(mode: str) -> None:
    from gymnasium.wrappers.vector import NumpyToTorch

    made: Any = gym.make_vec(ID, num_envs=2, vectorization_mode=mode, max_seconds=0.2)
    envs = NumpyToTorch(NumericInfos(made))
    _, infos = envs.reset(seed=0)
    assert infos["robot"]["length"].tolist() == pytest.approx([1.1, 1.1])
    for _ in range(5):
        seen, _, _, _, infos = envs.step(torch.zeros(2, 2))
    assert isinstance(seen["odometry"], torch.Tensor)
    envs.close()


def test_a_mask_is_kept_with_its_entry() -> None:
    here = np.ones(2, bool)
    words = np.array(["a", "b"], dtype=object)
    infos = {"words": words, "_words": here, "x": np.zeros(2), "_x": here}
    nested = {"both": infos, "_both": here, "only": {"words": words}, "_only": here}
    assert set(numbers_of(infos)) == {"x", "_x"}
    assert set(numbers_of(nested)) == {"both", "_both"}
