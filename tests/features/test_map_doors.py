"""Doors of a map: which sightings are one door, which doors count, and where their jambs are."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import box

from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import FloorPlan, Surface
from semnav_features import ExtractorSettings
from semnav_features.elements import Door
from semnav_features.frames import compose, to_local, to_parent
from semnav_features.mapping import MapSettings
from semnav_features.mapping.doorway import DoorwayEvidence
from semnav_features.mapping.map_door import MapDoor, weighted_median
from semnav_features.mapping.map_doors import MapDoors, squareness
from studies.doors.map_doors import findings, map_sheets, mapped
from studies.doors.openings import LabelledOpening, read_openings
from studies.doors.real_doors import FREIBURG, FREIBURG_LABELS
from tests.support.paths import DATA

DOOR = (-0.5, 1.0, 0.4, 1.0)
"""An opening of 0.9 m in the wall of a corridor."""

VIEWS = [(x, 0.0, 0.9) for x in np.linspace(-2.0, 2.0, 21)]

metres = st.floats(-20.0, 20.0)
poses = st.tuples(metres, metres, st.floats(-math.pi, math.pi))


def corridor(*more, reveal=0.0):
    """A corridor along x whose left wall, `reveal` thick, has one opening, with a room behind."""
    x1, y, x2, _ = DOOR
    left = ((-8.0, y), (x1, y), (x1, y + reveal)) if reveal else ((-8.0, y), (x1, y))
    right = ((x2, y + reveal), (x2, y), (8.0, y)) if reveal else ((x2, y), (8.0, y))
    walls = left, right, ((-4.0, 4.0), (4.0, 4.0)), ((8.0, -1.0), (-8.0, -1.0)), *more
    surfaces = tuple(Surface(points) for points in walls)
    return FloorPlan("made", surfaces, (), (), (), (), box(-100.0, -100.0, 100.0, 100.0))


def sighting(pose, ends=DOOR, confidence=1.0):
    """A door as it is seen from a pose."""
    start, end = to_local(pose, ends[:2]), to_local(pose, ends[2:])
    return Door(start, end, confidence=confidence)


def map_of(sightings, plan=None, views=VIEWS, **limits):
    """Doors of a map of which scan k showed the doors sightings(k, pose)."""
    lidar, doors = Lidar(plan or corridor()), MapDoors(MapSettings(**limits))
    for k, pose in enumerate(views):
        doors.add(sightings(k, pose), lidar.scan(pose, key=(5, 0, k)), pose)
    return doors.believed


def test_a_door_that_every_scan_shows_counts_and_is_certain():
    (door,) = map_of(lambda k, pose: [sighting(pose)])
    assert door.sightings == len(VIEWS)
    assert door.confidence > 0.9


def test_a_door_is_as_certain_as_its_sightings():
    (sure,) = map_of(lambda k, pose: [sighting(pose, confidence=1.0)])
    (half,) = map_of(lambda k, pose: [sighting(pose, confidence=0.6)])
    assert half.confidence == pytest.approx(0.6 * sure.confidence)


def test_looks_without_a_door_are_evidence_against_it():
    always = map_of(lambda k, pose: [sighting(pose)])
    often = map_of(lambda k, pose: [sighting(pose)] if k % 2 else [])
    seldom = map_of(lambda k, pose: [sighting(pose)] if k % 5 == 0 else [])
    assert often[0].confidence < 0.7 * always[0].confidence
    assert not seldom


def test_sightings_of_little_confidence_make_no_door():
    assert not map_of(lambda k, pose: [sighting(pose, confidence=0.2)])


@pytest.mark.parametrize("depth", [0.0, 0.1, 0.25])
def test_an_opening_that_is_closed_or_but_a_niche_is_no_door(depth):
    y = DOOR[1] + depth
    closed = corridor(((DOOR[0], y), (DOOR[2], y)))
    assert not map_of(lambda k, pose: [sighting(pose)], closed)


def test_two_doors_in_a_row_are_two_and_two_in_one_place_are_one():
    beside = (1.4, 1.0, 2.3, 1.0)
    plan = corridor()
    wall = Surface(((0.4, 1.0), (1.4, 1.0))), Surface(((2.3, 1.0), (8.0, 1.0)))
    plan = FloorPlan("made", (plan.surfaces[0], *wall), (), (), (), (), plan.boundary)
    both = map_of(lambda k, pose: [sighting(pose), sighting(pose, beside)], plan)
    assert len(both) == 2
    behind = (-0.5, 1.45, 0.4, 1.45)
    twice = map_of(lambda k, pose: [sighting(pose), sighting(pose, behind, 0.8)])
    assert len(twice) == 1
    assert twice[0].midpoint == pytest.approx((-0.05, 1.0), abs=0.05)


@given(poses, st.lists(st.booleans(), min_size=2, max_size=6))
def test_the_direction_of_a_sighting_does_not_matter(frame, turns):
    ends = np.array((*to_parent(frame, DOOR[:2]), *to_parent(frame, DOOR[2:])))
    turned = ends[[2, 3, 0, 1]]
    door = MapDoor([ends], [1.0], 1.0)
    for turn in turns:
        assert door.distance(turned if turn else ends) < 1e-9
        door.see(turned if turn else ends, 1.0, 1.0)
    assert door.ends == pytest.approx(ends)
    assert door.share == 1.0


@given(st.lists(st.floats(-9.0, 9.0), min_size=1, max_size=9))
def test_with_equal_weights_the_weighted_median_is_the_median(values):
    rows = [np.array((value, -value)) for value in values]
    median = weighted_median(rows, [0.3] * len(rows))
    assert median == pytest.approx(np.median(rows, axis=0))


def test_a_door_lies_where_it_was_seen_square():
    near, far = np.array((0.0, 0.0, 1.0, 0.0)), np.array((0.1, 0.0, 1.1, 0.0))
    door = MapDoor([near], [1.0], 1.0)
    for _ in range(3):
        door.see(far, squareness(Door((3.0, 0.5), (4.0, 0.5))), 1.0)
    assert door.ends == pytest.approx(near)


def test_sightings_that_come_to_agree_are_one_door():
    """Two that lie 0.4 m apart begin two doors; those in between make one of them."""

    def shifted(k, pose):
        x = (0.0, 0.4, 0.15, 0.2, 0.2)[min(k, 4)]
        return [sighting(pose, (DOOR[0] + x - 0.2, 1.0, DOOR[2] + x - 0.2, 1.0))]

    (door,) = map_of(shifted)
    assert door.sightings == len(VIEWS)


@settings(max_examples=10)
@given(poses, st.floats(-0.1, 0.1), st.floats(-0.1, 0.1))
def test_beams_tell_where_the_jambs_are(frame, first, last):
    """However far off the ends of the walls were taken to be, and wherever the map's origin is."""
    jambs = to_parent(frame, DOOR[:2]), to_parent(frame, DOOR[2:])
    seen = to_parent(frame, (DOOR[0] + first, 1.0)), to_parent(frame, (DOOR[2] + last, 1.0))
    ends = np.array(seen).ravel()
    passage, lidar = DoorwayEvidence(ends), Lidar(corridor())
    for k, pose in enumerate(VIEWS):
        passage.observe(lidar.scan(pose, key=(5, 0, k)), compose(frame, pose))
    assert passage.bounds(ends) == pytest.approx(np.array(jambs).ravel(), abs=0.02)


def test_a_reveal_hides_at_most_two_centimetres():
    """Oblique beams that pass the one jamb end on the reveal of the other."""
    plan, passage = corridor(reveal=0.15), DoorwayEvidence(np.array(DOOR))
    lidar = Lidar(plan)
    for k, pose in enumerate(VIEWS):
        passage.observe(lidar.scan(pose, key=(5, 0, k)), pose)
    assert passage.bounds(np.array(DOOR)) == pytest.approx(np.array(DOOR), abs=0.02)


def test_few_looks_leave_the_jambs_where_they_were_seen():
    passage, ends = DoorwayEvidence(np.array(DOOR)), np.array((-0.45, 1.0, 0.45, 1.0))
    lidar = Lidar(corridor())
    for k, pose in enumerate(VIEWS[8:13]):
        passage.observe(lidar.scan(pose, key=(5, 0, k)), pose)
    assert passage.looks == 5
    assert (passage.bounds(ends) == ends).all()


def test_a_passage_knows_when_its_door_has_moved_off_it():
    passage = DoorwayEvidence(np.array(DOOR))
    assert passage.lies_along(np.array((-0.48, 1.02, 0.42, 1.02)))
    assert not passage.lies_along(np.array((-0.5, 1.1, 0.4, 1.1)))  # beside it
    assert not passage.lies_along(np.array((-0.5, 1.04, 0.4, 0.96)))  # turned
    assert not passage.lies_along(np.array((-0.2, 1.0, 0.7, 1.0)))  # farther along


# Against labels


def opening(ends, group="north", certain=True):
    return LabelledOpening(Door(ends[:2], ends[2:], "N"), group, certain, "")


def found(ends):
    return Door(ends[:2], ends[2:])


OPENINGS = [opening((x, 1.0, x + 0.8, 1.0)) for x in (0.0, 5.0)]


def test_an_opening_is_matched_by_the_nearest_door():
    near, nearer = found((0.2, 1.0, 1.0, 1.0)), found((0.83, 1.01, 0.02, 1.0))
    first, second, rest = findings([near, nearer], OPENINGS)
    assert (first.door, second.door, rest.door) == (nearer, None, near)
    assert first.off == pytest.approx(math.hypot(0.03, 0.01))
    assert rest.opening is None


@pytest.mark.parametrize(
    ("ends", "inside"),
    [
        ((2.0, 1.1, 3.0, 1.1), 1),
        ((3.0, 0.9, 2.0, 1.0), 1),
        ((2.0, 1.5, 3.0, 1.5), 0),
        ((2.5, 0.6, 2.5, 1.4), 0),
        ((7.0, 1.0, 8.0, 1.0), 0),
    ],
    ids=["in it", "turned round", "in the room behind", "across", "beyond its end"],
)
def test_phantoms_are_told_by_whether_they_share_the_wall(ends, inside):
    summary, each = map_sheets([found(ends)], OPENINGS)
    told = {row[0]: row[1:] for row in summary.rows}
    assert told["not labelled"][1] == 1
    assert told["of them in the corridor's walls"][1] == inside
    assert told["north, certain"][:3] == (2, 0, 0)
    assert len(each.rows) == 3


def test_the_real_corridor_is_mapped_to_six_centimetres():
    """Its walls hold no door that is not labelled."""
    log = DATA / FREIBURG
    if not log.exists():
        pytest.skip(f"{log} is missing")
    *_, line_map = mapped(log, ExtractorSettings(), every=3)
    summary, _ = map_sheets(line_map.doors, read_openings(FREIBURG_LABELS))
    told = {row[0]: row[1:] for row in summary.rows}
    assert told["north, certain"][:2] == (4, 4)
    assert told["north, certain"][3] < 6.0
    assert told["north, all"][:2] == (5, 5)
    assert told["of them in the corridor's walls"][1] == 0
