"""By which door a robot leaves a room of which it has not seen everything."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.language import Leave, parse
from semnav_env.mind.grounding import PassGoal, ReachGoal, SeekGoal, ground
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.lookouts import MAX_LOOKOUTS, next_lookout
from semnav_features.frames import Pose, compose, to_parent
from semnav_features.scene import Door, Scene, Wall

HERE: Pose = (1.2, 2.0, 0.0)
AROUND: Pose = (1.2, 2.0, math.pi)
EXIT = Door((5.0, 1.5), (5.0, 2.5))
"""In the east wall of a room of 5 m by 4 m."""

GAP = Door((3.0, 1.4), (3.0, 2.6))
"""Between two cabinets across the room, before the exit."""

LEAVE = parse("leave the room")


def chain(*points: tuple[float, float]) -> tuple[Wall, ...]:
    return tuple(Wall(a, b) for a, b in pairwise(points))


ROOM = chain((5.0, 1.5), (5.0, 0.0), (0.0, 0.0), (0.0, 4.0), (5.0, 4.0), (5.0, 2.5))
CABINETS = (*chain((3.0, 0.0), (3.0, 1.4)), *chain((3.0, 2.6), (3.0, 4.0)))
CORRIDOR = (Wall((7.0, -9.0), (7.0, 9.0)),)
CLOSED = chain((0.0, 0.0), (0.0, 4.0), (5.0, 4.0), (5.0, 0.0), (0.0, 0.0))


def placed(scene: Scene, frame: Pose) -> Scene:
    def moved(item: Wall | Door) -> tuple[tuple[float, float], tuple[float, float]]:
        return to_parent(frame, item.start), to_parent(frame, item.end)

    return Scene(
        tuple(Wall(*moved(wall)) for wall in scene.walls),
        tuple(Door(*moved(door)) for door in scene.doors),
    )


FRAMES = st.tuples(st.floats(-9.0, 9.0), st.floats(-9.0, 9.0), st.floats(-math.pi, math.pi))


@given(FRAMES)
def test_a_gap_that_walls_shut_off_is_no_exit(frame: Pose) -> None:
    """The exit, which is seen through the gap, leads to a corridor; the gap into the same room."""
    scene = placed(Scene((*ROOM, *CABINETS, *CORRIDOR), (GAP, EXIT)), frame)
    goal = ground(Leave(), scene, compose(frame, HERE))
    assert isinstance(goal, PassGoal)
    assert goal.door == scene.doors[1]


def test_a_door_across_the_corridor_is_no_exit() -> None:
    across = Door((7.0, 1.5), (7.0, 2.5))
    far = (Wall((7.0, -9.0), (7.0, 1.5)), Wall((7.0, 2.5), (7.0, 9.0)))
    goal = ground(Leave(), Scene((*ROOM, *far), (across, EXIT)), HERE)
    assert isinstance(goal, PassGoal)
    assert goal.door == EXIT


def test_of_two_doors_in_view_the_robot_takes_the_more_open_one() -> None:
    """West of the room a gap of which less is known to be shut off than of a niche."""
    west = Door((0.0, 1.5), (0.0, 2.5))
    walls = chain((5.0, 1.5), (5.0, 0.0), (0.0, 0.0), (0.0, 1.5))
    walls += chain((0.0, 2.5), (0.0, 4.0), (5.0, 4.0), (5.0, 2.5))
    beyond = chain((0.0, 3.0), (-1.8, 3.0), (-1.8, 0.0))
    goal = ground(Leave(), Scene((*walls, *beyond, *CORRIDOR), (west, EXIT)), HERE)
    assert isinstance(goal, PassGoal)
    assert goal.door == EXIT


def test_a_robot_that_sees_no_exit_looks_from_other_places_of_the_room() -> None:
    """It turns around, then drives to places in the room; in the end it gives up."""
    scene = Scene(CLOSED, ())
    follower = Follower(LEAVE)
    follower.start(scene, HERE)
    assert isinstance(follower.goal, ReachGoal)
    pose, places = AROUND, []
    for _ in range(2 * MAX_LOOKOUTS):
        follower.look(scene, pose)
        if follower.impossible:
            break
        assert isinstance(follower.goal, SeekGoal)
        pose = follower.goal.pose
        places.append(pose[:2])
    assert "by which door" in (follower.impossible or "")
    assert 1 <= len(places) < MAX_LOOKOUTS
    for x, y in places:
        assert 0.3 < x < 4.7
        assert 0.3 < y < 3.7


def test_an_exit_that_is_hidden_from_the_begin_is_found_from_another_lookout() -> None:
    cabinet = chain((2.0, 4.0), (2.0, 2.2), (2.5, 2.2), (2.5, 4.0))
    hidden = Door((3.0, 4.0), (4.0, 4.0))
    walls = chain((4.0, 4.0), (5.0, 4.0), (5.0, 0.0), (0.0, 0.0), (0.0, 4.0), (3.0, 4.0))
    scene = Scene((*walls, *cabinet, Wall((-9.0, 6.0), (9.0, 6.0))), (hidden,))
    begin: Pose = (1.0, 3.0, 0.0)
    follower = Follower(LEAVE)
    follower.start(scene, begin)
    follower.look(scene, (1.0, 3.0, math.pi))
    assert isinstance(follower.goal, SeekGoal)
    for _ in range(MAX_LOOKOUTS):
        if isinstance(follower.goal, SeekGoal):
            follower.look(scene, follower.goal.pose)
    assert isinstance(follower.goal, PassGoal)
    assert follower.goal.door == hidden
    assert follower.goal.pose[1] > 4.0


@given(FRAMES)
def test_a_lookout_is_clear_of_walls_and_new(frame: Pose) -> None:
    scene = placed(Scene(CLOSED, ()), frame)
    place = next_lookout(scene, [compose(frame, HERE)])
    assert place is not None
    assert math.dist(place[:2], to_parent(frame, HERE[:2])) >= 1.0
    cell = chain((0.0, 0.0), (0.0, 3.0), (3.0, 3.0), (3.0, 0.0), (0.0, 0.0))
    middle = compose(frame, (1.5, 1.5, 0.0))
    assert next_lookout(placed(Scene(cell, ()), frame), [middle]) is None


def test_what_was_found_is_believed_in_until_something_else_is() -> None:
    """The corner is seen; then its walls are lost, and nothing is there to be found any more."""
    corner = (
        Wall((0.0, 1.0), (4.0, 1.0)),
        Wall((0.0, -1.0), (6.0, -1.0)),
        Wall((4.0, 1.0), (4.0, 6.0)),
        Wall((6.0, -1.0), (6.0, 6.0)),
    )
    follower = Follower(parse("turn left at the corner"))
    follower.start(Scene(corner, ()), (1.0, 0.0, 0.0))
    found = follower.goal
    assert isinstance(found, ReachGoal)
    shut = Scene((*corner[:2], Wall((6.0, -1.0), (6.0, 1.0)), Wall((4.0, 1.0), (6.0, 1.0))), ())
    follower.advance(lambda: shut, (5.0, 0.0, 0.3), 0.5, 0.1)
    follower.look(shut, (5.0, 0.0, 0.3))
    assert follower.goal == found
    assert follower.impossible is None
    nothing = Follower(parse("turn left at the corner"))
    nothing.start(shut, (4.6, 0.0, 0.0))
    assert nothing.impossible is not None


def test_a_judge_believes_what_is_there_now() -> None:
    """Whoever knows everything has nothing to remember."""
    follower = Follower(LEAVE, complete=True)
    follower.start(Scene(ROOM, (EXIT,)), HERE)
    assert isinstance(follower.goal, PassGoal)
    follower.look(Scene(CLOSED, ()), HERE)
    assert follower.impossible is not None


@pytest.mark.parametrize("complete", [False, True])
def test_two_doors_that_are_equally_open_are_asked_about(complete: bool) -> None:
    west = Door((0.0, 1.5), (0.0, 2.5))
    walls = chain((5.0, 1.5), (5.0, 0.0), (0.0, 0.0), (0.0, 1.5))
    walls += chain((0.0, 2.5), (0.0, 4.0), (5.0, 4.0), (5.0, 2.5))
    follower = Follower(LEAVE, complete=complete)
    follower.start(Scene(walls, (west, EXIT)), (2.5, 2.0, 0.5))
    assert "by which door" in (follower.impossible or "")
