"""An opening about as wide as a door may be one or not, and both answers are right."""

from __future__ import annotations

import math
from pathlib import Path

import gymnasium as gym
import numpy as np
import pytest

from semnav_agents.evaluation import drive
from semnav_agents.oracle import OracleAgent
from semnav_env.env import SemNavEnv
from semnav_env.judge import Judge, Motion, Verdict, plan_mission
from semnav_env.judge.episodes import evenly, load_episodes
from semnav_env.judge.readings import answers, readings
from semnav_env.language import parse
from semnav_env.mind.grounding import GroundingError, PassGoal
from semnav_env.rules import Rules, SuccessRules
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_env.world.maps.importers import import_map
from semnav_features.frames import Pose
from tests.support.kth_floors import floor, hall, room

START: Pose = (0.8, 1.0, 0.0)
ID = "semnav_env:SemNav-v0"
WIDE, DOOR = 2.64, 6.45
"""Middles of the opening and of the door along the hallway, metres."""


@pytest.fixture(scope="module")
def plan(tmp_path_factory: pytest.TempPathFactory) -> FloorPlan:
    """A hallway with an opening 1.28 m wide and then a door 0.9 m wide, both on its left."""
    return plan_with((2.0, 3.28), tmp_path_factory.mktemp("plan"))


def plan_with(opening: tuple[float, float], folder: Path) -> FloorPlan:
    doors = opening, (6.0, 6.9)
    text = floor(hall(doors), room("2", door=doors[0]), room("3", door=doors[1], west=4.5))
    (folder / "floor.xml").write_text(text)
    return import_map(folder / "floor.xml").plan


def through(plan: FloorPlan, said: str, *points: tuple[float, float]) -> Judge:
    """The judge of a walk along straight lines."""
    judge = Judge(plan_mission(plan, plan.derived(Geodesic), parse(said), START))
    x, y = START[:2]
    for px, py in points:
        heading = math.atan2(py - y, px - x)
        for share in np.linspace(0.0, 1.0, max(2, int(math.dist((x, y), (px, py)) / 0.1)))[1:]:
            pose = x + share * (px - x), y + share * (py - y), heading
            judge.update(Motion(pose, 1.0, 0.0, in_contact=False, seconds=1 / 15))
        x, y = px, py
    return judge


def doors_of(plan: FloorPlan, said: str, rules: Rules = Rules()) -> list[float]:
    """Where along the hallway the right doors of a command are, metres."""
    found = answers(plan, plan.derived(Geodesic), parse(said), START, rules)
    goals = [each.goals[0] for each in found]
    return [round(goal.door.midpoint[0], 2) for goal in goals if isinstance(goal, PassGoal)]


def test_a_door_after_a_doubtful_opening_is_the_first_or_the_second(plan: FloorPlan) -> None:
    assert doors_of(plan, "go through the first door on the left") == [DOOR, WIDE]
    assert doors_of(plan, "go through the second door on the left") == [DOOR]
    assert doors_of(plan, "go through the last door on the left") == [DOOR]


def test_a_command_is_impossible_if_it_is_in_every_reading(plan: FloorPlan) -> None:
    with pytest.raises(GroundingError, match="third door"):
        doors_of(plan, "go through the third door on the left")


def test_without_doubt_there_is_one_answer(plan: FloorPlan) -> None:
    sure = Rules(success=SuccessRules(door_doubt=0.0))
    assert doors_of(plan, "go through the first door on the left", sure) == [DOOR]
    assert len(list(readings(plan, sure))) == 1


@pytest.mark.parametrize(
    ("width", "doubtful"),
    [(0.54, 0), (0.6, 1), (0.7, 0), (1.2, 0), (1.22, 1), (1.35, 1), (1.4, 0)],
)
def test_an_opening_is_doubtful_a_little_beyond_the_widths_of_doors(
    tmp_path: Path, width: float, doubtful: int
) -> None:
    assert len(list(readings(plan_with((2.0, 2.0 + width), tmp_path)))) == 1 + doubtful


@pytest.mark.parametrize("split", ["val_unseen", "test_long", "test_infeasible", "test_real"])
def test_no_frozen_episode_has_another_answer(split: str) -> None:
    """Its floor plan has one reading, so it is judged as without readings."""
    plans = {each.floor_plan: each.plan() for each in evenly(load_episodes(split), 10)}
    assert all(len(list(readings(plan))) == 1 for plan in plans.values())


@pytest.mark.parametrize(("there", "name"), [(WIDE, "1 - 2"), (DOOR, "1 - 3")])
def test_either_answer_is_right(plan: FloorPlan, there: float, name: str) -> None:
    judge = through(plan, "go through the first door on the left", (there, 1.0), (there, 2.3))
    assert judge.verdict is Verdict.DONE
    assert judge.period.over
    assert judge.crossed == [name]


def test_an_answer_that_has_become_wrong_leaves_the_other_one(plan: FloorPlan) -> None:
    """Who goes on behind the opening has not taken it for a door."""
    said = "go past the first door on the left and go through the last door on the left"
    judge = through(plan, said, (4.0, 1.0))
    assert judge.verdicts == ("done", "active")
    judge = through(plan, said, (DOOR, 1.0), (DOOR, 2.3))
    assert judge.verdict is Verdict.DONE


def test_the_last_answer_to_fail_fails_the_episode(plan: FloorPlan) -> None:
    """The opening is the first door, if it is one; else it is none, and may be crossed."""
    said = "go through the second door on the left"
    assert through(plan, said, (WIDE, 1.0), (WIDE, 2.3)).verdict is Verdict.WRONG_DOOR
    said = "go to the first door on the left and wait for 60 seconds"
    judge = through(plan, said, (DOOR, 1.0), (DOOR, 2.3))
    assert judge.verdict is Verdict.WRONG_DOOR


def test_the_nearest_answer_is_the_route_and_the_oracle_takes_it(plan: FloorPlan) -> None:
    said = {"command": "go through the first door on the left", "pose": START}
    env = SemNavEnv(floor_plan=plan, observation="truth", max_seconds=60.0)
    driven = drive(env, OracleAgent(), 0, said)
    near, far = (each.route_length for each in (driven.judge.mission, *driven.judge.mission.others))
    assert driven.metrics.success
    assert driven.rechecked() == ""
    assert driven.metrics.route_length == near < far
    assert driven.metrics.spl > 0.8


def test_a_longer_answer_is_measured_by_the_nearest(plan: FloorPlan) -> None:
    judge = through(plan, "go through the first door on the left", (DOOR, 1.0), (DOOR, 3.2))
    assert judge.success
    assert judge.route_length < judge.mission.route_length


def test_many_robots_are_judged_like_one(plan: FloorPlan) -> None:
    said = {"command": "go through the first door on the left", "pose": START}
    one = gym.make(ID, floor_plan=plan).unwrapped
    many = gym.make_vec(ID, 2, "vector_entry_point", floor_plan=plan)
    one.reset(seed=3, options=said)
    many.reset(seed=[3, 4], options=said)
    over, steps = False, 0
    while not over:
        action = np.array([0.8, 0.0 if steps < 25 else 0.5])
        _, reward, over, _, info = one.step(action)
        _, rewards, terminated, _, infos = many.step(np.stack((action, action)))
        assert (rewards[0], terminated[0]) == (reward, over)
        assert infos["verdicts"][0] == info["verdicts"]
        steps += 1
    assert info["verdicts"] != ("active",)
