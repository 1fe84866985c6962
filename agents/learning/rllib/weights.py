"""RLlib's weights and the state of Adam as named tensors, and the policy in them; needs no Ray."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_env.agents.learning.policy import Policy, check_tensors

Array = NDArray[np.float32]
Tensors = dict[str, NDArray[Any]]

ACTOR, ACTION, LOG_STD = "encoder.actor_encoder.net.mlp.", "pi.net.mlp.", "pi.log_std"
"""First parts of the names of RLlib's tensors: hidden layers, last layer, spread of the actions."""

WEIGHT_PREFIX, ADAM_PREFIX = "weights.", "adam."
"""First parts of the names of our tensors."""

ADAM_MOMENTS = ("step", "exp_avg", "exp_avg_sq")
"""What Adam keeps for each parameter."""


def policy_from(weights: Mapping[str, Array], hidden: int) -> Policy:
    """The part of RLlib's weights that gives the mean action.

    Args:
        weights: by RLlib's names, in which layers and their activations are counted together.
        hidden: number of hidden layers.
    """
    names = [f"{ACTOR}{2 * i}" for i in range(hidden)] + [f"{ACTION}0"]
    return Policy(
        tuple(weights[f"{name}.weight"].copy() for name in names),
        tuple(weights[f"{name}.bias"].copy() for name in names),
    )


def beginning(weights: Mapping[str, Array], log_std: float) -> dict[str, Array]:
    """Weights with which a training begins: actions about zero, with a given spread.

    The last layer is a hundredth of RLlib's, as Andrychowicz et al. (2021) recommend.

    Args:
        weights: by RLlib's names.
        log_std: logarithm of the standard deviation of the actions.
    """
    scales = {f"{ACTION}0.weight": 0.01, f"{ACTION}0.bias": 0.0}
    begun = {name: weight * np.float32(scales.get(name, 1.0)) for name, weight in weights.items()}
    begun[LOG_STD] = np.full_like(weights[LOG_STD], log_std)
    return begun


def write_state(weights: Mapping[str, Array], adam: Mapping[int, Mapping[str, Any]]) -> Tensors:
    """Weights and the state of Adam, one tensor each.

    Args:
        weights: by RLlib's names.
        adam: the moments of each parameter, by its index; empty before the first update.
    """
    tensors: Tensors = {WEIGHT_PREFIX + name: weight for name, weight in weights.items()}
    for name, moments in zip(_parameters(weights) if adam else (), adam.values(), strict=True):
        for moment in ADAM_MOMENTS:
            tensors[f"{ADAM_PREFIX}{name}.{moment}"] = np.asarray(moments[moment], np.float32)
    return tensors


def read_state(
    tensors: Mapping[str, NDArray[Any]], weights: Mapping[str, Array]
) -> tuple[dict[str, Array], dict[int, dict[str, Array]]]:
    """The opposite of `write_state`: the weights, and the state of Adam.

    Args:
        tensors: of `write_state`.
        weights: of a fresh model, by RLlib's names: what shapes there must be.

    Raises:
        ValueError: a tensor is missing, too many, of another shape or type, or not finite.
    """
    learned = any(name.startswith(ADAM_PREFIX) for name in tensors)
    names = _parameters(weights) if learned else []
    shapes = {WEIGHT_PREFIX + name: weight.shape for name, weight in weights.items()}
    for name in names:
        shapes[f"{ADAM_PREFIX}{name}.step"] = ()
        shapes |= {f"{ADAM_PREFIX}{name}.{m}": weights[name].shape for m in ADAM_MOMENTS[1:]}
    check_tensors(tensors, shapes)
    adam = {
        i: {moment: tensors[f"{ADAM_PREFIX}{name}.{moment}"] for moment in ADAM_MOMENTS}
        for i, name in enumerate(names)
    }
    return {name: tensors[WEIGHT_PREFIX + name] for name in weights}, adam


def _parameters(weights: Mapping[str, Array]) -> list[str]:
    """Names of what is learned, in the order in which Adam counts; constants are left out."""
    return [name for name in weights if not name.endswith("_const")]
