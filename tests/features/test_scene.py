from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_features import Corner, CornerKind, CorridorProbe, Door, Scene, Wall
from semnav_features.frames import Pose

coordinates = st.floats(-20.0, 20.0)
poses = st.tuples(coordinates, coordinates, st.floats(-math.pi, math.pi))

SCENE = Scene(
    walls=(Wall((1.0, -1.0), (1.0, 2.0), end_break=True, beams=40, residual=0.01),),
    doors=(Door((0.0, 1.0), (1.0, 1.0), name="office"),),
    corners=(Corner((3.0, 4.0), CornerKind.INNER),),
    corridors=(CorridorProbe((0.0, -1.0), (0.0, 1.0)),),
)


@given(poses)
def test_seeing_a_scene_from_where_it_was_placed_gives_it_back(pose: Pose) -> None:
    back = SCENE.placed(pose).seen_from(pose)
    assert back.walls[0].start == pytest.approx(SCENE.walls[0].start)
    assert back.doors[0].end == pytest.approx(SCENE.doors[0].end)
    assert back.corners[0].point == pytest.approx(SCENE.corners[0].point)
    assert back.corridors[0].midpoint == pytest.approx(SCENE.corridors[0].midpoint, abs=1e-9)


@given(poses)
def test_placing_a_scene_changes_positions_only(pose: Pose) -> None:
    placed = SCENE.placed(pose)
    assert placed.walls[0].length == pytest.approx(3.0)
    assert placed.doors[0].width == pytest.approx(1.0)
    assert placed.doors[0].name == "office"
    assert placed.walls[0].end_break
    assert placed.walls[0].beams == 40
    assert placed.corners[0].kind is CornerKind.INNER


def test_a_quarter_turn_to_the_left_turns_forward_into_left() -> None:
    placed = Scene(doors=(Door((1.0, 0.0), (2.0, 0.0)),)).placed((0.0, 0.0, math.pi / 2))
    assert placed.doors[0].midpoint == pytest.approx((0.0, 1.5))


def test_the_heading_of_a_wall_points_from_its_start_to_its_end() -> None:
    assert Wall((1.0, 1.0), (1.0, 3.0)).heading == pytest.approx(math.pi / 2)
