"""Commands whose answer depends on centimetres are dropped, all others are kept."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import shapely

from semnav_env.judge.episodes import evenly, load_episodes
from semnav_env.judge.episodes.stable_answers import StableAnswers, answer_in, moved_walls
from semnav_env.judge.readings import same_goal
from semnav_env.language import parse
from semnav_env.mind.grounding.goal import ReachGoal, StopGoal
from semnav_env.mind.grounding.ways import KnownWays
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_env.world.maps.importers import import_map
from tests.support.kth_floors import floor, hall, long_floor, room

START = (0.8, 1.0, 0.0)


def plan_of(text: str, folder: Path) -> FloorPlan:
    (folder / "floor.xml").write_text(text)
    return import_map(folder / "floor.xml").plan


def test_a_command_far_from_every_limit_keeps_its_answer(tmp_path: Path) -> None:
    stable = StableAnswers(plan_of(long_floor(), tmp_path))
    for said in ("go through the second door on the left", "go to the end of the hallway"):
        assert stable.change(parse(said), START) is None


def two_doors(width: float, folder: Path) -> StableAnswers:
    """Two doors to the left, of which the first has the given width."""
    doors = ((2.0, 2.0 + width), (6.0, 6.9))
    text = floor(hall(doors), room("2", door=doors[0]), room("3", door=doors[1], west=4.5))
    return StableAnswers(plan_of(text, folder))


@pytest.mark.parametrize("width", [0.72, 1.18])
def test_an_answer_hangs_on_a_door_that_hardly_counts(tmp_path: Path, width: float) -> None:
    stable = two_doors(width, tmp_path)
    assert stable.change(parse("go through the first door on the left"), START) == "limits"


@pytest.mark.parametrize("width", [0.66, 1.22, 1.3])
def test_a_command_with_two_right_answers_is_kept(tmp_path: Path, width: float) -> None:
    stable = two_doors(width, tmp_path)
    command = parse("go through the first door on the left")
    assert len(stable.accepted(command, START)) == 2
    assert stable.change(command, START) is None


def test_a_variant_in_which_a_command_is_impossible_says_nothing(tmp_path: Path) -> None:
    stable = two_doors(0.72, tmp_path)
    second = parse("go through the second door on the left")
    found = [answer_in(each, stable.plan, second, START, KnownWays({})) for each in stable.variants]
    assert None in found
    assert stable.change(second, START) is None


def test_what_a_command_does_not_speak_of_does_not_matter(tmp_path: Path) -> None:
    doors = ((2.0, 2.9), (6.0, 7.22))
    text = floor(hall(doors), room("2", door=doors[0]), room("3", door=doors[1], west=4.5))
    stable = StableAnswers(plan_of(text, tmp_path))
    assert stable.change(parse("go through the first door on the left"), START) is None


def test_moved_walls_stay_together_and_keep_their_doors() -> None:
    plan = load_floor_plan("office_cross")
    moved = moved_walls(plan, np.random.default_rng(3))
    shift = np.abs(moved.segments - plan.segments)
    assert 0.0 < shift.max() < 0.2
    for surface, before in zip(moved.surfaces, plan.surfaces, strict=True):
        assert surface.is_closed == before.is_closed
    solids = shapely.union_all(shapely.linestrings(moved.segments.reshape(-1, 2, 2)))
    for door in moved.doors:
        assert solids.distance(shapely.Point(door.start)) < 0.1


def test_moved_walls_hardly_change_an_answer_in_generated_offices() -> None:
    episodes = evenly(load_episodes("val_unseen"), 12)
    changes = [
        StableAnswers(each.plan()).change(each.meanings()[0], each.start) for each in episodes
    ]
    assert changes.count("walls") + changes.count("start") <= 1


def test_the_same_place_before_another_door_is_another_goal() -> None:
    goal = ReachGoal((1.0, 2.0, 0.0), 1.0)
    assert same_goal(goal, ReachGoal((1.3, 2.0, 0.0), 1.0))
    assert not same_goal(goal, ReachGoal((1.8, 2.0, 0.0), 1.0))
    assert not same_goal(goal, StopGoal((1.0, 2.0, 0.0)))
