"""Grids: the cheapest ways and distances, against SciPy; where cells lie; which one is nearest."""

from __future__ import annotations

import math

import numpy as np
import shapely
import shapely.affinity
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt
from scipy.sparse import lil_array
from scipy.sparse.csgraph import dijkstra

from semnav_env.world.grid.cells import Grid
from semnav_env.world.grid.costs import ANYWHERE, costs_from, descent, nearest_reached
from semnav_env.world.grid.distance import distance_to_marked
from semnav_env.world.grid.occupancy import mark_inside
from semnav_env.world.maps.floor_plan import edges_of
from semnav_features.frames import FloatArray

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
    costs = costs_from(source, weight, 1.0)
    np.testing.assert_array_equal(costs, costs_by_dijkstra(source, weight))


@given(st.integers(2, 9), st.integers(0, 2**31))
def test_descent_leads_downhill_to_the_source(size: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    source, start = rng.integers(0, size, (2, 2))
    costs = costs_from((int(source[0]), int(source[1])), np.ones((size, size)), 1.0)
    cells = descent(costs, *start.tolist(), size * size)
    assert (cells[0] == start).all()
    assert (cells[-1] == source).all()
    assert (np.diff(costs[tuple(cells.T)]) < 0.0).all()


@given(arrays(np.bool_, array_shapes(min_dims=2, max_dims=2, max_side=40)))
def test_distances_are_those_of_scipy_to_the_last_bit(marked: NDArray[np.bool_]) -> None:
    distance = np.empty(marked.shape)
    distance_to_marked(marked, 0.05, distance)
    if not marked.any():  # SciPy has no answer
        assert np.isinf(distance).all()
    else:
        np.testing.assert_array_equal(distance, 0.05 * distance_transform_edt(~marked))


@given(
    st.integers(1, 30),
    st.integers(1, 30),
    st.floats(-40.0, 40.0),
    st.floats(-40.0, 40.0),
    st.sampled_from((1, 4, ANYWHERE)),
    st.integers(0, 2**31),
)
def test_the_nearest_cell_is_the_first_of_all_that_are_as_near(
    rows: int, columns: int, x: float, y: float, within: int, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    field = np.where(rng.random((rows, columns)) < 0.1, 1.0, np.inf)
    squared = (np.arange(rows)[:, None] - y) ** 2 + (np.arange(columns) - x) ** 2
    outside = np.maximum(
        abs(np.arange(rows)[:, None] - round(y)), abs(np.arange(columns) - round(x))
    )
    squared[np.isinf(field) | (outside > within)] = np.inf
    expected = (
        np.unravel_index(squared.argmin(), squared.shape) if squared.min() < np.inf else (-1, -1)
    )
    assert nearest_reached(field, 0.0, 0.0, 1.0, x, y, within) == expected


@given(st.floats(-9.0, 9.0), st.floats(-9.0, 9.0), st.integers(0, 4), st.integers(1, 4))
def test_the_cell_of_a_middle_is_that_cell(x: float, y: float, before: int, after: int) -> None:
    grid = Grid.over((x, y), (x + 3.05, y + 0.95), 0.1, before, after)
    assert grid.shape == (10 + before + after, 31 + before + after)
    cells = np.argwhere(np.ones(grid.shape, bool))
    points = grid.points(cells)
    np.testing.assert_array_equal(np.transpose(grid.cells(*points.T)), cells)
    assert [grid.cell((a, b)) for a, b in points.tolist()] == list(map(tuple, cells.tolist()))


def test_points_outside_have_the_nearest_cell_inside() -> None:
    grid = Grid.over((0.0, 0.0), (2.0, 1.0), 0.5)
    assert grid.cell((-7.0, 9.0)) == (2, 0)
    assert grid.cell((9.0, -7.0)) == (0, 4)


@given(st.integers(0, 2**31), st.integers(0, 3))
def test_the_cells_inside_are_those_that_shapely_finds(seed: int, areas: int) -> None:
    """Overlapping areas with bays and holes; no edge meets the middle of a cell."""
    rng = np.random.default_rng(seed)
    boxes = [shapely.box(*rng.uniform(-2, 8, 4)) for _ in range(3 * areas)]
    shapes = [(boxes[3 * k] - boxes[3 * k + 1]) | boxes[3 * k + 2] for k in range(areas)]
    shapes = [shapely.affinity.rotate(shape, 40.0 * k) for k, shape in enumerate(shapes)]
    edges = [edges_of(shape) for shape in shapes]
    starts = np.cumsum([0, *map(len, edges)])
    grid = Grid(0.0, 0.5, 0.25, 20, 30)
    inside = np.zeros(grid.shape, np.bool_)
    mark_inside(inside, np.vstack((np.empty((0, 4)), *edges)), starts, *grid.frame)
    expected = shapely.contains_xy(shapely.union_all(shapes), grid.x, grid.y[:, None])
    np.testing.assert_array_equal(inside, expected)
