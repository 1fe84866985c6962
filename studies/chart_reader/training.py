"""Trains the ranker: a log-linear model by AdaGrad, with a prior on its hand-made costs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from studies.chart_reader.examples import Example

LEAST_OFTEN = 5
"""A feature counts if so many candidates have it."""

PRIOR = {"cost": -2.0, "none": -9.0}
"""Weights before training."""

EPOCHS, RATE, DECAY = 40, 0.06, 0.3


class Trainer:
    """Examples as matrices, from which any part can be trained on."""

    def __init__(self, examples: Sequence[Example]) -> None:
        self.examples = examples
        often = Counter(name for each in examples for row in each.features for name in row)
        self.names = sorted(name for name, count in often.items() if count >= LEAST_OFTEN)
        index = {name: i for i, name in enumerate(self.names)}
        self.prior = np.array([PRIOR.get(name, 0.0) for name in self.names])
        self.rows = []
        for each in examples:
            matrix = np.zeros((len(each.features), len(self.names)))
            for r, row in enumerate(each.features):
                for name, value in row.items():
                    if name in index:
                        matrix[r, index[name]] = value
            used = np.flatnonzero(matrix.any(axis=0))
            self.rows.append((used, matrix[:, used]))

    def train(self, which: Sequence[int]) -> np.ndarray:
        """Weights from some of the examples, by their numbers."""
        weights = self.prior.copy()
        squares = np.full(len(weights), 1e-6)
        generator = np.random.default_rng(0)
        decay = DECAY / len(which)
        for _ in range(EPOCHS):
            for i in generator.permutation(which):
                used, matrix = self.rows[i]
                chance = softmax(matrix @ weights[used])
                aim = np.where(self.examples[i].right, chance, 0.0)
                aim /= max(aim.sum(), 1e-12)
                slope = matrix.T @ (chance - aim) + decay * (weights[used] - self.prior[used])
                squares[used] += slope * slope
                weights[used] -= RATE * slope / np.sqrt(squares[used])
        return weights

    def probabilities(self, i: int, weights: np.ndarray) -> np.ndarray:
        """The probability of each candidate of an example."""
        used, matrix = self.rows[i]
        return softmax(matrix @ weights[used])


def softmax(scores: np.ndarray) -> np.ndarray:
    """Probabilities of scores."""
    raised = np.exp(scores - scores.max())
    found: np.ndarray = raised / raised.sum()
    return found
