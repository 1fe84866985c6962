"""The cheapest ways over a grid, against SciPy's Dijkstra."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import lil_array
from scipy.sparse.csgraph import dijkstra

from semnav_features.frames import FloatArray
from semnav_features.kernels.grid_search import descent, least_costs

DIAGONAL = math.sqrt(2.0)


def costs_by_dijkstra(source: tuple[int, int], weight: FloatArray) -> FloatArray:
    rows, columns = weight.shape
    graph = lil_array((weight.size, weight.size))
    for r, c in np.argwhere(np.isfinite(weight)).tolist():
        for b in range(max(r - 1, 0), min(r + 2, rows)):
            for a in range(max(c - 1, 0), min(c + 2, columns)):
                if (b, a) != (r, c) and math.isfinite(weight[b, a]):
                    length = DIAGONAL if b != r and a != c else 1.0
                    price = length * (weight[r, c] + weight[b, a]) / 2
                    graph[r * columns + c, b * columns + a] = price
    return dijkstra(graph.tocsr(), indices=source[0] * columns + source[1]).reshape(weight.shape)


@given(st.integers(1, 9), st.integers(1, 9), st.floats(0.0, 0.6), st.integers(0, 2**31))
def test_costs_are_those_of_dijkstra_to_the_last_bit(
    rows: int, columns: int, blocked: float, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    weight = 1.0 + 3.0 * rng.random((rows, columns))
    weight[rng.random(weight.shape) < blocked] = np.inf
    source = int(rng.integers(rows)), int(rng.integers(columns))
    weight[source] = 1.0
    costs = least_costs(np.array([source]), np.zeros(1), weight, 1.0, DIAGONAL, True)
    np.testing.assert_array_equal(costs, costs_by_dijkstra(source, weight))


@given(st.integers(2, 9), st.integers(0, 2**31))
def test_descent_leads_downhill_to_the_source(size: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    source, start = rng.integers(0, size, (2, 2))
    costs = least_costs(source[None], np.zeros(1), np.ones((size, size)), 1.0, DIAGONAL, True)
    cells = descent(costs, *start.tolist(), size * size)
    assert (cells[0] == start).all()
    assert (cells[-1] == source).all()
    assert (np.diff(costs[tuple(cells.T)]) < 0.0).all()
