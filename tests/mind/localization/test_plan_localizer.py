from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_env.mind.localization import LocalizerRules, PlanLocalizer
from semnav_env.mind.localization.door_pose import seen_jambs
from semnav_env.world.simulator import EXACT, SPOT_ODOMETRY
from semnav_env.world.simulator.odometry import Odometry
from semnav_features.clouds.detected_door import DetectedDoor
from semnav_features.elements import Door
from semnav_features.frames import FloatArray, Pose, compose
from tests.mind.localization.doors import (
    JAMB_SIGMA,
    LEFT,
    RIGHT,
    door_seen_from,
    poses,
    turned_about,
)

USUAL, EXACT_PLAN = LocalizerRules(), LocalizerRules(plan_sigma=1e-6)
PRIOR = np.diag([0.1**2, 0.1**2, 0.05**2])
NOISE = JAMB_SIGMA**2 * np.eye(4)

offsets = st.tuples(st.floats(-0.15, 0.15), st.floats(-0.15, 0.15), st.floats(-0.08, 0.08))
moves = st.tuples(st.floats(-0.3, 0.3), st.floats(-0.1, 0.1), st.floats(-0.3, 0.3))


def localizer_at(
    pose: Pose, rules: LocalizerRules = USUAL, prior: FloatArray = PRIOR
) -> PlanLocalizer:
    return PlanLocalizer((LEFT, RIGHT), pose, SPOT_ODOMETRY, prior, rules)


@given(poses, offsets)
@settings(deadline=None)
def test_a_door_seen_exactly_moves_the_belief_to_the_truth(true: Pose, offset: Pose) -> None:
    localizer = localizer_at(compose(true, offset), EXACT_PLAN)
    assert localizer.correct(door_seen_from(true, LEFT)) == LEFT
    assert localizer.pose[:2] == pytest.approx(true[:2], abs=1e-5)
    assert math.cos(localizer.pose[2] - true[2]) == pytest.approx(1.0)


@given(poses, st.booleans())
@settings(deadline=None)
def test_one_jamb_leaves_the_turn_about_it(pose: Pose, start: bool) -> None:
    """The information about that turn, t^T P^-1 t, is what it was."""
    localizer = localizer_at(pose)
    before = localizer.covariance
    seen = {"start_seen": start, "end_seen": not start}
    assert localizer.correct(door_seen_from(pose, LEFT, NOISE, **seen)) == LEFT
    jamb, size = LEFT.start if start else LEFT.end, 1e-6
    turn = np.subtract(turned_about(jamb, pose, size), pose) / size
    known = [turn @ np.linalg.solve(each, turn) for each in (before, localizer.covariance)]
    assert known[1] == pytest.approx(known[0], rel=1e-3)
    across = np.array([turn[1], -turn[0]])
    assert across @ localizer.covariance[:2, :2] @ across < across @ before[:2, :2] @ across


@given(st.floats(0.5, 2.0))
@settings(deadline=None)
def test_a_wall_line_alone_leaves_the_place_along_it(distance: float) -> None:
    pose = LEFT.midpoint[0], LEFT.midpoint[1] - distance, 0.0
    localizer = localizer_at(pose)
    unknown_along = NOISE + np.diag([100.0, 0.0, 100.0, 0.0])
    assert localizer.correct(door_seen_from(pose, LEFT, unknown_along)) is None  # left or right?
    localizer = PlanLocalizer((LEFT,), pose, SPOT_ODOMETRY, PRIOR)
    assert localizer.correct(door_seen_from(pose, LEFT, unknown_along)) == LEFT
    assert localizer.covariance[0, 0] == pytest.approx(PRIOR[0, 0], rel=1e-3)
    assert localizer.covariance[1, 1] < 0.25 * PRIOR[1, 1]


@given(poses, st.sampled_from((-1.0, 1.0)), st.booleans())
@settings(deadline=None)
def test_a_wrong_door_a_metre_away_is_gated(pose: Pose, side: float, whole: bool) -> None:
    other = Door((LEFT.start[0] + side, 3.0), (LEFT.end[0] + side, 3.0))
    localizer = PlanLocalizer((LEFT,), pose, SPOT_ODOMETRY, PRIOR)
    wrong = door_seen_from(pose, other, NOISE, end_seen=whole)
    assert localizer.correct(wrong) is None
    assert localizer.pose == pose
    assert localizer.covariance == pytest.approx(PRIOR)


def test_a_robot_that_is_lost_takes_no_door_for_another() -> None:
    """Half a door's distance off and as unsure, it cannot tell two doors 1.9 m apart."""
    pose = 1.4, 1.0, 0.5 * math.pi
    localizer = localizer_at(pose, prior=np.diag([1.0, 1.0, 0.1**2]))
    middle = Door((0.95, 3.0), (1.85, 3.0))
    assert localizer.correct(door_seen_from(pose, middle, NOISE)) is None


@given(poses, st.lists(st.tuples(moves, st.booleans(), st.booleans()), max_size=12), st.data())
@settings(deadline=None, max_examples=30)
def test_the_covariance_stays_symmetric_and_positive(
    pose: Pose, steps: list[tuple[Pose, bool, bool]], data: st.DataObject
) -> None:
    localizer, odometry = localizer_at(pose), (0.0, 0.0, 0.0)
    for move, touching, end_seen in steps:
        odometry = compose(odometry, move)
        localizer.move(odometry, touching)
        detected = door_seen_from(localizer.pose, LEFT, end_seen=end_seen)
        off = data.draw(st.floats(-0.05, 0.05))
        localizer.correct(replace(detected, start=(detected.start[0] + off, detected.start[1])))
        assert (localizer.covariance == localizer.covariance.T).all()
        assert np.linalg.eigvalsh(localizer.covariance)[0] > 0.0


def test_the_covariance_grows_as_odometry_errs() -> None:
    """Of 400 ways with a turn in them, driven with the preset's errors."""
    ends, localizer = [], PlanLocalizer((LEFT,), (0.0, 0.0, 0.0), SPOT_ODOMETRY, np.zeros((3, 3)))
    way = [(0.1, 0.0, 0.0)] * 60 + [(0.0, 0.0, 0.1)] * 15 + [(0.1, 0.0, 0.0)] * 60
    for seed in range(400):
        odometry, pose = Odometry(SPOT_ODOMETRY), (0.0, 0.0, 0.0)
        odometry.reset(pose, np.random.default_rng(seed))
        for move in way:
            pose = compose(pose, move)
            odometry.update(pose)
        ends.append(odometry.pose)
    pose = (0.0, 0.0, 0.0)
    localizer.move(pose)
    for move in way:
        pose = compose(pose, move)
        localizer.move(pose)
    spread = np.cov(np.array(ends).T)
    assert localizer.covariance == pytest.approx(spread, abs=0.15 * np.abs(spread).max())


def test_doors_calibrate_the_odometry() -> None:
    """Between a door and itself again, distances are counted 3 % too long."""
    localizer, true, odometry = localizer_at((0.45, 0.0, 0.5 * math.pi)), 0.0, 0.0
    localizer.move((0.0, 0.0, 0.0))
    for forward in (0.1, -0.1) * 6:
        for _ in range(20):
            true, odometry = true + forward, odometry + 1.03 * forward
            localizer.move((odometry, 0.0, 0.0))
        place = 0.45, true, 0.5 * math.pi
        assert localizer.correct(door_seen_from(place, LEFT, 0.01**2 * np.eye(4))) == LEFT
    assert localizer.pose == pytest.approx((0.45, true, 0.5 * math.pi), abs=0.01)
    before = localizer.pose
    localizer.move((odometry + 1.03, 0.0, 0.0))
    assert localizer.pose[1] - before[1] == pytest.approx(1.0, abs=0.008)


def test_touching_widens_the_covariance_by_slip() -> None:
    free, blocked = localizer_at((0.0, 0.0, 0.0)), localizer_at((0.0, 0.0, 0.0))
    for localizer, touching in ((free, False), (blocked, True)):
        localizer.move((0.0, 0.0, 0.0))
        localizer.move((0.2, 0.0, 0.0), touching)
    widened = blocked.covariance[0, 0] - free.covariance[0, 0]
    assert widened == pytest.approx(0.2 * SPOT_ODOMETRY.slip**2)


def test_exact_odometry_adds_nothing() -> None:
    localizer = PlanLocalizer((LEFT,), (1.0, 2.0, 0.3), EXACT, PRIOR)
    localizer.move((5.0, 5.0, 1.0))
    localizer.move((5.0, 5.0, 1.5))
    assert localizer.pose == pytest.approx((1.0, 2.0, 0.8))
    assert localizer.covariance == pytest.approx(PRIOR)


@given(poses)
@settings(deadline=None)
def test_doors_within_reach_are_expected_in_the_robot_frame(pose: Pose) -> None:
    localizer = localizer_at(pose)
    found = {door.width: sigma for door, sigma in localizer.expected(reach=2.0)}
    near = [d for d in (LEFT, RIGHT) if math.dist(d.midpoint, pose[:2]) <= 2.0]
    assert len(list(localizer.expected(reach=2.0))) == len(near)
    assert all(sigma >= 0.1 for sigma in found.values())


def test_a_doubtful_detection_corrects_nothing() -> None:
    pose = 0.5, 1.0, 1.5
    localizer = localizer_at(pose)
    assert localizer.correct(replace(door_seen_from(pose, LEFT, NOISE), confidence=0.1)) is None


def test_a_plan_without_doors_corrects_nothing() -> None:
    pose = 0.5, 1.0, 1.5
    localizer = PlanLocalizer((), pose, SPOT_ODOMETRY)
    assert localizer.correct(door_seen_from(pose, LEFT, NOISE)) is None


NAN = math.nan
GOOD = door_seen_from((0.5, 1.0, 1.5), LEFT, NOISE)


@pytest.mark.parametrize(
    ("bad", "says"),
    [
        (replace(GOOD, start=(NAN, 0.0)), "finite"),
        (replace(GOOD, covariance=np.full((4, 4), NAN)), "covariance"),
        (replace(GOOD, covariance=-np.eye(4)), "covariance"),
        (replace(GOOD, covariance=np.eye(3)), "covariance"),
        (replace(GOOD, start_seen=False, end_seen=False), "neither"),
    ],
)
def test_a_detection_that_is_none_is_refused(bad: DetectedDoor, says: str) -> None:
    localizer = localizer_at((0.5, 1.0, 1.5))
    with pytest.raises(ValueError, match=says):
        localizer.correct(bad)
    assert localizer.pose == (0.5, 1.0, 1.5)


def test_numbers_that_are_none_are_refused() -> None:
    localizer = localizer_at((0.5, 1.0, 1.5))
    with pytest.raises(ValueError, match="odometry"):
        localizer.move((0.0, NAN, 0.0))
    with pytest.raises(ValueError, match="start"):
        localizer_at((NAN, 0.0, 0.0))
    with pytest.raises(ValueError, match="start_covariance"):
        localizer_at((0.0, 0.0, 0.0), prior=np.full((3, 3), NAN))
    with pytest.raises(ValueError, match="door"):
        PlanLocalizer((Door((0.0, NAN), (1.0, 0.0)),), (0.0, 0.0, 0.0), SPOT_ODOMETRY)


@given(poses, offsets)
@settings(deadline=None)
def test_the_jacobian_is_that_of_the_jambs(pose: Pose, step: Pose) -> None:
    detected, size = door_seen_from(pose, LEFT), 1e-6
    moved = pose[0] + size * step[0], pose[1] + size * step[1], pose[2] + size * step[2]
    change = (seen_jambs(moved, LEFT, detected)[0] - seen_jambs(pose, LEFT, detected)[0]) / size
    _, jacobian, _ = seen_jambs(pose, LEFT, detected)
    assert -change == pytest.approx(jacobian @ step, abs=1e-4)
