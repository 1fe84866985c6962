"""The policy that a trained agent runs: a small network in NumPy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Annotated

import numpy as np

from semnav_env.networks.card import Card, NetworkSettings
from semnav_env.networks.layers import Array, Shapes, linear, linear_shapes
from semnav_env.networks.weights import load_weights
from semnav_features.checked_fields import Bounds, Count, check_fields

Width = Annotated[int, Bounds(1, 4096)]
Counted = Annotated[int, Bounds(0, 10**15)]


@dataclass(frozen=True)
class PolicySettings(NetworkSettings):
    """Settings to run a policy, and the progress of its training.

    Attributes:
        robots: names of the bodies that were driven.
        repeat: steps of the environment for which a decision holds.
        widths: of the observation, the hidden layers and the action.
        steps: number of decisions so far.
        imitated: number of demonstrations that were imitated first.
    """

    KIND = "policy"

    robots: tuple[str, ...]
    repeat: Count
    widths: tuple[Width, ...]
    steps: Counted
    imitated: Counted = 0

    def __post_init__(self) -> None:
        check_fields(self)
        if not self.robots:
            raise ValueError("robots is empty; it must be one or more names")
        if len(self.widths) < 2:
            raise ValueError(f"widths is {self.widths}; it must be two or more whole numbers")

    @property
    def is_untrained(self) -> bool:
        """Whether the weights are still the random initial ones."""
        return not self.steps and not self.imitated

    def tensors(self) -> Shapes:
        """The shape of every tensor by name: "0.weight", "0.bias", "1.weight" and so on."""
        shapes: Shapes = {}
        for k, (inputs, outputs) in enumerate(pairwise(self.widths)):
            shapes |= linear_shapes(str(k), inputs, outputs)
        return shapes


@dataclass(frozen=True, eq=False)
class Policy:
    """A perceptron with tanh between its layers; the mean of the policy that was trained.

    Attributes:
        tensors: its weights by name, see `PolicySettings.tensors`.
    """

    tensors: Mapping[str, Array]

    @classmethod
    def of_layers(cls, layers: Sequence[tuple[Array, Array]]) -> Policy:
        """A policy from layers, each a weight, shape (outputs, inputs), and a bias."""
        tensors: dict[str, Array] = {}
        for k, (weight, bias) in enumerate(layers):
            tensors |= {f"{k}.weight": weight, f"{k}.bias": bias}
        return cls(tensors)

    @classmethod
    def load(cls, folder: Path, card: Card[PolicySettings]) -> Policy:
        """The policy of a folder.

        Raises:
            ValueError: the weights are damaged, or not those of the card.
            OSError: they cannot be read.
        """
        return cls(load_weights(folder, card.settings.tensors()))

    @property
    def widths(self) -> tuple[int, ...]:
        """Widths of the observation, the hidden layers and the action."""
        inputs = self.tensors["0.weight"].shape[1]
        return inputs, *(len(self.tensors[f"{k}.bias"]) for k in range(self._layers))

    @property
    def _layers(self) -> int:
        return len(self.tensors) // 2

    def act(self, values: Array) -> Array:
        """The action for a compact observation, each part in [-1, 1]."""
        last = self._layers - 1
        for k in range(last):
            values = np.tanh(linear(self.tensors, str(k), values))
        action: Array = np.clip(linear(self.tensors, str(last), values), -1.0, 1.0)
        return action
