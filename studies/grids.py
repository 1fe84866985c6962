"""`python -m studies grids`: our kernels on grids beside those of SciPy."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import dijkstra

from semnav_env.world.grid.costs import costs_from
from semnav_env.world.grid.distance import distance_to_marked
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import FloatArray
from studies.tour.villa import villa


@dataclass(frozen=True)
class Arguments:
    """Compare least costs and distances on grids with SciPy's, in milliseconds of processor time.

    The graph that SciPy searches is made beforehand, which is not counted.

    Attributes:
        plans: names of floor plans; `villa` is that of the study `tour`.
        repeats: how often each is run; the least time counts.
    """

    plans: tuple[str, ...] = ("office_cross", "office:large:1", "villa")
    repeats: int = 20

    def run(self) -> int:
        """Print a row for each plan."""
        print("| plan | cells | least costs | dijkstra | distances | SciPy's | same bits |")
        print("|---|---|---|---|---|---|---|")
        for name in self.plans:
            self._compare(name, villa() if name == "villa" else load_floor_plan(name))
        return 0

    def _compare(self, name: str, plan: FloorPlan) -> None:
        geodesic = Geodesic(plan)
        free, spacing, places = geodesic.free, geodesic.grid.spacing, np.argwhere(geodesic.free)
        row, column = places[len(places) // 2].tolist()
        weight = np.where(free, 1.0, np.inf)
        graph, source = graph_of(weight, spacing), row * free.shape[1] + column
        runs: tuple[Callable[[], FloatArray], ...] = (
            lambda: costs_from((row, column), weight, spacing),
            lambda: dijkstra(graph, directed=False, indices=source).reshape(free.shape),
            lambda: _distances(~free, spacing),
            lambda: spacing * np.asarray(distance_transform_edt(free)),
        )
        times = " | ".join(f"{self._milliseconds(run):.2f}" for run in runs)
        costs, their_costs, away, their_away = (run() for run in runs)
        same = np.array_equal(costs, their_costs) and np.array_equal(away, their_away)
        print(f"| {name} | {free.size:,} | {times} | {'yes' if same else 'no'} |", flush=True)

    def _milliseconds(self, run: Callable[[], object]) -> float:
        run()
        best = math.inf
        for _ in range(self.repeats):
            start = time.process_time()
            run()
            best = min(best, time.process_time() - start)
        return 1e3 * best


def graph_of(weight: FloatArray, spacing: float) -> csr_array:
    """The cells of a grid and the costs of the steps between neighbours, each step once."""
    rows, columns = weight.shape
    number, parts = np.arange(rows * columns).reshape(rows, columns), []
    for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
        here = np.s_[: rows - down, max(0, -right) : columns - max(0, right)]
        there = np.s_[down:, max(0, right) : columns - max(0, -right)]
        price = spacing * math.hypot(down, right) * 0.5 * (weight[here] + weight[there])
        leads = np.isfinite(price)
        parts.append((price[leads], number[here][leads], number[there][leads]))
    price, begin, end = (np.concatenate(part) for part in zip(*parts, strict=True))
    return coo_array((price, (begin, end)), shape=(number.size, number.size)).tocsr()


def _distances(marked: NDArray[np.bool_], spacing: float) -> FloatArray:
    distance = np.empty(marked.shape)
    distance_to_marked(marked, spacing, distance)
    return distance
