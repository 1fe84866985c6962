"""Places to look from, and where a searcher goes when nothing is left to look at."""

from __future__ import annotations

import math

import numpy as np
import pytest

from semnav_env.agents.searching.search_map import FREE, HIT, LOOKED, SAFE, SearchMap
from semnav_env.agents.searching.searcher import Searcher
from semnav_env.agents.searching.settings import SearchSettings
from semnav_env.agents.searching.view_kernels import fits
from semnav_env.agents.searching.views import Looker, ViewGrid, best_view, shown_from, ways_from
from semnav_env.features.frames import compose
from semnav_env.robots import SPOT

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
    row, column = chart.cell((0.2, 0.0))
    chart.hits[:, column] = 10 * HIT  # a wall right before the middle, behind the camera
    shown = shown_from(chart, (0.0, 0.0, 0.0), LOOKER)
    eye = compose((0.0, 0.0, 0.0), SPOT.lidar_mount)
    assert eye[0] > 0.2
    assert shown[row, chart.cell((1.0, 0.0))[1]]
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
