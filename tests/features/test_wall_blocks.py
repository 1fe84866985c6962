"""Remembered walls that are compared in blocks: none is lost that one by one would be found."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_features.frames import FloatArray
from semnav_features.kernels.drift import (
    MAX_LANDMARK_OFFSET,
    MIN_LANDMARK_SIGHTINGS,
    MIN_OVERLAP,
    MIN_PARALLEL_COSINE,
    _nearest_like,
)
from semnav_features.kernels.lanes import WIDTH
from semnav_features.kernels.memory import (
    SAME_DIRECTION_COSINE,
    _nearly_in_line,
    _on_one_line,
    remember_wall,
)
from semnav_features.kernels.remembered import HITS, VARIANCE, WALL_ROWS, Ends

seeds, sizes = st.integers(0, 2**32 - 1), st.integers(0, 8 * WIDTH + 3)


def drawn_walls(seed: int, count: int) -> FloatArray:
    """Remembered walls and one more, mostly along x and close together; the room is eight more."""
    rng = np.random.default_rng(seed)
    walls, room = np.zeros((WALL_ROWS, count + 1)), np.full((WALL_ROWS, WIDTH), np.nan)
    middle, half = rng.uniform(-4.0, 4.0, count + 1), rng.uniform(0.05, 3.0, count + 1)
    half *= np.where(rng.random(count + 1) < 0.1, -1.0, 1.0)
    walls[0], walls[2] = middle - half, middle + half
    walls[1] = rng.choice((0.0, 0.3, 2.0), count + 1) + rng.normal(0.0, 0.1, count + 1)
    walls[3] = walls[1] + rng.normal(0.0, 0.12, count + 1) * half
    walls[HITS] = rng.integers(0, 12, count + 1)
    return np.hstack((walls, room))


def one_of(walls: FloatArray, k: int) -> Ends:
    """The ends of a wall."""
    x1, y1, x2, y2 = walls[:HITS, k].tolist()
    return x1, y1, x2, y2


def nearest_one_by_one(wall: Ends, walls: FloatArray) -> tuple[int, float, float]:
    """The remembered wall nearest beside a wall, of all that are asked in turn."""
    x1, y1, x2, y2 = wall
    ux, uy = x2 - x1, y2 - y1
    nearest, found = MAX_LANDMARK_OFFSET, (-1, 0.0, 0.0)
    for k in range(walls.shape[1]):
        x, y, end_x, end_y = one_of(walls, k)
        dx, dy = end_x - x, end_y - y
        dot, square, size = ux * dx + uy * dy, dx * dx + dy * dy, ux * ux + uy * uy
        if dot < 0.0 or dot * dot < MIN_PARALLEL_COSINE**2 * size * square:
            continue
        length = math.sqrt(square)
        first = ((x1 - x) * dx + (y1 - y) * dy) / length
        last = ((x2 - x) * dx + (y2 - y) * dy) / length
        low, high = max(first, 0.0), min(last, length)
        if walls[HITS, k] < MIN_LANDMARK_SIGHTINGS or high - low < MIN_OVERLAP:
            continue
        low, high = (low - first) / (last - first), (high - first) / (last - first)
        share = 0.5 * (low + high)
        beside = abs((y1 + share * uy - y) * dx - (x1 + share * ux - x) * dy) / length
        if beside < nearest:
            nearest, found = beside, (k, low, high)
    return found


@given(seeds, sizes)
def test_the_nearest_landmark_is_the_one_found_one_by_one(seed: int, count: int) -> None:
    walls = drawn_walls(seed, count)
    wall, known = one_of(walls, count), np.ascontiguousarray(walls[:, :count])
    assert _nearest_like(wall, walls, count) == nearest_one_by_one(wall, known)


@given(seeds, st.integers(1, WIDTH))
def test_every_wall_on_one_line_with_another_is_marked(seed: int, count: int) -> None:
    """And as in a block of its own."""
    walls = drawn_walls(seed, count)
    wall = one_of(walls, count)
    length = math.hypot(wall[2] - wall[0], wall[3] - wall[1])
    along = (wall[2] - wall[0]) / length, (wall[3] - wall[1]) / length
    marked = int(_nearly_in_line(wall, along, walls, 0, count))
    for k in range(count):
        old = one_of(walls, k)
        dx, dy = old[2] - old[0], old[3] - old[1]
        cosine = (dx * along[0] + dy * along[1]) / math.hypot(dx, dy)
        is_marked = bool(marked >> k & 1)
        assert is_marked == bool(_nearly_in_line(wall, along, walls, k, k + 1))
        if cosine > SAME_DIRECTION_COSINE + 1e-12 and _on_one_line(old, wall):
            assert is_marked


@given(sizes)
def test_a_wall_seen_again_is_fused_in_whatever_block_it_is(count: int) -> None:
    known, used = np.zeros((WALL_ROWS, 9 * WIDTH)), 0
    for hits in (1, 2):
        for k in range(count):
            used = remember_wall((0.0, 1.0 * k, 2.0, 1.0 * k), known, used)
        assert used == count
        assert (known[HITS, :count] == hits).all()


@given(st.floats(0.0, 0.14))
def test_a_wall_with_a_ledge_varies_by_half_of_its_depth(depth: float) -> None:
    known, used = np.zeros((WALL_ROWS, WIDTH)), 0
    for _ in range(40):
        for y in (0.0, depth):
            used = remember_wall((0.0, y, 2.0, y), known, used)
    assert used == 1
    assert math.sqrt(known[VARIANCE, 0]) == pytest.approx(0.5 * depth, rel=0.15)
