"""The measures of episodes: motion, the worst of many, and whole episodes judged."""

from __future__ import annotations

import math
from dataclasses import asdict, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from semnav_env.judge import Judge, Motion, plan_mission
from semnav_env.judge.metrics import (
    COST_METRICS,
    METRIC_NAMES,
    Metrics,
    Recording,
    clearances,
    collisions_per_100m,
    cvar,
    means,
    measure,
    rms_jerk,
    worst,
)
from semnav_env.language import parse
from semnav_env.robots import SPOT
from semnav_env.rules import Rules, SuccessRules
from semnav_env.world.maps import load_floor_plan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import FloatArray
from tests.support.erring import ghost
from tests.support.small_plans import empty_hall, plan_of

TOL = 1e-9


def test_jerk_worked_by_hand() -> None:
    times = np.arange(20) * 0.1
    cubic = np.column_stack((3.0 * times**3, np.zeros(20)))
    assert rms_jerk(cubic, 0.1) == pytest.approx(18.0)
    assert rms_jerk(np.column_stack((times**2, -times)), 0.1) == pytest.approx(0.0, abs=1e-6)
    assert rms_jerk(cubic[:3], 0.1) == 0.0


def test_clearance_is_that_of_the_body_worked_by_hand() -> None:
    """SPOT is 1.1 x 0.5 m, the hall 10 x 6 m."""
    poses = np.array([(5.0, 3.0, 0.0), (5.0, 1.0, 0.0), (5.0, 1.0, math.pi / 2), (0.4, 3.0, 0.0)])
    found = clearances(poses, SPOT, empty_hall(10.0, 6.0))
    assert found == pytest.approx([2.75, 0.75, 0.45, 0.0])


def test_clearance_is_bounded_where_nothing_is_solid() -> None:
    assert clearances(np.zeros((2, 3)), SPOT, plan_of()) == pytest.approx([10.0, 10.0])


def test_collisions_are_per_hundred_metres() -> None:
    assert collisions_per_100m(2, 50.0) == 4.0
    assert collisions_per_100m(2, 0.0) == 200.0


@pytest.mark.parametrize(
    ("share", "high_is_bad", "expected"),
    [
        (1.0, False, 5.5),
        (0.1, False, 1.0),
        (0.1, True, 10.0),
        (0.2, False, 1.5),
        (0.25, False, (1.0 + 2.0 + 0.5 * 3.0) / 2.5),
        (0.01, False, 1.0),
    ],
)
def test_cvar_of_one_to_ten_worked_by_hand(
    share: float, high_is_bad: bool, expected: float
) -> None:
    values = np.random.default_rng(0).permutation(np.arange(1.0, 11.0))
    assert cvar(values, share, high_is_bad) == pytest.approx(expected)


def test_a_high_mean_can_hide_a_worst_percent_that_fails() -> None:
    """The mean is 98 % here."""
    successes = [True] * 98 + [False] * 2
    assert np.mean(successes) == 0.98
    assert cvar(successes, 0.01) == 0.0
    assert cvar(successes, 0.05) == pytest.approx(0.6)


@given(hnp.arrays(np.float64, st.integers(1, 40), elements=st.floats(-5, 5)), st.floats(0.001, 1.0))
def test_cvar_lies_between_the_mean_and_the_worst(values: FloatArray, share: float) -> None:
    assert values.min() - TOL <= cvar(values, share) <= values.mean() + TOL
    assert cvar(-values, share, high_is_bad=True) == pytest.approx(-cvar(values, share))


def test_cvar_of_nothing_and_of_an_odd_share_are_errors() -> None:
    with pytest.raises(ValueError, match="at least one"):
        cvar([], 0.1)
    with pytest.raises(ValueError, match="share is 0"):
        cvar([1.0], 0.0)


PLAN = load_floor_plan("office_cross")
GEODESIC = Geodesic(PLAN)
START = (1.3, 9.1, 0.0)


def glided(command: str, *points: tuple[float, float]) -> tuple[Judge, Metrics]:
    judge = Judge(plan_mission(PLAN, GEODESIC, parse(command), START))
    recording = ghost(judge, list(points), np.random.default_rng(0))
    return judge, measure(recording, judge, SPOT)


def test_the_neighbouring_door_is_near_and_yet_no_success() -> None:
    """What success within 3 m would hide: 3.4 and 5.8 m along the corridor are two doors."""
    judge, found = glided("go through the second door on the right", (3.4, 8.6), (3.4, 7.0))
    assert judge.crossed == ["west_south_1"]
    assert not found.success
    assert not found.oracle_success
    assert found.spl == found.sdtw == found.clauses == 0.0
    assert 0.0 < found.goal_distance < 5.0
    assert found.soft_spl > 0.0
    assert 0.0 < found.ndtw < 1.0


def test_to_pass_the_goal_is_success_only_for_the_oracle() -> None:
    """A wrong room first: the episode has failed when the right door is crossed."""
    judge = Judge(
        plan_mission(PLAN, GEODESIC, parse("go through the first door on the right"), START)
    )
    path = [START[:2], (3.4, 9.0), (3.4, 7.0)]
    poses = np.array([(x, y, -math.pi / 2) for x, y in path])
    rows = len(poses)
    recording = Recording(poses, np.ones((rows, 3)), np.zeros(rows, int), np.zeros(rows), 1 / 15)
    found = measure(recording, judge, SPOT)  # of a judge that was told of no step
    assert not found.success
    assert found.oracle_success
    assert found.oracle_within_1m
    assert found.oracle_within_3m
    assert found.within_3m


def test_waiting_at_the_start_is_waiting_nowhere_else() -> None:
    command = "go through the second door on the left and wait for 2 seconds"
    judge = Judge(plan_mission(PLAN, GEODESIC, parse(command), START))
    there = judge.mission.goals[-1].pose
    rows = 31  # two seconds
    for place, met in ((START, False), (there, True)):
        still = np.zeros((rows, 3))
        poses = np.tile(np.array(place), (rows, 1))
        recording = Recording(poses, still, np.zeros(rows, int), np.zeros(rows), 1 / 15)
        assert measure(recording, judge, SPOT).oracle_success is met


def test_standing_is_what_the_missions_rules_call_standing() -> None:
    command = "go through the second door on the left and wait for 2 seconds"
    for rules, met in ((Rules(), False), (Rules(success=SuccessRules(standstill_speed=0.3)), True)):
        mission = plan_mission(PLAN, GEODESIC, parse(command), START, rules=rules)
        poses = np.tile(np.array(mission.goals[-1].pose), (31, 1))
        creeping = np.tile(np.array((0.2, 0.0, 0.0)), (31, 1))
        recording = Recording(poses, creeping, np.zeros(31, int), np.zeros(31), 1 / 15)
        assert measure(recording, Judge(mission), SPOT).oracle_success is met


def test_a_command_without_a_route_is_measured_by_its_success() -> None:
    """A body that turns on the spot moves its centre, and no way is shorter than none."""
    for command, success in (("turn around", True), ("turn left by 90 degrees", False)):
        judge = Judge(plan_mission(PLAN, GEODESIC, parse(command), START))
        turned = [START, (1.4, 9.1, math.pi), (1.35, 9.1, math.pi)]
        for pose in turned[1:]:
            judge.update(Motion(pose, 0.0, 0.0, False, 1 / 15))
        still, none = np.zeros((3, 3)), np.zeros(3)
        recording = Recording(np.array(turned), still, np.zeros(3, int), none, 1 / 15)
        found = measure(recording, judge, SPOT)
        assert judge.mission.route_length == 0.0
        assert found.success is success
        assert found.spl == found.soft_spl == float(success)


def test_a_measure_that_an_episode_does_not_have_is_left_out_of_the_mean() -> None:
    _, found = glided("go through the first door on the right", (3.4, 8.6), (3.4, 7.0))
    without = replace(found, spl=math.nan)
    assert means([found, without])["spl"] == pytest.approx(found.spl)
    assert math.isnan(means([without])["spl"])


def test_the_shortest_way_scores_near_one_everywhere() -> None:
    judge = Judge(
        plan_mission(PLAN, GEODESIC, parse("go through the fourth door on the left"), START)
    )
    recording = ghost(judge, [judge.mission.goals[0].pose[:2]], np.random.default_rng(0))
    found = measure(recording, judge, SPOT)
    assert judge.success
    assert found.success
    assert found.clauses == 1.0
    assert found.within_1m
    assert found.contact_free
    assert min(found.spl, found.soft_spl, found.ndtw, found.sdtw, found.cls) > 0.95


def test_success_of_the_measures_is_the_verifiers() -> None:
    for x in (3.4, 6.0):
        judge, found = glided("go through the first door on the right", (x, 8.6), (x, 7.0))
        assert found.success == judge.success


def test_the_mean_of_all_is_the_mean_and_the_worst_are_worse() -> None:
    _, good = glided("go through the first door on the right", (3.4, 8.6), (3.4, 7.0))
    _, bad = glided("go through the second door on the right", (3.4, 8.6), (3.4, 7.0))
    average, tail = means([good, bad]), worst([good, bad], 0.5)
    assert set(average) == set(METRIC_NAMES) == set(asdict(good))
    for name in METRIC_NAMES:
        a, b = float(getattr(good, name)), float(getattr(bad, name))
        if name != "collisions_per_100m":
            assert average[name] == pytest.approx((a + b) / 2)
        assert tail[name] == pytest.approx(max(a, b) if name in COST_METRICS else min(a, b))


def test_mean_collisions_per_100m_are_those_of_the_whole_way() -> None:
    """One of 1 m with a collision, one of 99 m without: 1 per 100 m, not 50."""
    _, found = glided("go through the first door on the right", (3.4, 8.6), (3.4, 7.0))
    short = replace(found, collisions=1, path_length=1.0, collisions_per_100m=100.0)
    far = replace(found, collisions=0, path_length=99.0, collisions_per_100m=0.0)
    assert means([short, far])["collisions_per_100m"] == pytest.approx(1.0)


def test_a_recording_survives_a_file(tmp_path) -> None:  # type: ignore[no-untyped-def]
    judge = Judge(
        plan_mission(PLAN, GEODESIC, parse("go through the first door on the right"), START)
    )
    recording = ghost(judge, [(3.4, 7.0)], np.random.default_rng(0))
    recording.save(tmp_path / "a.npz")
    again = Recording.load(tmp_path / "a.npz")
    assert np.array_equal(again.poses, recording.poses)
    assert again.period == recording.period
    assert again.seconds == recording.seconds


def test_arrays_that_do_not_fit_are_named() -> None:
    with pytest.raises(ValueError, match="velocities of a recording has shape"):
        Recording(np.zeros((3, 3)), np.zeros((2, 3)), np.zeros(3, int), np.zeros(3), 0.1)
    with pytest.raises(ValueError, match="poses of a recording"):
        Recording(np.full((1, 3), np.nan), np.zeros((1, 3)), np.zeros(1, int), np.zeros(1), 0.1)
    with pytest.raises(ValueError, match="period"):
        Recording(np.zeros((1, 3)), np.zeros((1, 3)), np.zeros(1, int), np.zeros(1), 0.0)


@pytest.mark.parametrize(
    ("people", "leaves", "name"),
    [
        (np.zeros((2, 4)), None, "people"),
        (np.zeros((2, 4, 2)), None, "people"),
        (np.zeros((3, 4, 3)), None, "people"),
        (np.full((2, 1, 3), np.nan), None, "people"),
        (None, np.zeros((2, 2)), "leaves"),
        (None, np.full((1, 4), np.inf), "leaves"),
    ],
)
def test_people_and_leaves_that_do_not_fit_are_named(
    people: FloatArray | None, leaves: FloatArray | None, name: str
) -> None:
    two = np.zeros((2, 3)), np.zeros((2, 3)), np.zeros(2, int), np.zeros(2)
    Recording(*two, 0.1, np.zeros((2, 0, 3)), np.zeros((0, 4)))
    with pytest.raises(ValueError, match=f"{name} of a recording has shape"):
        Recording(*two, 0.1, people, leaves)
