"""Places to look from, and where a searcher goes when nothing is left to look at."""

from __future__ import annotations

import math

import numpy as np
import pytest

from semnav_agents.searching.search_map import FREE, HIT, LOOKED, SAFE, SearchMap, without_lost
from semnav_agents.searching.searcher import Searcher
from semnav_agents.searching.settings import SearchSettings
from semnav_agents.searching.view_kernels import fits
from semnav_agents.searching.views import Looker, ViewGrid, best_view, shown_from
from semnav_agents.searching.ways import ways_from
from semnav_env.robots import SPOT
from semnav_features.frames import compose

LOOKER = Looker(SPOT, math.radians(120.0), 6.0)
GRID = ViewGrid(0.35, 60)


def floor() -> SearchMap:
    """An empty hall of 6 m by 4 m around the origin, with walls around, nothing looked at."""
    chart = SearchMap(SearchSettings(), (-3.0, -2.0), (3.0, 2.0))
    chart.found[:] = FREE | SAFE
    for rim in (chart.hits[0], chart.hits[-1], chart.hits[:, 0], chart.hits[:, -1]):
        rim[:] = 10 * HIT
    return chart


def test_a_view_shows_what_it_was_chosen_for() -> None:
    chart, pose = floor(), (0.0, 0.0, 0.0)
    view = best_view(chart, ways_from(chart, pose[:2], 0.3), pose, LOOKER, GRID)
    assert view is not None
    shown = np.flatnonzero(shown_from(chart, view.pose, LOOKER))
    assert np.array_equal(view.cells, shown)
    assert 0.0025 * len(shown) == pytest.approx(view.gain, rel=0.15)


def test_a_look_is_taken_from_the_camera_and_not_from_the_middle() -> None:
    chart = floor()
    row, column = chart.grid.cell((0.2, 0.0))
    chart.hits[:, column] = 10 * HIT  # a wall right before the middle, behind the camera
    shown = shown_from(chart, (0.0, 0.0, 0.0), LOOKER)
    eye = compose((0.0, 0.0, 0.0), SPOT.lidar_mount)
    assert eye[0] > 0.2
    assert shown[row, chart.grid.cell((1.0, 0.0))[1]]
    assert not shown[:, :column].any()


def test_no_view_where_nothing_is_left() -> None:
    chart, pose = floor(), (0.0, 0.0, 0.0)
    chart.found[:] |= LOOKED
    assert best_view(chart, ways_from(chart, pose[:2], 0.3), pose, LOOKER, GRID) is None


def test_a_place_that_failed_is_not_looked_from_again() -> None:
    chart, pose = floor(), (0.0, 0.0, 0.0)
    ways = ways_from(chart, pose[:2], 0.3)
    first = best_view(chart, ways, pose, LOOKER, GRID)
    assert first is not None
    other = best_view(chart, ways, pose, LOOKER, GRID, [(*first.pose[:2], 0.5)])
    assert other is not None
    assert math.dist(first.pose[:2], other.pose[:2]) > 0.45


@pytest.mark.parametrize(
    ("heading", "free"), [(0.0, True), (math.pi / 2, False)], ids=["along", "across"]
)
def test_a_body_fits_along_a_passage_and_not_across_it(heading: float, free: bool) -> None:
    y = np.abs(np.arange(-1.0, 1.01, 0.05))
    room = np.repeat(np.maximum(0.4 - y, 0.0)[:, None], 61, axis=1)  # 0.8 m wide
    half = LOOKER.half_size(0.05)
    assert fits((0.0, 0.0, heading), half, room, -1.5, -1.0, 0.05) is free


def test_a_searcher_goes_back_when_nothing_is_left() -> None:
    chart = floor()
    searcher = Searcher(chart, LOOKER)
    start, away = (-1.0, 0.0, 0.0), (1.0, 0.0, 0.0)
    assert searcher.update(start, []) not in (None, start)
    chart.found[:] |= LOOKED
    targets = [searcher.update(away, []) for _ in range(40)]
    assert targets[-1] == start
    assert searcher.done


def test_a_searcher_that_moves_about_and_gets_no_nearer_gives_up() -> None:
    chart = floor()
    searcher = Searcher(chart, LOOKER)
    first = searcher.update((0.0, 0.0, 0.0), [])
    patience = chart.settings.long_patience
    poses = [(2.0, 1.0, 0.5 * (k % 2)) for k in range(patience + 20)]
    targets = [searcher.update(pose, []) for pose in poses]
    assert targets[patience // 2] == first
    assert targets[-1] != first


def test_a_beam_that_got_lost_shows_nothing_behind_the_wall_that_it_ought_to_have_met() -> None:
    chart, count = floor(), 81
    angles = np.linspace(-0.4, 0.4, count)
    beams = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    ranges = 1.0 / np.cos(angles)  # a wall 1 m ahead
    lost = ranges.copy()
    lost[40] = 10.0
    chart.found[:] = 0
    scan = without_lost(lost, 10.0)
    chart.update((0.0, 0.0, 0.0), beams, scan, math.radians(120.0), 6.0)
    behind = chart.grid.cell((1.5, 0.0))[1]
    assert np.isnan(scan[40])
    assert np.array_equal(np.delete(scan, 40), np.delete(ranges, 40))
    assert chart.has(LOOKED).any()
    assert not chart.has(LOOKED)[:, behind:].any()


def test_where_no_beam_returns_nothing_is() -> None:
    ranges = np.array([2.0, 10.0, 10.0, 10.0, 10.0, 3.0])
    seen = [2.0, math.nan, 10.0, 10.0, math.nan, 3.0]
    assert np.array_equal(without_lost(ranges, 10.0), seen, equal_nan=True)


def pocket() -> SearchMap:
    """The hall with a pocket at its end, behind a bend that a long body cannot take."""
    chart = floor()
    for x0, x1, y0, y1 in ((0.5, 3.0, -0.4, -0.4), (0.5, 2.2, 0.4, 0.4), (2.2, 2.2, 0.4, 2.0)):
        lower, upper = chart.grid.cell((x0, y0)), chart.grid.cell((x1, y1))
        chart.hits[lower[0] : upper[0] + 1, lower[1] : upper[1] + 1] = 10 * HIT
    return chart


def test_the_whole_body_does_not_get_to_where_its_middle_would() -> None:
    chart, pose = pocket(), (-1.0, 0.0, 0.0)
    place = np.array([2.6]), np.array([1.3]), np.array([math.pi / 2])
    before_it = np.array([1.2]), np.array([0.0]), np.array([0.0])
    without, asked = (ways_from(chart, pose[:2], 0.28, body) for body in (None, (SPOT, pose)))
    assert np.isfinite(asked.costs[chart.grid.cell((2.6, 1.3))])
    assert without.lead_to(*place).all()
    assert not asked.lead_to(*place).any()
    assert asked.lead_to(*before_it).all()


def test_a_searcher_that_fails_twice_goes_back_the_way_it_came() -> None:
    chart = floor()
    searcher = Searcher(chart, LOOKER)
    way = [(x, 0.0, 0.0) for x in np.arange(-2.0, 1.01, 0.2).tolist()]
    for pose in way:
        searcher.update(pose, [])
    stuck, patience = way[-1], chart.settings.patience
    targets = [searcher.update(stuck, []) for _ in range(3 * patience)]
    back = chart.settings.retreat
    assert any(
        target is not None and target in way and math.dist(target[:2], stuck[:2]) > back
        for target in targets
    )
