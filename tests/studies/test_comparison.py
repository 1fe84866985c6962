"""A scene compared with the truth: what counts as found, and how exact it is."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from semnav_features import Arc, Corner, CornerKind, CorridorProbe, Scene, Wall
from studies.features.comparison import compare_doors
from studies.features.metrics import calibration, calibration_error, score, segmentation_rates
from studies.features.overlap import Overlap, segmentation_rate
from studies.features.records import CountingLimits, Detection, FeatureKind, as_table
from tests.support.evaluation_cases import WALL, cases, tables


@given(st.integers(0, 1000))
@settings(max_examples=10, deadline=None)
def test_the_truth_itself_scores_one(seed):
    (case,) = cases(poses=1, sigmas=(0.0,), seed=seed)
    sightings, detections = tables(case.scans[0][1], case.truth, case.truth)
    assert sightings["found"].all()
    assert detections["right"].all()
    errors = np.stack([sightings[name] for name in ("angle", "place", "size")])
    assert np.nanmax(errors, initial=0.0) < 1e-9
    walls = len(sightings[sightings["kind"] == FeatureKind.WALL])
    assert walls == 0 or segmentation_rates(sightings) == pytest.approx((1.0, 1.0))


def test_nothing_found_is_recall_zero_and_no_precision():
    case = cases(poses=1)[0]
    sightings, detections = tables(case.scans[0][1], case.truth, Scene())
    each = score(sightings, detections, FeatureKind.WALL)
    assert each.recall == 0.0
    assert math.isnan(each.precision)
    assert segmentation_rates(sightings) == (0.0, 0.0)


def test_pieces_cover_a_wall_together_and_the_longest_alone():
    parts = [Wall((0.0, -1.0), (1.5, -1.0)), Wall((1.0, -1.02), (3.0, -1.02))]
    overlap = Overlap([WALL], parts)
    assert overlap.covered == pytest.approx([3.0])
    assert overlap.longest == pytest.approx([2.0])
    assert overlap.best(0) == 1
    assert segmentation_rate(overlap.lengths, overlap.longest) == pytest.approx(0.5)


@pytest.mark.parametrize(
    "other",
    [
        Wall((0.0, -1.2), (4.0, -1.2)),
        Wall((4.0, -1.0), (0.0, -1.0)),
        Wall((0.0, -1.0), (3.0, -0.3)),
        Wall((4.5, -1.0), (6.0, -1.0)),
    ],
    ids=["aside", "from behind", "askew", "farther on"],
)
def test_another_wall_covers_nothing(other):
    assert Overlap([WALL], [other]).covered == pytest.approx([0.0])


def test_a_corner_is_found_once_and_its_type_is_told_apart():
    corner = Corner((2.0, 0.0), CornerKind.INNER)
    truth = Scene(corners=(corner,))
    found = Scene(
        corners=(Corner((2.1, 0.0), CornerKind.OUTER), Corner((2.0, 0.05), CornerKind.INNER))
    )
    sightings, detections = tables(cases(poses=1)[0].scans[0][1], truth, found)
    each = score(sightings, detections, FeatureKind.FULL_CORNER)
    assert (each.recall, each.precision, each.type_right) == (1.0, 0.5, 1.0)
    assert each.place[0] == pytest.approx(0.05)
    assert each.place_share[0] == pytest.approx(0.025)
    potential = Scene(corners=(Corner((2.0, 0.0), CornerKind.POTENTIAL),))
    sightings, detections = tables(cases(poses=1)[0].scans[0][1], truth, potential)
    assert not sightings["found"].any()
    assert not detections["right"].any()


def test_an_arc_is_found_by_its_centre():
    arc = Arc((2.0, 0.0), 0.4, (2.0, 0.4), (2.0, -0.4), beams=30)
    near = replace(arc, centre=(2.0, 0.1), radius=0.42)
    sightings, detections = tables(
        cases(poses=1)[0].scans[0][1], Scene(arcs=(arc,)), Scene(arcs=(near,))
    )
    each = score(sightings, detections, FeatureKind.ARC)
    assert (each.gated, each.recall, each.precision) == (1, 1.0, 1.0)
    assert each.size[0] == pytest.approx(0.05)
    assert each.place[0] == pytest.approx(0.1)


def test_corridors_are_found_by_their_midpoints():
    corridor = CorridorProbe((2.0, -1.0), (2.0, 1.0))
    found = (CorridorProbe((2.1, 1.0), (2.1, -1.0)), CorridorProbe((3.0, 1.0), (3.0, -1.0)))
    sightings, detections = tables(
        cases(poses=1)[0].scans[0][1], Scene(corridors=(corridor,)), Scene(corridors=found)
    )
    each = score(sightings, detections, FeatureKind.CORRIDOR)
    assert (each.recall, each.precision) == (1.0, 0.5)


def test_a_door_in_poor_view_is_no_demand_but_right_if_found():
    for case in cases(poses=40, clutter=False):
        scan = case.scans[0][1]
        sightings, detections = compare_doors(
            scan, case.truth.doors, case.truth.doors, CountingLimits()
        )
        poor = [s for s in sightings if not s.gated]
        if poor:
            assert all(s.found for s in poor)
            assert all(d.right for d in detections)
            return
    pytest.fail("no door was in poor view")


def test_confidences_that_hold_have_no_calibration_error():
    rows = [Detection(FeatureKind.DOOR, 1.0, 0.0, k < 7, 0.7) for k in range(10)]
    bins = calibration(as_table(rows, Detection))
    assert [(b.detections, b.confidence, b.precision) for b in bins] == [
        (10, pytest.approx(0.7), pytest.approx(0.7))
    ]
    assert calibration_error(bins) == pytest.approx(0.0)
    assert math.isnan(calibration_error([]))
