"""Walls, doors and arcs by themselves."""

import math

import pytest

from semnav_features import Arc, Scene, Wall


def test_a_column_spans_the_half_that_faces_the_scanner() -> None:
    column = Arc((3.0, 0.0), 0.5, (3.0, -0.5), (3.0, 0.5), convex=True)
    assert column.extent == pytest.approx(math.pi)


def test_a_hollow_wall_spans_its_beams_counter_clockwise() -> None:
    bay = Arc((1.0, 0.0), 2.0, (1.0, -2.0), (1.0, 2.0), convex=False)
    assert bay.extent == pytest.approx(math.pi)
    quarter = Arc((0.0, 0.0), 2.0, (2.0, 0.0), (0.0, 2.0), convex=False)
    assert quarter.extent == pytest.approx(math.pi / 2)


def test_every_point_of_a_scene_moves_with_it() -> None:
    scene = Scene(
        walls=(Wall((1.0, 0.0), (2.0, 0.0), centroid=(1.5, 0.0)), Wall((0.0, 1.0), (0.0, 2.0))),
        arcs=(Arc((3.0, 0.0), 0.5, (3.0, -0.5), (3.0, 0.5)),),
    )
    moved = scene.placed((1.0, 2.0, math.pi / 2))
    assert moved.walls[0].centroid == pytest.approx((1.0, 3.5))
    assert moved.walls[1].centroid is None
    assert moved.arcs[0].centre == pytest.approx((1.0, 5.0))
    back = moved.seen_from((1.0, 2.0, math.pi / 2))
    assert back.arcs[0].end == pytest.approx(scene.arcs[0].end)
