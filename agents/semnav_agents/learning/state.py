"""The state from which training continues, as named tensors."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import torch
from numpy.typing import NDArray

from semnav_agents.networks.adam import adam_moments, adam_shapes, adam_tensors
from semnav_env.networks.weights import Tensors, check_tensors, pop_count

if TYPE_CHECKING:
    from stable_baselines3 import PPO

STEPS_NAME, IMITATED_NAME = "steps", "imitated"
"""Names of the counts of decisions, and of demonstrations that were imitated first."""

POLICY_PREFIX, ADAM_PREFIX = "policy.", "optimizer."
"""First parts of the names of weights and of Adam's tensors."""


def write_state(model: PPO, imitated: int) -> Tensors:
    """The numbers of decisions and demonstrations, the weights and the state of Adam."""
    tensors: Tensors = {STEPS_NAME: np.array(model.num_timesteps, np.int64)}
    tensors[IMITATED_NAME] = np.array(imitated, np.int64)
    for name, weight in model.policy.state_dict().items():
        tensors[POLICY_PREFIX + name] = weight.numpy()
    return tensors | adam_tensors(ADAM_PREFIX, model.policy.optimizer.state_dict()["state"])


def read_state(model: PPO, tensors: Mapping[str, NDArray[Any]]) -> int:
    """Put tensors of `write_state` into the model; returns the number of demonstrations imitated.

    Raises:
        ValueError: a tensor is missing, too many, of another shape or type, or not finite.
    """
    rest = {IMITATED_NAME: np.array(0, np.int64), **tensors}  # older files do not have it
    steps, imitated = (pop_count(rest, name) for name in (STEPS_NAME, IMITATED_NAME))
    weights = model.policy.state_dict()
    shapes = {POLICY_PREFIX + name: tuple(weight.shape) for name, weight in weights.items()}
    parameters = list(model.policy.parameters()) if steps else []
    shapes |= adam_shapes(ADAM_PREFIX, {i: tuple(p.shape) for i, p in enumerate(parameters)})
    check_tensors(rest, shapes)
    values = {name: torch.from_numpy(tensor.copy()) for name, tensor in rest.items()}
    model.num_timesteps = steps
    model.policy.load_state_dict({name: values[POLICY_PREFIX + name] for name in weights})
    state = adam_moments(ADAM_PREFIX, values, range(len(parameters)))
    groups = model.policy.optimizer.state_dict()["param_groups"]
    model.policy.optimizer.load_state_dict({"state": state, "param_groups": groups})
    return imitated
