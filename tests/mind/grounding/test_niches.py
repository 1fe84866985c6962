"""A door at the back of a niche is the door that is meant, and not the mouth of the niche."""

from __future__ import annotations

import math

import pytest

from semnav_env.mind.grounding import PassGoal, ground
from semnav_env.mind.grounding.goal import door_of
from semnav_features.scene import Door, Scene, Wall
from tests.support.grounded import START, clause
from tests.support.hand_made import corridor

MOUTH = 3.0


def hallway(depth: float, side: float = 1.0, aside: float = 0.0) -> Scene:
    """A door on the left, seen `depth` metres before another one.

    A wall leads from the one to the other, along a share of the depth.
    """
    scene = corridor(left=(MOUTH,))
    (mouth,) = scene.doors
    (ax, ay), (bx, by) = mouth.start, mouth.end
    back = Door((ax + aside, ay + depth), (bx + aside, by + depth))
    return Scene((*scene.walls, Wall(mouth.end, (bx, by + side * depth))), (mouth, back))


@pytest.mark.parametrize(
    ("scene", "depth"),
    [
        (hallway(0.9), 0.9),
        (hallway(0.9, side=0.6), 0.9),
        (hallway(0.9, side=0.3), 0.0),
        (hallway(1.3), 0.0),
        (hallway(0.9, aside=0.6), 0.0),
    ],
    ids=["a niche", "half of a side seen", "no side: across a hallway", "too deep", "not behind"],
)
def test_the_door_at_the_back_of_a_niche_is_passed(scene: Scene, depth: float) -> None:
    goal = ground(clause("go through the first door on the left"), scene, START, START)
    assert isinstance(goal, PassGoal)
    assert goal.door.midpoint == pytest.approx((MOUTH, 1.0 + depth))
    assert goal.pose[2] == pytest.approx(math.pi / 2)


def test_it_counts_once() -> None:
    goal = ground(clause("go to the first door on the left"), hallway(0.9), START, START)
    door = door_of(goal)
    assert door is not None
    assert door.midpoint == pytest.approx((MOUTH, 1.0))
