"""What a robot looks for that it has not seen yet, and when it has seen enough."""

from __future__ import annotations

import numpy as np
import pytest

from semnav_env.language import parse
from semnav_env.mind.grounding import GroundingError, PassGoal, ReachGoal, SeekGoal, ground
from semnav_env.mind.grounding.follower import Follower
from semnav_features.scene import Scene, Wall
from tests.support.grounded import DOORS, START, clause, middle
from tests.support.hand_made import L_LEFT, corridor


def test_an_unseen_referent_is_sought_along_the_corridor() -> None:
    near = Scene(tuple(Wall(w.start, (min(w.end[0], 6.0), w.end[1])) for w in corridor().walls[:2]))
    for text in (
        "go through the first door on the right",
        "turn left at the intersection",
        "go to the end of the hallway",
        "follow the hallway until the corner",
    ):
        goal = ground(clause(text), near, START, (1.0, 0.3, 0.4))
        assert isinstance(goal, SeekGoal)
        assert goal.pose == pytest.approx((5.0, 0.0, 0.0), abs=0.01)
        assert goal.because.startswith("looking for the")


def seen_without_a_door() -> Scene:
    """Doors at 3 and 6 on the left, of which only the second has been recognised."""
    scene = corridor(left=(3.0, 6.0))
    return Scene(scene.walls, scene.doors[1:])


@pytest.mark.parametrize(("progress", "kind"), [(0.0, "SEEK"), (2.0, "SEEK"), (3.2, "PASS")])
def test_an_unseen_stretch_before_the_door_is_inspected_first(progress: float, kind: str) -> None:
    text = "go through the first door on the left"
    goal = ground(clause(text), seen_without_a_door(), START, (progress, 0.0, 0.0))
    assert goal.kind.name == kind
    assert goal.pose[0] <= 6.0 + 1e-6


def test_the_last_door_is_known_only_at_the_end() -> None:
    last = clause("go through the last door on the left")
    assert isinstance(ground(last, DOORS, START, (9.0, 0.0, 0.0)), SeekGoal)
    assert middle(ground(last, DOORS, START, (12.6, 0.0, 0.0))) == pytest.approx(9.0)


def test_a_door_is_missing_only_once_the_end_was_seen() -> None:
    third = clause("go through the third door on the right")
    assert isinstance(ground(third, DOORS, START, (9.0, 0.0, 0.0)), SeekGoal)
    with pytest.raises(GroundingError, match=r"no third door on the right: .* ended after 2"):
        ground(third, DOORS, START, (12.6, 0.0, 0.0))


def test_seeking_ends_where_the_end_counts_as_seen() -> None:
    goal = ground(clause("take the third door on the right"), DOORS, START, (11.0, 0.0, 0.0))
    with pytest.raises(GroundingError):
        ground(clause("take the third door on the right"), DOORS, START, goal.pose)


def test_at_the_end_a_corner_passes_for_an_intersection() -> None:
    """People say "intersection" of a bend, too."""
    turn = clause("turn left at the intersection")
    assert isinstance(ground(turn, L_LEFT, START, (9.0, 0.0, 0.0)), SeekGoal)
    assert isinstance(ground(turn, L_LEFT, START, (12.6, 0.0, 0.0)), ReachGoal)


def test_a_hidden_stretch_is_approached_before_a_door_is_taken() -> None:
    """From 6 m on no side is seen to the left: a pane of glass, say."""
    scene = corridor(left=(5.0,), end_door=True)
    walls = tuple(w for w in scene.walls if not (w.start[1] == w.end[1] == 1.0 and w.end[0] > 6.0))
    cut = Wall((5.45, 1.0), (6.0, 1.0))
    gappy = Scene((*walls, cut), scene.doors)
    said = clause("go through the second door")
    goals = {
        x: type(ground(said, gappy, START, pose=(x, 0.0, 0.0))) for x in (7.0, 12.0, 12.7, 13.2)
    }
    assert goals == {
        7.0: SeekGoal,
        12.0: SeekGoal,
        12.7: PassGoal,
        13.2: PassGoal,
    }


@pytest.mark.parametrize(
    ("stands_at", "seconds", "goes_on"), [(12.3, 2.9, False), (12.3, 3.1, True), (11.5, 9.0, False)]
)
def test_a_place_that_cannot_be_reached_counts_as_looked_from_after_standing_beside_it(
    stands_at: float, seconds: float, goes_on: bool
) -> None:
    """A wall at a slant leaves no room to come within half a metre of the lookout point."""
    follower = Follower(parse("go through the last door on the left"))
    follower.start(DOORS, START)
    for x in np.arange(0.0, stands_at + 0.05, 0.1):
        follower.advance(lambda: DOORS, (x, 0.0, 0.0), 1.0, 0.1)
        follower.look(DOORS, (x, 0.0, 0.0))
    assert isinstance(follower.goal, SeekGoal)
    for _ in range(round(seconds / 0.1)):
        follower.advance(lambda: DOORS, (x, 0.0, 0.0), 0.0, 0.1)
    for _ in range(2):  # it stays known
        follower.look(DOORS, (x, 0.0, 0.0))
        assert isinstance(follower.goal, PassGoal) is goes_on
