"""Jambs that a marked doorway gets from the walls beside it."""

from __future__ import annotations

import math

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import STRtree

from semnav_env.world.maps.importers.fitting import fit_door
from semnav_env.world.maps.importers.labels import DoorLabel
from semnav_features.frames import Point, Pose, to_parent

metres = st.floats(-20.0, 20.0)
poses = st.tuples(metres, metres, st.floats(-math.pi, math.pi))


def jambs_of(frame: Pose, walls: list[tuple[Point, Point]], label: tuple[Point, Point]):
    """The jambs fitted to a label; all is given, and answered, in a frame."""
    placed = [[to_parent(frame, end) for end in wall] for wall in walls]
    start, end = (to_parent(frame, point) for point in label)
    fit = fit_door(DoorLabel("door", start, end), STRtree(shapely.linestrings(placed)))
    assert fit is not None
    assert fit.open
    return [*fit.start, *fit.end]


@given(poses, st.floats(-0.3, 0.3), st.floats(-0.3, 0.3), st.floats(-0.15, 0.15))
@settings(max_examples=50, deadline=None)
def test_jambs_are_the_ends_of_the_walls_along_the_marked_line(
    frame: Pose, first: float, last: float, beside: float
) -> None:
    walls = [((0.0, 2.0), (2.0, 2.0)), ((3.0, 2.0), (7.0, 2.0))]
    label = (2.0 + first, 2.0 + beside), (3.0 + last, 2.0 + beside)
    truth = [*to_parent(frame, (2.0, 2.0)), *to_parent(frame, (3.0, 2.0))]
    assert jambs_of(frame, walls, label) == pytest.approx(truth, abs=1e-4)


def test_jambs_are_the_ends_of_walls_on_the_line_of_the_door() -> None:
    walls = [((0.0, 2.0), (2.0, 2.0)), ((3.0, 2.0), (7.0, 2.0))]
    here = jambs_of((0.0, 0.0, 0.0), walls, ((2.0, 2.0), (3.0, 2.0)))
    assert here == pytest.approx([2.0, 2.0, 3.0, 2.0], abs=1e-9)
