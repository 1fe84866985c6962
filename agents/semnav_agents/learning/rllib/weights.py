"""The state of a training on RLlib as named tensors, and its policy; needs no Ray."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_agents.learning.policy import Policy
from semnav_agents.networks.adam import adam_moments, adam_shapes, adam_tensors
from semnav_env.networks.weights import Tensors, check_tensors, pop_count

Weights = Mapping[str, NDArray[np.float32]]
Moments = Mapping[int, Mapping[str, Any]]

RLLIB_FILE = "rllib.safetensors"
"""File with the state from which a training on RLlib continues."""

ACTOR, ACTION, LOG_STD = "encoder.actor_encoder.net.mlp.", "pi.net.mlp.", "pi.log_std"
"""First parts of the names of RLlib's tensors: hidden layers, last layer, spread of the actions."""

STEPS_NAME, WEIGHT_PREFIX, ADAM_PREFIX = "steps", "weights.", "adam."
"""Name of the number of decisions; first parts of the names of weights and of Adam's tensors."""


def policy_from(weights: Weights, hidden: int) -> Policy:
    """Select those of RLlib's weights that give the mean action.

    Args:
        weights: by RLlib's names, in which layers and their activations are counted together.
        hidden: number of hidden layers.
    """
    names = [f"{ACTOR}{2 * i}" for i in range(hidden)] + [f"{ACTION}0"]
    parts = [(weights[f"{name}.weight"], weights[f"{name}.bias"]) for name in names]
    return Policy.of_layers([(weight.copy(), bias.copy()) for weight, bias in parts])


def beginning(weights: Weights, log_std: float) -> Weights:
    """Initial weights of a training: actions about zero, with a given spread.

    The last layer is a hundredth of RLlib's, as Andrychowicz et al. (2021) recommend.

    Args:
        weights: by RLlib's names.
        log_std: logarithm of the standard deviation of the actions.
    """
    scales = {f"{ACTION}0.weight": 0.01, f"{ACTION}0.bias": 0.0}
    begun = {name: weight * np.float32(scales.get(name, 1.0)) for name, weight in weights.items()}
    begun[LOG_STD] = np.full_like(weights[LOG_STD], log_std)
    return begun


class RLlibState(NamedTuple):
    """The state from which a training continues.

    Attributes:
        weights: by RLlib's names.
        adam: the moments of each parameter, by its index; empty before the first update.
        steps: number of decisions so far.
    """

    weights: Weights
    adam: Moments
    steps: int

    def tensors(self) -> Tensors:
        """The state as named tensors."""
        named: Tensors = {STEPS_NAME: np.array(self.steps, np.int64)}
        named |= {WEIGHT_PREFIX + name: weight for name, weight in self.weights.items()}
        names = _parameters(self.weights)
        moments = {names[i]: each for i, each in self.adam.items()}
        return named | adam_tensors(ADAM_PREFIX, moments)

    @classmethod
    def from_tensors(cls, tensors: Mapping[str, NDArray[Any]], weights: Weights) -> RLlibState:
        """The opposite of `tensors`.

        Args:
            tensors: by name.
            weights: of a new model, for the expected shapes.

        Raises:
            ValueError: a tensor is missing, too many, of another shape or type, or not finite.
        """
        rest = dict(tensors)
        steps = pop_count(rest, STEPS_NAME)
        learned = any(name.startswith(ADAM_PREFIX) for name in rest)
        names = _parameters(weights) if learned else []
        shapes = {WEIGHT_PREFIX + name: weight.shape for name, weight in weights.items()}
        shapes |= adam_shapes(ADAM_PREFIX, {name: weights[name].shape for name in names})
        check_tensors(rest, shapes)
        adam = dict(enumerate(adam_moments(ADAM_PREFIX, rest, names).values()))
        return cls({name: rest[WEIGHT_PREFIX + name] for name in weights}, adam, steps)


def _parameters(weights: Weights) -> list[str]:
    """Names of what is learned, in the order in which Adam counts; constants are left out."""
    return [name for name in weights if not name.endswith("_const")]
