"""Thin outlines: what blocks a line of sight and what does not."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from semnav_agents.searching.outlines import FINER, crossed
from semnav_agents.searching.search_map import HIT, SearchMap
from semnav_agents.searching.settings import SearchSettings
from semnav_features.frames import FloatArray

NOISE, SQUARE = 0.02, np.eye(2)
ANGLES = st.floats(0.0, math.pi)
OFFSETS = st.floats(-0.05, 0.05)


def chart_of(points: FloatArray, beams: FloatArray = SQUARE) -> SearchMap:
    """A map of 4 m by 4 m around the origin in which beams of some directions ended at points."""
    chart = SearchMap(SearchSettings(), (-2.0, -2.0), (2.0, 2.0))
    rng = np.random.default_rng(0)
    hits = np.repeat(points, 6, axis=0)
    hits = hits + NOISE * np.clip(rng.standard_normal((len(hits), len(beams))), -2.5, 2.5) @ beams
    chart.add_hits(hits)
    chart.hits[chart.grid.cells(*hits.T)] = HIT
    return chart


def line(start: tuple[float, float], end: tuple[float, float]) -> FloatArray:
    """Points on a line, a centimetre apart."""
    shares = np.linspace(0.0, 1.0, round(100 * math.dist(start, end)) + 1)[:, None]
    return np.asarray(np.array(start) + shares * (np.array(end) - np.array(start)))


def passes(chart: SearchMap, start: tuple[float, float], end: tuple[float, float]) -> bool:
    """Whether a ray from one point gets to another."""
    (outline, near), (west, south, spacing) = chart.sight(), chart.grid.frame
    length = math.dist(start, end)
    dx, dy = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    for i in range(int(length / spacing) + 1):
        x = (start[0] + i * spacing * dx - west) / spacing
        y = (start[1] + i * spacing * dy - south) / spacing
        if near[round(y), round(x)] and crossed(outline, x, y, dx, dy):
            return False
    return True


@given(angle=ANGLES, offset=OFFSETS, aside=st.floats(-0.9, 0.9), slant=st.floats(-1.2, 1.2))
def test_no_ray_gets_through_a_wall(
    angle: float, offset: float, aside: float, slant: float
) -> None:
    c, s = math.cos(angle), math.sin(angle)

    def place(along: float, across: float) -> tuple[float, float]:
        return c * along - s * (across + offset), s * along + c * (across + offset)

    chart = chart_of(line(place(-1.5, 0.0), place(1.5, 0.0)))
    half = 0.5 * math.tan(slant) * 0.5
    assert not passes(chart, place(aside - half, -0.5), place(aside + half, 0.5))


@given(angle=ANGLES, offset=OFFSETS)
def test_errors_of_ranges_do_not_thicken_an_outline(angle: float, offset: float) -> None:
    c, s = math.cos(angle), math.sin(angle)
    chart = chart_of(line((-1.5 * c - s * offset, -1.5 * s), (1.5 * c - s * offset, 1.5 * s)))
    outline, _ = chart.sight()
    rows, columns = np.nonzero(outline)
    spacing = chart.grid.spacing / FINER
    west, south = (corner - 0.5 * chart.grid.spacing for corner in chart.grid.frame[:2])
    x, y = west + spacing * (columns + 0.5), south + spacing * (rows + 0.5)
    away = np.abs(c * y - s * (x + s * offset))
    rows, columns = np.nonzero(chart.solid)
    x, y = chart.grid.points(np.column_stack((rows, columns))).T
    band = np.abs(c * y - s * (x + s * offset))
    assert np.quantile(away, 0.95) < 0.035
    assert np.quantile(band, 0.95) > 0.045


@given(shift=st.floats(0.0, 0.05))
def test_a_gap_that_noise_closes_in_the_cells_stays_open(shift: float) -> None:
    left, right = line((-1.5, 0.0), (shift, 0.0)), line((shift + 0.15, 0.0), (1.5, 0.0))
    chart = chart_of(np.vstack((left, right)), np.array([[0.6, 0.8]]))  # beams fall in at a slant
    middle = shift + 0.075
    assert passes(chart, (middle, -0.5), (middle, 0.5))
    assert not passes(chart, (middle - 0.2, -0.5), (middle - 0.2, 0.5))
    assert not passes(chart, (middle + 0.2, -0.5), (middle + 0.2, 0.5))


def test_a_solid_cell_without_hits_blocks_from_its_middle() -> None:
    chart = SearchMap(SearchSettings(), (-2.0, -2.0), (2.0, 2.0))
    chart.walls[chart.grid.cells(*line((-1.5, 0.0), (1.5, 0.0)).T)] = True
    assert not passes(chart, (0.3, -0.5), (0.3, 0.5))
    assert passes(chart, (1.7, -0.5), (1.7, 0.5))
