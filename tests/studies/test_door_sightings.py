"""When a door counts as seen, and which detections count as that door."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_features.frames import to_local
from semnav_features.scene import Door
from studies.doors.door_sightings import DoorCounts, Gate, View, judge, matches
from studies.doors.openings import LABELS_FOLDER, read_openings
from tests.support.raycaster import polyline, scan_of

WALLS = np.concatenate(
    (
        polyline((-6.0, 1.0), (0.0, 1.0), (0.0, 3.0)),
        polyline((0.9, 3.0), (0.9, 1.0), (6.0, 1.0)),
    )
)
DOOR = Door((0.0, 1.0), (0.9, 1.0))


def seen_from(x, y, heading=math.pi / 2):
    pose = (x, y, heading)
    return scan_of(WALLS, pose), Door(to_local(pose, DOOR.start), to_local(pose, DOOR.end))


def test_a_door_straight_ahead_is_gated():
    scan, door = seen_from(0.4, -1.0)
    assert Gate().view(scan, door.start, door.end) is View.GATED


@pytest.mark.parametrize(("x", "y"), [(0.4, 0.7), (3.6, 0.0)])
def test_near_and_grazing_doors_are_seen_but_not_gated(x, y):
    scan, door = seen_from(x, y)
    assert Gate().view(scan, door.start, door.end) is View.SEEN


def test_a_door_out_of_reach_or_with_a_hidden_jamb_is_not_seen():
    scan, door = seen_from(0.4, -4.0)
    assert Gate().view(scan, door.start, door.end) is View.HIDDEN
    scan, door = seen_from(0.4, -1.0, heading=-math.pi / 2)
    assert Gate().view(scan, door.start, door.end) is View.HIDDEN


def test_a_closed_door_is_not_gated():
    pose = (0.4, -1.0, math.pi / 2)
    closed = np.concatenate((WALLS, polyline((0.0, 1.0), (0.9, 1.0))))
    jambs = (to_local(pose, DOOR.start), to_local(pose, DOOR.end))
    assert Gate().view(scan_of(closed, pose), *jambs) is View.SEEN


@given(st.floats(-0.2, 1.1), st.floats(-2.5, 0.0), st.floats(0.0, math.tau))
def test_the_order_of_the_jambs_does_not_matter(x, y, heading):
    scan, door = seen_from(x, y, heading)
    gate = Gate()
    assert gate.view(scan, door.start, door.end) is gate.view(scan, door.end, door.start)


def test_both_ends_must_match():
    shifted = Door((0.2, 1.0), (1.1, 1.0))
    assert matches(shifted, DOOR.start, DOOR.end)
    assert matches(shifted, DOOR.end, DOOR.start)
    assert not matches(Door((0.0, 1.0), (1.2, 1.0)), DOOR.start, DOOR.end)


def test_counts_of_a_scan():
    scan, door = seen_from(0.4, -1.0)
    false = Door((1.0, 1.0), (2.0, 1.0))
    pane = Door((2.0, 1.0), (3.0, 1.0))
    counts = judge(scan, [door, false, pane], [door], undecided=[pane])
    assert counts == DoorCounts(1, 1, 1, 1, detections=3, right=1, undecided=1)
    assert counts.precision == 1 / 2
    assert counts.precision_at_least == 1 / 3
    assert (counts + judge(scan, [], [door])).recall == 1 / 2


def test_labelled_openings_have_the_stated_widths():
    openings = read_openings(LABELS_FOLDER / "freiburg_079_openings.csv")
    assert len({opening.door.name for opening in openings}) == len(openings)
    assert all(0.5 <= opening.door.width <= 1.3 for opening in openings)


def test_an_opening_with_a_missing_field_is_named(tmp_path):
    file = tmp_path / "openings.csv"
    file.write_text("id,group,x1,y1,x2,y2,certain,note\nN9,north,0,0,1,0,perhaps,\n")
    with pytest.raises(ValueError, match="N9"):
        read_openings(file)
