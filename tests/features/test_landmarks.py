"""Maps of corners and columns: what they fuse, how sure they are, and poses found by them."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import load_floor_plan
from semnav_features import CornerKind, Scan, Scene, extract
from semnav_features.frames import compose, relative, wrap_angle
from semnav_features.mapping import (
    CorrectedOdometry,
    KeyframeRule,
    LandmarkMap,
    LandmarkSettings,
    MatchError,
    ScanOdometry,
    StepErrors,
    arc_sightings,
    corner_sightings,
    guesses_by_corners,
    match_by_corners,
    match_scans,
)
from semnav_features.mapping.gaussians import PlaceEstimate, fused, placed, squared_distance
from semnav_features.mapping.map_landmarks import hull, joined
from studies.landmarks.columns import column_errors, hall
from studies.landmarks.drift import drive_in_plan, followed, motions
from studies.landmarks.room import LANDMARKS, POSES, room, views
from studies.landmarks.room import fused as fused_room
from studies.landmarks.weerakoon import landmarks as by_the_paper

metres = st.floats(-5.0, 5.0)
angles = st.floats(-math.pi, math.pi)
poses = st.tuples(metres, metres, angles)
variances = st.floats(1e-4, 1.0)
OFFICE = load_floor_plan("office_cross")
CORNER_VIEW = (3.5, 9.1, 0.3)
EXACT = LandmarkSettings(position=0.0, angle=0.0, sightings=1)


@st.composite
def estimates(draw):
    a, b, turn = draw(variances), draw(variances), draw(angles)
    c, s = math.cos(turn), math.sin(turn)
    axes = np.array(((c, -s), (s, c)))
    return PlaceEstimate(np.array((draw(metres), draw(metres))), axes @ np.diag((a, b)) @ axes.T)


def lidar_of(plan, sigma=0.01):
    return Lidar(plan, replace(Lidar(plan).spec, sigma=sigma, dropout=0.0))


# Estimates


@given(estimates(), estimates())
def test_fusing_does_not_depend_on_the_order(a, b):
    one, other = fused(a, b), fused(b, a)
    assert one.mean == pytest.approx(other.mean, abs=1e-6)
    assert one.covariance == pytest.approx(other.covariance, abs=1e-6)


@given(estimates(), estimates())
def test_what_is_fused_has_the_information_of_both(a, b):
    information = np.linalg.inv(a.covariance) + np.linalg.inv(b.covariance)
    assert np.linalg.inv(fused(a, b).covariance) == pytest.approx(information, rel=1e-6, abs=1e-3)


@given(estimates(), estimates(), poses)
def test_distance_in_deviations_is_the_same_in_every_frame(a, b, frame):
    exact = np.zeros((3, 3))
    moved = squared_distance(placed(a, frame, exact), placed(b, frame, exact))
    assert moved == pytest.approx(squared_distance(a, b), rel=1e-6, abs=1e-6)


@given(estimates(), poses)
def test_an_uncertain_heading_blurs_what_is_far_away(local, frame):
    spread = placed(local, frame, np.diag((0.0, 0.0, 0.01)))
    added = spread.covariance - placed(local, frame, np.zeros((3, 3))).covariance
    assert np.trace(added) == pytest.approx(0.01 * float(local.mean @ local.mean), abs=1e-9)


# Parts of a circle


@given(st.lists(st.tuples(angles, st.floats(0.01, 3.0)), min_size=1, max_size=6))
def test_joined_parts_cover_what_the_parts_cover(parts):
    def covered(some, angle):
        return any((angle - start) % math.tau <= extent for start, extent in some)

    whole = joined(parts)
    edges = [(a + k * e) % math.tau for a, e in parts for k in (0.0, 1.0)]
    for angle in np.linspace(0.0, math.tau, 50):
        if min(abs(wrap_angle(angle - edge)) for edge in edges) > 1e-6:
            assert covered(whole, angle) == covered(parts, angle)
            assert covered([hull(parts)], angle) or not covered(parts, angle)


# Sightings


def test_an_end_behind_something_nearer_is_no_landmark():
    """The edge of a shadow moves with the scanner."""
    lidar, plan = lidar_of(room()), room()
    scan = lidar.scan(POSES[1], key=(0, 0, 0))
    true = np.array([p for surface in plan.surfaces for p in surface.points])
    for corner in corner_sightings(extract(scan), scan):
        place = placed(corner.place, POSES[1], np.zeros((3, 3))).mean
        assert np.hypot(*(true - place).T).min() < 0.15


def test_an_end_at_the_edge_of_the_view_is_no_landmark():
    angles = np.radians(np.arange(-60.0, 60.5, 0.5))
    scan = Scan(2.0 / np.cos(angles), angles[0], math.radians(0.5))
    assert extract(scan).walls
    assert not corner_sightings(extract(scan), scan)


@settings(max_examples=20)
@given(poses)
def test_a_corner_keeps_its_kind_in_every_frame(frame):
    lidar = lidar_of(OFFICE)
    scan = lidar.scan(CORNER_VIEW, key=(0, 0, 0))
    still, moved = LandmarkMap(EXACT), LandmarkMap(EXACT)
    still.add(extract(scan), scan, CORNER_VIEW)
    moved.add(extract(scan), scan, compose(frame, CORNER_VIEW))
    assert still.corners
    for a, b in zip(still.corners, moved.corners, strict=True):
        assert a.kind is b.kind
        there = compose(frame, (*a.point, 0.0))
        assert b.point == pytest.approx(there[:2], abs=1e-6)


def test_the_deviations_of_single_corners_are_as_claimed():
    """Of the corners in 60 scans of the office, with 20 mm of noise; 2 is right."""
    true = np.array([p for surface in OFFICE.surfaces for p in surface.points])
    lidar, found = lidar_of(OFFICE, 0.02), []
    for step, x in enumerate(np.linspace(3.0, 27.0, 60)):
        pose = (x, 9.1 + 0.2 * math.sin(step), 0.1 * step)
        scan = lidar.scan(pose, key=(0, 0, step))
        for corner in corner_sightings(extract(scan), scan):
            place = placed(corner.place, pose, np.zeros((3, 3)))
            off = place.mean - true[np.argmin(np.hypot(*(true - place.mean).T))]
            found.append(off @ np.linalg.solve(place.covariance, off))
    assert len(found) > 200
    assert 1.0 < np.mean(np.minimum(found, 50.0)) < 2.6
    assert np.mean(np.array(found) < 5.991) > 0.9


@settings(max_examples=15)
@given(st.integers(1, 719))
def test_it_makes_no_difference_where_a_full_circle_begins(shift):
    step = math.tau / 720
    spec = replace(Lidar(OFFICE).spec, beams=720, angle_min=-math.pi, angle_increment=step)
    scan = Lidar(OFFICE, spec).scan(CORNER_VIEW, key=(0, 0, 0))
    rolled = Scan(np.roll(scan.ranges, -shift), scan.angle_min + shift * step, step)

    def places(some):
        seen = corner_sightings(extract(some), some)
        return sorted((*corner.place.mean, *corner.place.covariance.ravel()) for corner in seen)

    assert len(places(scan)) > 3
    assert np.array(places(rolled)) == pytest.approx(np.array(places(scan)), abs=1e-6)


def test_a_scene_without_walls_has_no_landmarks():
    scan = lidar_of(OFFICE).scan(CORNER_VIEW, key=(0, 0, 0))
    corners = extract(scan).corners
    assert corner_sightings(Scene(corners=corners), scan) == []


# Maps of corners


def test_an_empty_map_has_no_landmarks():
    assert LandmarkMap().scene == Scene()


def test_scans_from_one_place_count_once():
    lidar, landmarks = lidar_of(OFFICE), LandmarkMap()
    for step in range(5):
        scan = lidar.scan(CORNER_VIEW, key=(0, 0, step))
        landmarks.add(extract(scan), scan, CORNER_VIEW)
    assert landmarks.scans == 1
    assert not landmarks.corners


def test_the_ten_landmarks_of_table_two_are_within_their_covariances():
    """Weerakoon et al., table II: 20 trials of three scans; NEES 2 is right."""
    errors, nees = [], []
    for trial in range(20):
        for place, covariance in fused_room(views(0.01, trial)):
            off = place - min(LANDMARKS.values(), key=lambda p: math.dist(p, place))
            if np.hypot(*off) < 0.1:
                errors.append(np.hypot(*off))
                nees.append(off @ np.linalg.solve(covariance, off))
    assert len(errors) > 180
    assert np.mean(errors) < 0.006
    assert 0.9 < np.mean(nees) < 2.5


def test_covariances_place_corners_better_than_points_alone():
    """Least squares with covariances against the paper's new fit to all points, on equal scans."""
    ours, theirs = [], []
    for trial in range(15):
        seen = views(0.01, trial)
        plain = by_the_paper([(scene, pose) for scene, _, pose in seen])
        for true in LANDMARKS.values():
            a = min(math.dist(place, true) for place, _ in fused_room(seen))
            b = min(math.dist(place, true) for place in plain)
            if max(a, b) < 0.1:
                ours.append(a**2)
                theirs.append(b**2)
    assert np.mean(ours) < 0.7 * np.mean(theirs)


def test_more_scans_make_a_landmark_surer():
    lidar, landmarks = lidar_of(room()), LandmarkMap(EXACT)
    traces = []
    for step in range(6):
        pose = (0.02 * step, 0.15 * step, math.pi / 2)
        scan = lidar.scan(pose, key=(1, 0, step))
        landmarks.add(extract(scan), scan, pose)
        near = [c for c in landmarks.corners if math.dist(c.point, LANDMARKS["C6"]) < 0.1]
        traces.append(min(np.trace(corner.covariance) for corner in near))
    assert traces[-1] < 0.5 * traces[0]


def test_two_loose_ends_of_one_corner_become_a_full_corner():
    """Each scan sees one of its walls; only together they say of which kind it is."""
    lidar, landmarks = lidar_of(room()), LandmarkMap(replace(EXACT, sightings=2))
    for step, pose in enumerate(POSES):
        scan = lidar.scan(pose, key=(1, 0, step))
        landmarks.add(extract(scan), scan, pose)
    kinds = {c.kind for c in landmarks.corners}
    assert CornerKind.INNER in kinds
    assert all(corner.sightings >= 2 for corner in landmarks.corners)


# Columns


@pytest.mark.parametrize("radius", [0.15, 0.5])
def test_a_column_seen_from_all_around_is_one(radius):
    errors = [column_errors(radius, 6, 0.01, trial) for trial in range(10)]
    assert all(error is not None and error.columns == 1 for error in errors)
    assert np.median([error.fused[0] for error in errors]) < 0.002
    assert np.median([error.fused for error in errors]) < np.median([e.first for e in errors])
    assert np.mean([error.nees for error in errors]) < 4.0


def test_a_column_seen_from_all_around_is_nearly_a_whole_circle():
    lidar, landmarks = lidar_of(hall(0.3)), LandmarkMap(EXACT)
    for step in range(6):
        bearing = math.tau * step / 6
        pose = (2.0 * math.cos(bearing), 2.0 * math.sin(bearing), bearing + math.pi)
        scan = lidar.scan(pose, key=(0, 0, step))
        assert arc_sightings(extract(scan), scan)
        landmarks.add(extract(scan), scan, pose)
    (column,) = landmarks.scene.arcs
    assert column.extent > 0.9 * math.tau
    assert column.radius == pytest.approx(0.3, abs=0.005)


# Poses


def test_landmarks_find_the_place_along_a_corridor():
    """Where walls alone say nothing."""
    lidar, landmarks = lidar_of(OFFICE), LandmarkMap(replace(EXACT, sightings=2))
    for step, x in enumerate(np.linspace(12.0, 14.0, 12)):
        scan = lidar.scan((x, 9.1, 0.0), key=(0, 0, step))
        landmarks.add(extract(scan), scan, (x, 9.1, 0.0))
    true = (13.0, 9.15, 0.05)
    scan = lidar.scan(true, key=(1, 0, 0))
    guess = compose(true, (0.15, 0.05, 0.02))
    information = np.diag((1 / 0.2**2, 1 / 0.2**2, 1 / 0.05**2))
    fix = landmarks.locate(extract(scan), scan, guess, information)
    assert fix.matched >= 2
    assert fix.pose == pytest.approx(true, abs=0.02)
    off = np.array(relative(true, fix.pose))
    assert off @ fix.information @ off < 30.0


def test_without_landmarks_the_guess_stays():
    scan = lidar_of(OFFICE).scan(CORNER_VIEW, key=(0, 0, 0))
    information = np.eye(3)
    fix = LandmarkMap().locate(extract(scan), scan, CORNER_VIEW, information)
    assert fix.pose == CORNER_VIEW
    assert fix.matched == 0
    assert (fix.information == information).all()


def test_landmarks_take_out_drift_that_walls_leave():
    """Along the corridor of the office and back, with the errors of a wheelchair."""
    way = [*np.linspace(4.0, 24.0, 80), *np.linspace(24.0, 4.0, 80)]
    drive = drive_in_plan(OFFICE, [(x, 9.1, 0.05 * math.sin(x)) for x in way])
    off = np.zeros(2)
    for seed in range(3):
        moved = motions(drive, seed)
        for k, landmarks in enumerate((False, True)):
            found = followed(drive, moved, landmarks)
            off[k] += math.dist(found[-1][:2], drive.poses[-1][:2])
    assert off[1] < 0.6 * off[0]


def test_odometry_errors_have_bounds():
    with pytest.raises(ValueError, match="per_metre"):
        StepErrors(per_metre=-1.0)
    with pytest.raises(ValueError, match="reach"):
        LandmarkSettings(reach=0.0)


def test_corrected_odometry_without_landmarks_has_no_map_of_them():
    odometry = CorrectedOdometry(landmarks=False)
    scan = lidar_of(OFFICE).scan(CORNER_VIEW, key=(0, 0, 0))
    odometry.update(scan)
    assert odometry.landmarks is None
    assert odometry.pose == (0.0, 0.0, 0.0)


# Far guesses


@settings(max_examples=20)
@given(st.floats(-1.0, 1.0), st.floats(-0.5, 0.5), angles)
def test_corners_match_scans_whatever_the_guess_of_the_heading(forward, left, turn):
    lidar = lidar_of(OFFICE)
    first, move = (15.0, 9.1, 0.4), (forward, 0.5 * left, 0.5)
    scans = lidar.scan(first, key=(0, 0, 0)), lidar.scan(compose(first, move), key=(0, 0, 1))
    corners = [corner_sightings(extract(scan), scan) for scan in scans]
    guess = (0.0, 0.0, turn)
    near = [relative(move, pose) for pose in guesses_by_corners(*corners, guess)]
    assume(near)
    best = min(near, key=lambda off: math.hypot(*off))
    assert math.hypot(best[0], best[1]) < 0.3
    assert abs(best[2]) < 0.1
    assert match_by_corners(*scans, guess).pose == pytest.approx(move, abs=0.02)


def test_corners_never_make_a_match_worse():
    lidar = lidar_of(OFFICE)
    views = (15.0, 9.1, 0.4), (15.2, 9.1, 0.5)
    scans = [lidar.scan(view, key=(0, 0, step)) for step, view in enumerate(views)]
    plain, by_corners = match_scans(*scans), match_by_corners(*scans)
    assert by_corners.inliers >= plain.inliers


def test_scans_without_corners_and_points_do_not_match():
    empty = Scan(np.full(181, np.inf), -math.pi / 2, math.pi / 180)
    with pytest.raises(MatchError):
        match_by_corners(empty, empty)


def test_odometry_goes_on_after_a_jump_if_it_knows_corners():
    lidar = lidar_of(OFFICE)
    way = [(13.0 + 0.1 * k, 9.1, 0.0) for k in range(5)] + [(14.6, 9.2, 1.2)]
    lost = {}
    for corners in (False, True):
        odometry = ScanOdometry(rule=KeyframeRule(corners=corners))
        for step, pose in enumerate(way):
            odometry.update(lidar.scan(pose, key=(0, 0, step)))
        lost[corners] = math.dist(compose(way[0], odometry.pose)[:2], way[-1][:2])
    assert lost[False] > 0.3
    assert lost[True] < 0.05
