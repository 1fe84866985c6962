"""Scan matching: where a scan was taken, how sure that is, and where it cannot be told."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import box

from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import FloorPlan, Surface, load_floor_plan
from semnav_env.world.maps.importers import load_vector_map
from semnav_features import Scan
from semnav_features.frames import compose, relative
from semnav_features.lidars import TIM561
from semnav_features.mapping import MatchError, MatchSettings, match_scans
from semnav_features.mapping.matching import without_place
from semnav_features.readers import open_log
from studies.matching.drift import drift_of
from studies.matching.matching import (
    CHI_SQUARE_95,
    PairSpec,
    errors_of,
    log_differences,
    poses_on,
    read_ways,
    simulated_pairs,
)
from tests.support.paths import DATA

AMRL = DATA / "amrl_floors"
FREIBURG = DATA / "carmen" / "freiburg-079-corrected.log.gz"
OFFICE = load_floor_plan("office_cross")
WAYS = (((4.0, 9.1), (26.0, 9.1)), ((15.0, 4.0), (15.0, 16.0)))
"""Along the corridors of the office."""

moves = st.tuples(st.floats(-0.15, 0.15), st.floats(-0.15, 0.15), st.floats(-0.15, 0.15))


def office_scan(pose, step=0):
    return Lidar(OFFICE).scan(pose, key=(3, 0, step))


def plan_of(*walls):
    surfaces = tuple(Surface(((a, b), (c, d))) for a, b, c, d in walls)
    return FloorPlan("made", surfaces, (), (), (), (), box(-100.0, -100.0, 100.0, 100.0))


def corridor_scan(pose, step):
    """A corridor 2 m wide of which no end is in view."""
    walls = plan_of((-50.0, -1.0, 50.0, -1.0), (50.0, 1.0, -50.0, 1.0))
    return Lidar(walls).scan(pose, key=(3, 0, step))


def some_errors(sigma, count, seed=5):
    rng = np.random.default_rng(seed)
    pairs = simulated_pairs(OFFICE, poses_on(WAYS, rng), rng, PairSpec(sigma=sigma))
    return list(errors_of(itertools.islice(pairs, count)))


@settings(max_examples=25)
@given(moves, st.floats(-math.pi, math.pi))
def test_a_scan_is_found_where_it_was_taken(move, heading):
    first = (15.0, 9.1, heading)
    match = match_scans(office_scan(first, 0), office_scan(compose(first, move), 1))
    x, y, turn = relative(move, match.pose)
    assert match.converged
    assert math.hypot(x, y) < 0.02
    assert abs(turn) < math.radians(0.2)


@settings(max_examples=15)
@given(moves)
def test_matching_the_other_way_round_gives_the_inverse(move):
    here, there = (15.0, 9.1, 0.3), compose((15.0, 9.1, 0.3), move)
    forth = match_scans(office_scan(here, 0), office_scan(there, 1))
    back = match_scans(office_scan(there, 1), office_scan(here, 0))
    assert compose(forth.pose, back.pose) == pytest.approx((0.0, 0.0, 0.0), abs=0.02)


def test_a_scan_lies_on_itself():
    scan = office_scan((15.0, 9.1, 0.3))
    match = match_scans(scan, scan, guess=(0.05, -0.05, 0.03))
    assert match.pose == pytest.approx((0.0, 0.0, 0.0), abs=1e-3)
    assert match.residual < 0.03
    assert match.inliers > 0.9


def test_procrustes_steps_find_the_pose_as_well():
    here, move = (15.0, 9.1, 0.3), (0.1, -0.05, 0.08)
    there = compose(here, move)
    by_points = MatchSettings(point_to_point=True)
    match = match_scans(office_scan(here, 0), office_scan(there, 1), settings=by_points)
    assert match.pose == pytest.approx(move, abs=0.03)


@pytest.mark.parametrize("window", [20, 40, 80])
@pytest.mark.parametrize("step", range(12))
def test_a_bare_corridor_is_undetermined_along_its_axis(step, window):
    heading = 0.5 * step - 3.0
    here, there = (0.0, 0.0, heading), (0.1, 0.05, heading + 0.1)
    scans = corridor_scan(here, 2 * step), corridor_scan(there, 2 * step + 1)
    match = match_scans(*scans, settings=MatchSettings(window=window, guess_position=0.3))
    along = np.array((math.cos(heading), -math.sin(heading)))
    assert match.undetermined is not None
    assert abs(np.dot(match.undetermined, along)) > math.cos(math.radians(1.0))
    # As wide as the first guess, and no wider: that along it is all that is known.
    assert along @ match.covariance[:2, :2] @ along == pytest.approx(0.3**2, rel=0.01)
    across = np.array((-along[1], along[0]))
    assert across @ match.covariance[:2, :2] @ across < 0.01**2


@given(st.lists(st.floats(-1.0, 1.0), min_size=9, max_size=9), st.floats(-0.1, 1.0))
def test_removing_a_motion_keeps_all_other_information(numbers, told):
    root = np.array(numbers).reshape(3, 3)
    c = 1.0 + root[2] @ root[2]
    place, coupling = np.diag((5.0, told)), root[:2, 2]
    full = np.zeros((3, 3))
    full[:2, :2] = place + np.outer(coupling, coupling) / c
    full[:2, 2] = full[2, :2] = coupling
    full[2, 2] = c
    rest = without_place(full, (0.0, 1.0))
    free = np.array((0.0, 1.0, -coupling[1] / c))
    assert np.abs(rest @ free).max() < 1e-9
    for other in np.array(((1.0, 0.0, 0.3), (0.0, 0.0, 1.0), (-2.0, 0.0, 1.0))):
        assert other @ rest @ other == pytest.approx(other @ full @ other, abs=1e-9)


def test_there_the_first_guess_decides_along_the_corridor():
    scans = corridor_scan((0.0, 0.0, 0.0), 0), corridor_scan((0.1, 0.05, 0.05), 1)
    match = match_scans(*scans, guess=(0.25, 0.0, 0.0))
    assert match.pose[0] == pytest.approx(0.25, abs=0.06)
    assert match.pose[1:] == pytest.approx((0.05, 0.05), abs=0.01)


def test_elsewhere_nothing_is_undetermined():
    assert not any(error.undetermined for error in some_errors(0.01, 30))


@pytest.mark.parametrize("sigma", [0.005, 0.01, 0.02])
def test_the_covariance_covers_the_error(sigma):
    """The mean of chi-square with 3 degrees of freedom is 3, for 100 pairs within 0.25.

    The covariance may be too small by a factor of 1.6 and, as it allows for rough walls, too
    large by one of 2.
    """
    nees = np.array([error.nees for error in some_errors(sigma, 100)])
    assert 3.0 / 2.0 < nees.mean() < 3.0 * 1.6
    assert np.mean(nees < CHI_SQUARE_95) > 0.85  # 95 % if it were exact


@pytest.mark.parametrize("name", ["GDC1", "AHG2"])
def test_exact_pairs_match_to_a_millimetre(name):
    """The covariance agrees with the error."""
    if not AMRL.exists():
        pytest.skip(f"{AMRL} is missing")
    plan, ways = (
        load_vector_map(AMRL / f"{name}.vectormap.json").plan,
        AMRL / f"{name}.navigation.json",
    )
    rng = np.random.default_rng(1)
    pairs = simulated_pairs(plan, poses_on(read_ways(ways), rng), rng)
    errors = list(errors_of(itertools.islice(pairs, 100)))
    assert np.median([error.position for error in errors]) < 0.0013
    assert np.median([error.angle for error in errors]) < math.radians(0.014)
    assert np.mean([error.nees < CHI_SQUARE_95 for error in errors]) > 0.9  # 95 % if it were exact


def test_real_scans_match_as_well_as_their_poses_are_known():
    if not FREIBURG.exists():
        pytest.skip(f"{FREIBURG} is missing")
    with open_log(FREIBURG) as log:
        found = list(log_differences(itertools.islice(log, 1000)))
    assert len(found) > 990
    assert np.median([difference.position for difference in found]) < 0.023
    assert np.median([difference.angle for difference in found]) < math.radians(0.44)
    assert np.median([difference.loop_position for difference in found]) < 0.01


@pytest.mark.parametrize("wheels", [False, True])
def test_the_drift_of_a_real_log_is_centimetres_in_ten_metres(wheels):
    if not FREIBURG.exists():
        pytest.skip(f"{FREIBURG} is missing")
    with open_log(FREIBURG) as log:
        drift = drift_of(itertools.islice(log, 800), wheels)
    assert drift.path > 30.0
    assert drift.lost < 8
    assert np.median(drift.position) < 0.15
    assert np.median(drift.angle) < math.radians(2.0)


@pytest.mark.parametrize(
    "ranges",
    [
        np.full(811, np.inf),
        np.full(811, np.nan),
        np.zeros(811),
        np.array([1.0]),
        np.array([1.0, np.inf, 1.0]),
        np.random.default_rng(0).uniform(0.1, 9.0, 811),
    ],
)
def test_a_scan_that_shows_nothing_is_refused(ranges):
    step = math.radians(1 / 3)
    scan = Scan(ranges, -2.356, step)
    for pair in ((scan, office_scan((15.0, 9.1, 0.0))), (office_scan((15.0, 9.1, 0.0)), scan)):
        with pytest.raises(MatchError, match="points of the scan fit"):
            match_scans(*pair)


@settings(max_examples=30)
@given(st.lists(st.sampled_from([0.0, 0.5, 2.0, 9.0, np.inf, -1.0, np.nan]), min_size=1))
def test_any_scan_gives_finite_numbers_or_an_error(ranges):
    scan = Scan(np.repeat(ranges, 12), -math.pi, math.radians(0.5))
    try:
        match = match_scans(scan, scan, guess=(0.2, 0.1, 0.3))
    except MatchError:
        return
    assert np.isfinite(match.pose).all()
    assert np.isfinite(match.covariance).all()
    assert np.linalg.eigvalsh(match.covariance).min() > 0.0


@pytest.mark.parametrize("start", [-math.pi, -1.0, 2.0])
def test_the_seam_of_a_full_circle_does_not_matter(start):
    step = math.radians(0.5)
    spec = replace(TIM561, beams=720, angle_min=start, angle_increment=step, sigma=0.01)
    lidar = Lidar(OFFICE, spec)
    here, move = (15.0, 9.1, 0.3), (0.1, -0.05, 0.08)
    scans = lidar.scan(here, key=(3, 0, 0)), lidar.scan(compose(here, move), key=(3, 0, 1))
    assert match_scans(*scans).pose == pytest.approx(move, abs=0.01)


@pytest.mark.parametrize("guess", [(math.nan, 0, 0), (0, math.inf, 0)])
def test_a_guess_is_finite(guess):
    scan = office_scan((15.0, 9.1, 0.0))
    with pytest.raises(ValueError, match="three finite numbers"):
        match_scans(scan, scan, guess)


@pytest.mark.parametrize("limit", [{"sigma": 0.0}, {"window": 0}, {"outliers": math.nan}])
def test_limits_are_checked(limit):
    with pytest.raises(ValueError, match=f"{next(iter(limit))} is .* it must be .* from"):
        MatchSettings(**limit)


@pytest.mark.parametrize("text", ["[]", "{", '[{"p0": {"x": 0}}]', '{"a": 1}', "[3]"])
def test_a_wrong_vector_map_is_refused_in_one_line(tmp_path, text):
    path = tmp_path / "floor.vectormap.json"
    path.write_text(text)
    with pytest.raises(ValueError, match=r"floor\.vectormap\.json: ") as error:
        load_vector_map(path)
    assert "\n" not in str(error.value)


def test_a_vector_map_keeps_its_walls(tmp_path):
    path = tmp_path / "floor.vectormap.json"
    path.write_text('[{"p0": {"x": 0, "y": 1}, "p1": {"x": 2, "y": 1}}]')
    plan = load_floor_plan(load_vector_map(path).plan)
    assert plan.name == "floor"
    np.testing.assert_array_equal(plan.segments, [[0.0, 1.0, 2.0, 1.0]])


@pytest.mark.parametrize("code", [np.nan, np.inf, -np.inf, 0.0, -1.0, 10.0, 81.83])
def test_what_stands_for_no_return_makes_no_difference(code):
    one, other = office_scan((5.0, 9.0, 0.1)), office_scan((5.1, 9.02, 0.12), 1)
    lost = np.random.default_rng(0).random(len(one.ranges)) < 0.15

    def matched(value):
        scans = [replace_ranges(each, np.where(lost, value, each.ranges)) for each in (one, other)]
        return match_scans(*scans).pose

    assert matched(code) == matched(np.inf)


def replace_ranges(scan, ranges):
    limits = 0.0, scan.range_max
    return Scan(ranges, scan.angle_min, scan.angle_increment, *limits)
