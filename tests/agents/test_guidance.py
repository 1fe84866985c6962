"""The kernels under the coarse way: against plain code that is slower and easier to check."""

from __future__ import annotations

import heapq
import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from semnav_agents.planning.collision import obstacle_field
from semnav_agents.planning.free import points_around
from semnav_agents.planning.heuristic import (
    COARSE_CELL,
    coarse_cell,
    least_seconds,
    seconds_at,
    seconds_to,
)
from semnav_agents.planning.motion import MotionCosts, crowding_at
from semnav_agents.planning.planner import PlannerSettings, _costs
from semnav_env.robots import WHEELCHAIR
from semnav_features.frames import FloatArray, points_to_local

COSTS = _costs(WHEELCHAIR, PlannerSettings())


def dijkstra(
    sources: NDArray[np.int64], first: FloatArray, room: FloatArray, costs: MotionCosts
) -> FloatArray:
    """Least times with a priority queue."""
    n, time = len(room), np.full(room.shape, np.inf)
    heap = [(t, j, i) for (j, i), t in zip(sources.tolist(), first.tolist(), strict=True)]
    for t, j, i in heap:
        time[j, i] = min(time[j, i], t)
    heapq.heapify(heap)
    while heap:
        t, j, i = heapq.heappop(heap)
        if t > time[j, i]:
            continue
        for b in range(max(0, j - 1), min(n, j + 2)):
            for a in range(max(0, i - 1), min(n, i + 2)):
                length = COARSE_CELL * math.sqrt((b - j) ** 2 + (a - i) ** 2)
                slow = 1.0 + crowding_at(room[b, a], costs)
                then = t + length / costs.speed * slow
                if room[b, a] >= 0.0 and then < time[b, a]:
                    time[b, a] = then
                    heapq.heappush(heap, (then, b, a))
    return time


@given(st.integers(3, 24), st.integers(1, 6), st.floats(0.0, 0.7), st.integers(0, 2**31))
def test_times_are_those_of_a_priority_queue_to_the_last_bit(
    size: int, count: int, blocked: float, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    room = np.where(rng.random((size, size)) < blocked, -1.0, 0.4 * rng.random((size, size)))
    sources = rng.integers(0, size, (count, 2))
    first = 5.0 * rng.random(count)
    np.testing.assert_array_equal(
        seconds_to(sources, first, room, COSTS), dijkstra(sources, first, room, COSTS)
    )


def test_a_source_at_no_finite_time_is_none() -> None:
    room = np.ones((4, 4))
    time = seconds_to(np.array([(1, 1), (2, 2)]), np.array([math.inf, math.nan]), room, COSTS)
    assert np.isinf(time).all()


@given(st.integers(0, 2**31), st.floats(0.0, 0.5))
def test_no_coarse_way_undercuts_the_least_time(seed: int, blocked: float) -> None:
    rng = np.random.default_rng(seed)
    field = obstacle_field(np.empty((0, 2)), (0.0, 0.0), 1.5)
    room = np.where(rng.random((30, 30)) < blocked, -1.0, rng.random((30, 30)))
    start, target = (tuple(rng.uniform(-1.4, 1.4, 2).tolist()) for _ in range(2))
    time = seconds_to(np.array([coarse_cell(field, *target)]), np.zeros(1), room, COSTS)
    assert seconds_at(field, time, *start) >= least_seconds(field, target, start, COSTS) - 1e-9


@given(st.floats(-9, 9), st.floats(-9, 9), st.floats(-4, 4), st.integers(0, 2**31))
def test_points_around_are_those_of_the_square_in_its_frame(
    x: float, y: float, heading: float, seed: int
) -> None:
    points = np.random.default_rng(seed).uniform(-12, 12, (60, 2))
    inside = (np.abs(points - (x, y)) < 3.0).all(axis=1)
    expected = points_to_local((x, y, heading), points[inside])
    np.testing.assert_allclose(points_around((x, y, heading), points, 3.0), expected, atol=1e-12)
