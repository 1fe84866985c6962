"""Trains the ranker: a log-linear model, with a normal prior about its hand-made costs."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
from scipy.optimize import minimize
from scipy.sparse import csr_matrix

from studies.chart_reader.examples import SAMPLED, Example

LEAST_OFTEN = 4
"""A feature counts if so many texts have it."""

PRIOR = {"cost": -2.0, "none": -5.0}
"""Weights before training; the others are 0."""

DECAY, STEPS = 0.3, 100
"""Strength of the prior, and the most steps of the optimiser."""


SAMPLED_SHARE = 0.3
"""How much a sampled command counts beside what somebody wrote."""


class Trainer:
    """Examples as one sparse matrix, from any of which weights can be learned."""

    def __init__(self, examples: Sequence[Example]) -> None:
        self.examples = examples
        often = Counter(name for e in examples for name in {n for row in e.features for n in row})
        self.names = sorted(name for name, count in often.items() if count >= LEAST_OFTEN)
        index = {name: i for i, name in enumerate(self.names)}
        rows, columns, values = [], [], []
        self._start = [0]
        for each in examples:
            for row in each.features:
                known = [(index[name], value) for name, value in row.items() if name in index]
                columns += [column for column, _ in known]
                values += [value for _, value in known]
                rows.append(len(known))
            self._start.append(len(rows))
        pointers = np.concatenate([[0], np.cumsum(rows)])
        self._matrix = csr_matrix((values, columns, pointers), shape=(len(rows), len(self.names)))
        self._right = np.array([right for each in examples for right in each.right])
        self._prior = np.array([PRIOR.get(name, 0.0) for name in self.names])

    def train(self, which: Sequence[int]) -> np.ndarray:
        """Weights from some of the examples, by their numbers.

        Minimises -sum(log(p(right))) + DECAY * |w - prior|^2 over the texts.
        """
        spans = [(self._start[i], self._start[i + 1]) for i in which]
        chosen = np.concatenate([np.arange(*span) for span in spans])
        lengths = np.array([stop - start for start, stop in spans])
        starts = np.concatenate([[0], np.cumsum(lengths)[:-1]])
        matrix, right = self._matrix[chosen], self._right[chosen]
        shares = np.array(
            [SAMPLED_SHARE if self.examples[i].author == SAMPLED else 1.0 for i in which]
        )
        of_rows = np.repeat(shares, lengths)
        transposed = matrix.T.tocsr()

        def loss(weights: np.ndarray) -> tuple[float, np.ndarray]:
            scores = matrix @ weights
            raised = np.exp(scores - np.repeat(np.maximum.reduceat(scores, starts), lengths))
            every = np.add.reduceat(raised, starts)
            good = np.maximum(np.add.reduceat(raised * right, starts), 1e-300)
            away = weights - self._prior
            slope = raised / np.repeat(every, lengths) - raised * right / np.repeat(good, lengths)
            total = float(shares @ (np.log(every) - np.log(good)) + DECAY * away @ away)
            return total, transposed @ (of_rows * slope) + 2 * DECAY * away

        found = minimize(loss, self._prior, jac=True, method="L-BFGS-B", options={"maxiter": STEPS})
        weights: np.ndarray = found.x
        return weights

    def probabilities(self, i: int, weights: np.ndarray) -> np.ndarray:
        """The probability of each candidate of an example."""
        scores = self._matrix[self._start[i] : self._start[i + 1]] @ weights
        raised = np.exp(scores - scores.max())
        found: np.ndarray = raised / raised.sum()
        return found
