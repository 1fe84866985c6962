"""The compiled formulas of goals, and the record that a follower keeps of its clause."""

from __future__ import annotations

from copy import copy

from semnav_env.language import parse
from semnav_env.mind.grounding.clause_progress import ON_WAY, TRAIL_DUE, note_pose
from semnav_env.mind.grounding.follower import Follower
from semnav_env.mind.grounding.ways import WAY_SPACING, KnownWays, Way
from tests.support.hand_made import corridor

SCENE = corridor(left=(3.0, 6.0), right=(4.0,))


def _due_places(command: str) -> list[bool]:
    """Whether a place of the trail is due, every third of `WAY_SPACING` along a corridor."""
    follower = Follower(parse(command), complete=True)
    follower.start(SCENE, (0.0, 0.0, 0.0))
    step = WAY_SPACING / 3
    due = []
    for k in range(1, 7):
        pose = (k * step, 0.0, 0.0)
        events = note_pose(follower.progress, pose, 0.5, 1 / 15)
        follower.think(events, lambda: SCENE, pose)
        due.append(bool(events & TRAIL_DUE))
    return due


def test_a_place_of_the_trail_is_due_every_way_spacing() -> None:
    assert (
        _due_places("go to the end of the hallway, go back to the start")
        == [False, False, True] * 2
    )


def test_a_command_that_never_goes_back_keeps_no_trail() -> None:
    assert not any(_due_places("go to the end of the hallway"))


def test_a_known_way_calls_for_thought_at_every_step() -> None:
    way = Way(((0.0, 0.0), (1.5, 0.0), (3.0, 0.0)))
    follower = Follower(
        parse("go to the kitchen", rooms=("kitchen",)), complete=True, guide=KnownWays({0: way})
    )
    follower.start(SCENE, (0.0, 0.0, 0.0))
    assert follower.goal.places
    for x in (0.1, 0.2):
        assert note_pose(follower.progress, (x, 0.0, 0.0), 0.5, 1 / 15) == ON_WAY


def test_a_copied_follower_goes_on_by_itself() -> None:
    follower = Follower(parse("go past the first door on the left, stop"), complete=True)
    follower.start(SCENE, (0.0, 0.0, 0.0))
    before = follower.progress.tobytes()
    other = copy(follower)
    other.skip_to_next(SCENE)
    other.advance(lambda: SCENE, (5.0, 0.0, 0.0), 0.5, 1 / 15)
    assert follower.progress.tobytes() == before
    assert follower.active == 0
    assert other.active == 1
