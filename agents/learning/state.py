"""All that training goes on from, as named tensors."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import torch
from numpy.typing import NDArray

from semnav_env.agents.learning.policy import check_tensors

if TYPE_CHECKING:
    from stable_baselines3 import PPO

Tensors = dict[str, NDArray[Any]]

STEPS, POLICY, ADAM = "steps", "policy.", "optimizer."
MOMENTS = ("step", "exp_avg", "exp_avg_sq")
"""What Adam keeps for each parameter."""


def write_state(model: PPO) -> Tensors:
    """The count of decisions, the weights and the state of Adam."""
    tensors: Tensors = {STEPS: np.array(model.num_timesteps, np.int64)}
    for name, weight in model.policy.state_dict().items():
        tensors[POLICY + name] = weight.numpy()
    for i, moments in model.policy.optimizer.state_dict()["state"].items():
        tensors |= {f"{ADAM}{i}.{name}": moments[name].numpy() for name in MOMENTS}
    return tensors


def read_state(model: PPO, tensors: Mapping[str, NDArray[Any]]) -> None:
    """The opposite of `write_state`.

    Raises:
        ValueError: a tensor is missing, too many, of another shape or type, or not finite.
    """
    rest = dict(tensors)
    steps = rest.pop(STEPS, None)
    if steps is None or steps.shape != () or steps.dtype != np.int64 or steps < 0:
        raise ValueError(f"tensor {STEPS!r} must be one whole number of 64 bits, at least 0")
    weights = model.policy.state_dict()
    shapes = {POLICY + name: tuple(weight.shape) for name, weight in weights.items()}
    parameters = list(model.policy.parameters()) if steps else []
    for i, parameter in enumerate(parameters):
        shapes[f"{ADAM}{i}.step"] = ()
        shapes |= {f"{ADAM}{i}.{name}": tuple(parameter.shape) for name in MOMENTS[1:]}
    check_tensors(rest, shapes)
    model.num_timesteps = int(steps)
    model.policy.load_state_dict({name: _tensor(rest, POLICY + name) for name in weights})
    state = {
        i: {name: _tensor(rest, f"{ADAM}{i}.{name}") for name in MOMENTS}
        for i in range(len(parameters))
    }
    groups = model.policy.optimizer.state_dict()["param_groups"]
    model.policy.optimizer.load_state_dict({"state": state, "param_groups": groups})


def _tensor(tensors: Mapping[str, NDArray[Any]], name: str) -> torch.Tensor:
    return torch.from_numpy(tensors[name].copy())
