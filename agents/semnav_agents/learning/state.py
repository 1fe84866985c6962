"""The state from which training continues, as named tensors."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import torch
from numpy.typing import NDArray

from semnav_agents.networks.weights import Tensors, check_tensors

if TYPE_CHECKING:
    from stable_baselines3 import PPO

STEPS_NAME, IMITATED_NAME = "steps", "imitated"
"""Names of the counts of decisions, and of demonstrations that were imitated first."""

POLICY_PREFIX, ADAM_PREFIX = "policy.", "optimizer."
"""First parts of the names of weights and of Adam's tensors."""

ADAM_MOMENTS = ("step", "exp_avg", "exp_avg_sq")
"""The tensors that Adam keeps for each parameter."""


def write_state(model: PPO, imitated: int) -> Tensors:
    """The numbers of decisions and demonstrations, the weights and the state of Adam."""
    tensors: Tensors = {STEPS_NAME: np.array(model.num_timesteps, np.int64)}
    tensors[IMITATED_NAME] = np.array(imitated, np.int64)
    for name, weight in model.policy.state_dict().items():
        tensors[POLICY_PREFIX + name] = weight.numpy()
    for i, moments in model.policy.optimizer.state_dict()["state"].items():
        tensors |= {f"{ADAM_PREFIX}{i}.{name}": moments[name].numpy() for name in ADAM_MOMENTS}
    return tensors


def read_state(model: PPO, tensors: Mapping[str, NDArray[Any]]) -> int:
    """Put tensors of `write_state` into the model; returns the number of demonstrations imitated.

    Raises:
        ValueError: a tensor is missing, too many, of another shape or type, or not finite.
    """
    rest = {IMITATED_NAME: np.array(0, np.int64), **tensors}  # older files do not have it
    steps, imitated = (_count(rest.pop(name, None), name) for name in (STEPS_NAME, IMITATED_NAME))
    weights = model.policy.state_dict()
    shapes = {POLICY_PREFIX + name: tuple(weight.shape) for name, weight in weights.items()}
    parameters = list(model.policy.parameters()) if steps else []
    for i, parameter in enumerate(parameters):
        shapes[f"{ADAM_PREFIX}{i}.step"] = ()
        shapes |= {f"{ADAM_PREFIX}{i}.{name}": tuple(parameter.shape) for name in ADAM_MOMENTS[1:]}
    check_tensors(rest, shapes)
    model.num_timesteps = steps
    model.policy.load_state_dict({name: _tensor(rest, POLICY_PREFIX + name) for name in weights})
    state = {
        i: {name: _tensor(rest, f"{ADAM_PREFIX}{i}.{name}") for name in ADAM_MOMENTS}
        for i in range(len(parameters))
    }
    groups = model.policy.optimizer.state_dict()["param_groups"]
    model.policy.optimizer.load_state_dict({"state": state, "param_groups": groups})
    return imitated


def _count(tensor: NDArray[Any] | None, name: str) -> int:
    if tensor is None or tensor.shape != () or tensor.dtype != np.int64 or tensor < 0:
        raise ValueError(f"tensor {name!r} must be one whole number of 64 bits, at least 0")
    return int(tensor)


def _tensor(tensors: Mapping[str, NDArray[Any]], name: str) -> torch.Tensor:
    return torch.from_numpy(tensors[name].copy())
