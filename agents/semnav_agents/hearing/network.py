"""The grounding network as the robot runs it: NumPy alone.

A clause and a set of elements go in. Every element proposes where the goal lies, seen from itself,
and how likely it is the one that the clause is about: a mixture of as many poses (Bishop 1994). The
encoder is that of a transformer without positions (Vaswani et al. 2017, with the normalisation
first), so the order of the elements does not matter (Lee et al. 2019, "Set Transformer").
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from semnav_agents.hearing.elements import ELEMENT_SIZE, Description
from semnav_agents.hearing.tokens import COMMAND_SIZE
from semnav_env.networks.card import Card, TransformerSettings
from semnav_env.networks.layers import (
    Array,
    Shapes,
    attention,
    layer_norm,
    linear,
    linear_shapes,
    norm_shapes,
    perceptron,
    perceptron_shapes,
    softmax,
)
from semnav_env.networks.weights import check_tensors, load_weights
from semnav_features.checked_fields import Count
from semnav_features.frames import Pose, compose, relative

KINDS, ADVANCES, OFFSETS, QUERY_OUTPUTS = 4, 3, 4, 6
"""Kinds of goals; by how many clauses to go on, 0 to 2; numbers of a proposal: forward, left, and
the change of heading as a direction; and numbers about the goal as a whole: its kind, whether it
has a door, and how far along its heading the next clause begins, metres."""

FIT_SIZE = 9 + KINDS
"""Numbers that say how the robot stands to the proposed goal."""

MASKED = -1e9
"""Score of an element that does not count."""


@dataclass(frozen=True)
class NetworkShape(TransformerSettings):
    """Sizes of the network; the width is that of the encoding of an element."""

    KIND = "grounding"

    layers: Count = 3

    def tensors(self) -> Shapes:
        """The shape of every tensor by name; weights are (outputs, inputs)."""
        d, h = self.width, self.hidden
        shapes = perceptron_shapes("embed", ELEMENT_SIZE, h, d)
        shapes |= perceptron_shapes("command", COMMAND_SIZE, h, 2 * d)
        shapes |= perceptron_shapes("offset", d, h, OFFSETS + 1)
        shapes |= perceptron_shapes("goal", d, h, QUERY_OUTPUTS)
        shapes |= perceptron_shapes("advance", d + FIT_SIZE, h, ADVANCES)
        for k in range(self.layers):
            shapes |= linear_shapes(f"{k}.attend", d, 3 * d) | linear_shapes(f"{k}.merge", d, d)
            shapes |= perceptron_shapes(f"{k}.feed", d, h, d)
        shapes |= norm_shapes("norm", d)
        for k in range(self.layers):
            shapes |= norm_shapes(f"{k}.norm.0", d) | norm_shapes(f"{k}.norm.1", d)
        return shapes


@dataclass(frozen=True)
class NetworkOutput:
    """The output of the network for a clause and a set of elements.

    Attributes:
        kinds: probability of each kind of goal.
        pose: of the goal, in the frame of the description.
        element: index of the element that the clause is about.
        door: index of the element that is the door of the goal; None without a door.
        next_along: how far from the goal along its heading the next clause begins, metres.
        advances: probability of going on by 0, 1 or 2 clauses.
    """

    kinds: Array
    pose: Pose
    element: int
    door: int | None
    next_along: float
    advances: Array


class GroundingNetwork:
    """A trained network.

    Args:
        shape: of the network.
        tensors: its weights by name, see `NetworkShape.tensors`.

    Raises:
        ValueError: a tensor is missing, too many, of another shape or type, or not finite.
    """

    def __init__(self, shape: NetworkShape, tensors: Mapping[str, Array]) -> None:
        check_tensors(tensors, shape.tensors())
        self.shape, self._tensors = shape, tensors

    @classmethod
    def load(cls, folder: Path) -> GroundingNetwork:
        """The network of a folder.

        Raises:
            ValueError: there is none, it is damaged, or it does not fit this version.
            OSError: a file cannot be read.
        """
        shape = Card.read(folder, NetworkShape).settings
        return cls(shape, load_weights(folder, shape.tensors()))

    def ground(self, description: Description) -> NetworkOutput:
        """Ground the current clause: its goal, and whether the clause is done."""
        count = int(description.mask.sum())
        scores, offsets, outputs, query = self.encode(
            description.elements[:count], description.command
        )
        element = int(np.argmax(scores))
        base = tuple(description.bases[element].tolist())
        ahead, aside, cosine, sine = offsets[element].tolist()
        pose = compose(base, (ahead, aside, math.atan2(sine, 1.0 + cosine)))
        kinds = softmax(outputs[:KINDS])
        fit = fit_of(relative(pose, description.robot), kinds, description.elements[0])
        advances = softmax(self._perceptron("advance", np.concatenate((query, fit))))
        doors = np.flatnonzero(description.jambs[:count].any(axis=1))
        door = None
        if outputs[KINDS] > 0.0 and len(doors):
            door = int(doors[np.argmax(scores[doors])])
        return NetworkOutput(kinds, pose, element, door, float(outputs[KINDS + 1]), advances)

    def encode(self, elements: Array, command: Array) -> tuple[Array, Array, Array, Array]:
        """Scores (n,) and offsets (n, 4) of the elements; outputs (6,) and encoding (d,) of all.

        Args:
            elements: shape (n, ELEMENT_SIZE).
            command: shape (COMMAND_SIZE,).
        """
        d = self.shape.width
        told = self._perceptron("command", command)
        x = np.vstack((told[:d], self._perceptron("embed", elements) + told[d:]))
        for k in range(self.shape.layers):
            x = x + self._attend(k, layer_norm(self._tensors, f"{k}.norm.0", x))
            x = x + self._perceptron(f"{k}.feed", layer_norm(self._tensors, f"{k}.norm.1", x))
        x = layer_norm(self._tensors, "norm", x)
        proposals = self._perceptron("offset", x[1:])
        return proposals[:, 0], proposals[:, 1:], self._perceptron("goal", x[0]), x[0]

    def _attend(self, k: int, x: Array) -> Array:
        parts = linear(self._tensors, f"{k}.attend", x).reshape(len(x), 3, self.shape.heads, -1)
        mixed = attention(parts[:, 0], parts[:, 1], parts[:, 2])
        return linear(self._tensors, f"{k}.merge", mixed)

    def _perceptron(self, name: str, x: Array) -> Array:
        return perceptron(self._tensors, name, x)


def fit_of(robot: Pose, kinds: Array, own: Array) -> Array:
    """Features of the robot's pose relative to the proposed goal, shape (FIT_SIZE,).

    Args:
        robot: its pose in the goal's frame.
        kinds: probabilities of the kinds of goals.
        own: the robot's element.
    """
    x, y, turned = robot
    numbers = (
        *(min(max(x, -3.0), 3.0), min(max(y, -3.0), 3.0)),
        *(math.tanh(x / 0.3), math.tanh(y / 0.3), min(math.hypot(x, y), 3.0)),
        *(math.cos(turned), math.sin(turned), abs(math.atan2(math.sin(turned), math.cos(turned)))),
        float(own[STILL]),
    )
    return np.concatenate((np.array(numbers, np.float32), kinds))


STILL = ELEMENT_SIZE - 7
"""Where in the robot's element it says for how long it has stood."""
