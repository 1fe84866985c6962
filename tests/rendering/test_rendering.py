"""Pictures: deterministic, and everything in a frame leaves its trace."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from semnav_env.mind.grounding.goal import PassGoal, ReachGoal, SeekGoal, StopGoal
from semnav_env.rendering.frame import Frame
from semnav_env.rendering.legend import LEGEND_HEIGHT, ROW_HEIGHT, legend_entries
from semnav_env.rendering.viewer import Viewer
from semnav_env.robots import SPOT, WHEELCHAIR
from semnav_env.world.maps.floor_plan import Material, Surface
from semnav_features.scene import Corner, CornerKind, CorridorProbe, Scene, Wall
from tests.support.small_office import DOOR, PLAIN, PLAN, office

pytest.importorskip("pygame", reason="pictures need the extra `render`")

MAP_WIDTH = 676
BARE = replace(PLAN, surfaces=())
HATCHED = [Surface(((x / 5, -9.0), (x / 5, -2.0))) for x in range(15)]


@pytest.fixture(scope="module")
def viewer() -> Viewer:
    return Viewer(PLAN)


def changed(before: NDArray[np.uint8], after: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Which pixels differ."""
    return np.any(before != after, axis=2)


def test_a_picture_has_the_size_that_was_asked_for() -> None:
    picture = Viewer(PLAN, size=(640, 480)).draw(PLAIN)
    assert picture.shape == (480, 640, 3)
    assert picture.dtype == np.uint8


def test_the_same_frame_gives_identical_pixels(viewer: Viewer) -> None:
    first = viewer.draw(PLAIN)
    viewer.draw(replace(PLAIN, pose=(7.0, 1.0, 2.0), command=("stop",)))
    np.testing.assert_array_equal(viewer.draw(PLAIN), first)
    np.testing.assert_array_equal(Viewer(PLAN).draw(PLAIN), first)


def test_each_picture_is_a_fresh_array(viewer: Viewer) -> None:
    first = viewer.draw(PLAIN)
    kept = first.copy()
    viewer.draw(PLAIN)[:] = 0
    np.testing.assert_array_equal(first, kept)


@pytest.mark.parametrize("robot", [WHEELCHAIR, SPOT], ids=lambda robot: robot.name)
def test_the_body_is_drawn_where_the_robot_is(viewer: Viewer, robot: object) -> None:
    start = replace(PLAIN, robot=robot, pose=(3.0, 3.0, 0.0))
    there = changed(viewer.draw(start), viewer.draw(replace(start, pose=(7.0, 1.0, 0.0))))
    scale = MAP_WIDTH / 10.8
    for x, y in ((3.0, 3.0), (7.0, 1.0)):
        column, row = round(scale * (x + 0.4)), round(360 - scale * (y - 2.0))
        assert there[row - 4 : row + 5, column - 12 : column + 13].any()
    assert not there[:, MAP_WIDTH + 10 :].any()


PLACE = (4.5, -1.0, -1.57)
FEATURES = {
    "wall": {"scene": Scene(walls=(Wall((0.0, 0.0), (4.0, 0.0)),))},
    "door": {"scene": Scene(doors=(DOOR,))},
    "corridor": {"scene": Scene(corridors=(CorridorProbe((6.0, 0.0), (6.0, 4.0)),))},
    "remembered wall": {"remembered": Scene(walls=(Wall((0.0, 0.1), (4.0, 0.1)),))},
    "remembered door": {"remembered": Scene(doors=(DOOR,))},
    "first door": {"remembered": Scene(doors=(DOOR,)), "door_numbers": {0: 1}},
    "second door": {"remembered": Scene(doors=(DOOR,)), "door_numbers": {0: 2}},
    "hits": {"hits": np.array([(6.0, 1.0), (6.0, 2.0)])},
    "beams": {"hits": np.array([(6.0, 1.0), (6.0, 2.0)]), "lidar": (3.4, 3.1)},
    "trail": {"trail": np.array([(1.0, 1.0), (3.0, 3.0)])},
    "route": {"route": np.array([(1.0, 1.0), (3.0, 3.0)])},
    "contact": {"in_contact": True},
    "status": {"status": ("t = 1.0 s",)},
    **{kind.name: {"scene": Scene(corners=(Corner((6.0, 1.0), kind),))} for kind in CornerKind},
    "seek": {"goal": SeekGoal(PLACE, "a door")},
    "reach": {"goal": ReachGoal(PLACE, 1.0)},
    "pass a door": {"goal": PassGoal(PLACE, DOOR)},
    "reach a door": {"goal": ReachGoal(PLACE, 1.0, door=DOOR)},
    "stop": {"goal": StopGoal(PLACE)},
}


def test_every_kind_of_feature_has_a_look_of_its_own(viewer: Viewer) -> None:
    pictures = [viewer.draw(replace(PLAIN, **fields)).tobytes() for fields in FEATURES.values()]
    assert viewer.draw(PLAIN).tobytes() not in pictures
    assert len(set(pictures)) == len(pictures)


def test_progress_through_the_command_shows(viewer: Viewer) -> None:
    command = ("go down the hallway", "turn left", "stop")
    pictures = {
        viewer.draw(replace(PLAIN, command=command, active_clause=active)).tobytes()
        for active in range(4)
    }
    assert len(pictures) == 4


ODD = {
    "long": ("go through the second door on the right " * 40,),
    "one long word": ("x" * 5000,),
    "many clauses": tuple(f"turn left at intersection {n}" for n in range(300)),
    "control characters": ("go\x00to\x1bthe\ndoor\ttoday",),
    "bidi and zero width": ("go \u202eleft\u202c \u200bnow\ufeff",),
    "lone surrogate": ("door \ud800",),
    "other scripts": ("去第二扇门 🚪 الباب",),
    "empty": ("", "   "),
}


@pytest.mark.parametrize("command", ODD.values(), ids=ODD.keys())
def test_odd_commands_stay_in_the_panel(viewer: Viewer, command: tuple[str, ...]) -> None:
    frame = replace(PLAIN, command=command, active_clause=len(command) // 2, status=command[:3])
    difference = changed(viewer.draw(PLAIN), viewer.draw(frame))
    assert difference.any()
    assert not difference[:, : MAP_WIDTH - 1].any()
    assert not difference[-180:].any(), "the legend is covered"


def test_the_legend_lists_what_the_plan_and_the_episode_hold() -> None:
    always = {name for name, _ in legend_entries(replace(PLAIN, floor_plan=BARE))}
    assert not always & {"glass", "furniture", "door leaf", "assumed wall", "person"}
    held = {
        Material.GLASS: "glass",
        Material.FURNITURE: "furniture",
        Material.LEAF: "door leaf",
        Material.WALL: None,
    }
    for material, name in held.items():
        plan = replace(BARE, surfaces=(Surface(((0.0, 0.0), (1.0, 0.0)), material),))
        listed = {name for name, _ in legend_entries(replace(PLAIN, floor_plan=plan))}
        assert listed - always == {name} - {None}
    moving = {"people": np.array([(6.0, 1.0, 0.3)]), "leaves": np.array([(4.0, 0.0, 5.0, 0.0)])}
    for (field, value), name in zip(moving.items(), ("person", "door leaf"), strict=True):
        frame = replace(PLAIN, floor_plan=BARE, **{field: value})
        assert {name for name, _ in legend_entries(frame)} - always == {name}
    everything = replace(PLAIN, **moving)
    assert "assumed wall" in {name for name, _ in legend_entries(everything)}


def test_the_longest_legend_fits_on_the_page(viewer: Viewer) -> None:
    everything = replace(PLAIN, people=np.array([(6.0, 1.0, 0.3)]))
    rows = -(-len(legend_entries(everything)) // 2)
    assert 22.0 + ROW_HEIGHT * (rows - 0.5) <= LEGEND_HEIGHT
    difference = changed(viewer.draw(PLAIN), viewer.draw(everything))
    assert difference[-int(LEGEND_HEIGHT) :, MAP_WIDTH:].any()


def test_the_scale_bar_is_read_over_walls_as_well() -> None:
    crossed = replace(PLAN, surfaces=(*PLAN.surfaces, *HATCHED))
    plain, over = (Viewer(p).draw(replace(PLAIN, floor_plan=p)) for p in (PLAN, crossed))
    assert changed(plain, over)[-36:-14, 155:].any()
    np.testing.assert_array_equal(plain[-36:-14, 16:130], over[-36:-14, 16:130])


def test_points_that_are_not_finite_are_left_out(viewer: Viewer) -> None:
    good = np.array([(6.0, 1.0), (6.0, 2.0)])
    bad = np.array([good[0], (math.nan, 0.0), good[1], (math.inf, 1.0)])
    expected = viewer.draw(replace(PLAIN, hits=good, lidar=(3.4, 3.1)))
    np.testing.assert_array_equal(viewer.draw(replace(PLAIN, hits=bad, lidar=(3.4, 3.1))), expected)


def test_things_far_outside_the_plan_draw(viewer: Viewer) -> None:
    far = replace(
        PLAIN,
        pose=(1e9, -1e9, 1.0),
        route=np.array([(0.0, 0.0), (1e12, 1e12)]),
        goal=ReachGoal((-1e7, 0.0, 0.0), 1.0),
    )
    assert viewer.draw(far).shape == (720, 960, 3)


def test_a_frame_of_another_plan_draws_that_plan(viewer: Viewer) -> None:
    other = office(7.0, 4.0)
    frame = Frame(other, WHEELCHAIR, (3.0, 3.0, 0.3))
    np.testing.assert_array_equal(viewer.draw(frame), Viewer(other).draw(frame))


@pytest.mark.parametrize("size", [(100, 100), (400, 800)])
def test_a_size_that_cannot_hold_the_picture_is_refused(size: tuple[int, int]) -> None:
    with pytest.raises(ValueError, match="at least"):
        Viewer(PLAN, size=size)


def test_a_frame_refuses_a_pose_that_is_not_finite() -> None:
    with pytest.raises(ValueError, match="finite"):
        replace(PLAIN, pose=(math.nan, 0.0, 0.0))


def test_a_frame_refuses_points_of_the_wrong_shape() -> None:
    with pytest.raises(ValueError, match=r"trail has shape \(3,\)"):
        replace(PLAIN, trail=np.zeros(3))


def test_a_frame_refuses_numbers_of_unknown_doors() -> None:
    with pytest.raises(ValueError, match="1 doors are remembered"):
        replace(PLAIN, remembered=Scene(doors=(DOOR,)), door_numbers={1: 1})
