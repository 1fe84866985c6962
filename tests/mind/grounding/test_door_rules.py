"""What a door is, is said once: plan, extractor, grounding and judge follow it."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import box

from semnav_env.env import SemNavEnv
from semnav_env.judge import plan_goals
from semnav_env.language import parse
from semnav_env.mind.belief import BeliefTracker
from semnav_env.mind.grounding.goal import PassGoal
from semnav_env.rules import Rules, with_doors_of
from semnav_env.world.lidar import Lidar
from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor, Surface
from semnav_features import ExtractorSettings
from semnav_features.frames import Pose, relative, to_parent
from semnav_features.rules import DoorRules
from tests.support.small_plans import closed

COMMAND = "go through the second door on the right"
START: Pose = (1.0, 1.0, 0.0)


def hall_with_a_gate() -> FloorPlan:
    """A corridor of 16 x 2 m: on its right a door, a gate of 1.4 m and another door."""
    gaps = {"first": (3.0, 3.9), "gate": (5.5, 6.9), "last": (9.0, 9.9)}
    edges = [0.0, *(x for gap in gaps.values() for x in gap), 16.0]
    walls = [Surface(((a, 0.0), (b, 0.0))) for a, b in zip(edges[::2], edges[1::2], strict=True)]
    outline = closed((0.0, -4.0), (16.0, -4.0), (16.0, 2.0), (0.0, 2.0))
    doors = tuple(PlanDoor(name, (a, 0.0), (b, 0.0)) for name, (a, b) in gaps.items())
    return FloorPlan("gate", (outline, *walls), doors, (), (), (), box(0, -4, 16, 2))


PLAN = hall_with_a_gate()


@pytest.mark.parametrize(("widest", "meant"), [(1.2, "last"), (1.5, "gate")])
def test_robot_and_judge_count_the_same_doors(widest: float, meant: str) -> None:
    """Whoever is told what a door is: the rules or the extractor."""
    rules = Rules(door=DoorRules(width_max=widest))
    (goal,) = plan_goals(PLAN, parse(COMMAND), START, rules=rules)
    assert isinstance(goal, PassGoal)
    assert goal.door.name == meant
    for tracker in (
        BeliefTracker(rules=rules),
        BeliefTracker(extractor=ExtractorSettings(door_width_max=widest)),
    ):
        assert math.dist(door_made_out(tracker), goal.door.midpoint) < 0.2


def door_made_out(tracker: BeliefTracker) -> tuple[float, float]:
    """The middle of the door that a robot takes for the one meant after 9 m."""
    lidar = Lidar(PLAN)
    tracker.begin(parse(COMMAND))
    for step in range(90):
        pose = START[0] + 0.1 * step, START[1], START[2]
        ranges = lidar.ranges(pose, (0, 0, step))
        belief = tracker.update(ranges, relative(START, pose), (0.75, 0.0, 0.0))
    assert isinstance(belief.goal, PassGoal)
    return to_parent(START, belief.goal.door.midpoint)


@pytest.mark.parametrize("mode", ["semantic", "truth"])
def test_an_environment_has_one_rule_for_doors(mode: str) -> None:
    options = {"command": COMMAND, "pose": START}
    for given_door in (
        {"rules": Rules(door=DoorRules(width_max=1.5))},
        {"extractor": ExtractorSettings(door_width_max=1.5)},
    ):
        env = SemNavEnv(floor_plan=PLAN, observation=mode, **given_door)
        env.reset(seed=0, options=options)
        goal = env.judge.follower.goal
        assert isinstance(goal, PassGoal)
        assert goal.door.name == "gate"
        assert env.extractor.door_rules == env.rules.door == env.tracker.rules.door


def test_rules_and_extractor_may_not_contradict() -> None:
    with pytest.raises(ValueError, match=r"rules\.door"):
        with_doors_of(Rules(door=DoorRules(width_max=1.5)), ExtractorSettings(door_width_max=1.4))


@given(st.floats(0.5, 1.0), st.floats(0.0, 1.0), st.floats(0.0, 0.1))
def test_a_plan_counts_doors_between_the_limits(least: float, more: float, slack: float) -> None:
    rules = DoorRules(least, least + more, slack)
    for door in PLAN.doors:
        fits = rules.narrowest <= door.width <= rules.widest
        assert door.counts(rules) is fits
        assert (door.name in [each.name for each in PLAN.scene_by(rules).doors]) is fits


@pytest.mark.parametrize(
    "wrong", [{"width_max": 0.5}, {"width_min": -1.0}, {"width_max": math.inf}]
)
def test_a_rule_that_no_door_can_keep_is_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="width"):
        DoorRules(**wrong)
