"""What a judge counts in compiled code is what Python counts."""

from __future__ import annotations

import copy
import math
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.judge import Judge, Verdict, plan_mission
from semnav_env.judge.judge_record import ASTRAY, DOOR_CROSSED, TOO_STILL, judge_motion
from semnav_env.language import parse
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_env.world.simulator.sensed import Motion
from semnav_features.frames import Pose
from semnav_features.kernels.exact_hypot import exact_hypot

PLAN = load_floor_plan("office_cross")
MISSION = plan_mission(
    PLAN,
    PLAN.derived(Geodesic),
    parse("turn right at the intersection and go through the first door on the left"),
    (1.3, 9.1, 0.0),
)
COORDINATES = st.floats(-100.0, 100.0)


def moved(pose: Pose, speed: float = 1.0, seconds: float = 1 / 15) -> Motion:
    return Motion(pose, speed, 0.0, in_contact=False, seconds=seconds)


@given(COORDINATES, COORDINATES)
def test_the_length_of_a_step_is_that_of_python_to_the_last_bit(x: float, y: float) -> None:
    if math.hypot(x, y) > 1e-100:
        assert exact_hypot(x, y) == math.hypot(x, y)


@pytest.mark.parametrize(
    ("pose", "speed", "seconds", "event"),
    [
        ((1.4, 9.1, 0.0), 1.0, 0.1, 0),
        ((3.4, 7.5, 0.0), 1.0, 0.1, DOOR_CROSSED),
        ((15.0, 12.5, 0.0), 1.0, 0.1, ASTRAY),
        ((20.0, 9.1, 0.0), 1.0, 0.1, ASTRAY),
        ((1.3, 9.1, 0.0), 0.0, 10.1, TOO_STILL),
    ],
)
def test_an_event_calls_for_thinking(pose: Pose, speed: float, seconds: float, event: int) -> None:
    judge = Judge(MISSION)
    if event == DOOR_CROSSED:
        judge.write(moved((3.4, 8.5, 0.0)))
        judge_motion(judge.record)
    judge.write(moved(pose, speed, seconds))
    assert judge_motion(judge.record) & (DOOR_CROSSED | ASTRAY | TOO_STILL) == event


@pytest.mark.parametrize("duplicate", [copy.deepcopy, lambda j: pickle.loads(pickle.dumps(j))])
def test_a_copied_judge_goes_on_as_the_original(duplicate: object) -> None:
    judge, rng = Judge(MISSION), np.random.default_rng(0)
    way = np.linspace((1.3, 9.1, 0.0), (15.0, 9.1, 0.0), 150) + rng.normal(0.0, 0.02, (150, 3))
    motions = [moved((x, y, heading)) for x, y, heading in way.tolist()]
    for motion in motions[:70]:
        judge.update(motion)
    twin: Judge = duplicate(judge)  # type: ignore[operator]
    for motion in motions[70:]:
        assert judge.update(motion) == twin.update(motion)
        assert judge.verdicts == twin.verdicts
    assert judge.verdict == twin.verdict == Verdict.ACTIVE
    assert judge.period.path_length == sum_of_steps(motions)


def sum_of_steps(motions: list[Motion]) -> float:
    """As the judge adds them up: from the start, one after the other."""
    total, last = 0.0, MISSION.start
    for motion in motions:
        total += math.hypot(motion.pose[0] - last[0], motion.pose[1] - last[1])
        last = motion.pose
    return total


def test_progress_is_by_how_much_the_way_gets_shorter() -> None:
    judge = Judge(MISSION)
    before = judge.remaining
    judged = judge.update(moved((2.0, 9.0, 0.0)))
    assert judged.progress == before - judge.remaining > 0.5
