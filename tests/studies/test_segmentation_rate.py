from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from semnav_env.world.lidar import TIM561
from semnav_env.world.maps import load_floor_plan
from semnav_features import ExtractorSettings
from studies.__main__ import STUDIES
from studies.segmentation.segment_labels import NO_SEGMENT, found_lines, label, labelled_scans
from studies.segmentation.segmentation import detected_length, measure, segmentation_rate
from studies.truth import TrueView
from tests.support.small_plans import closed, plan_of

SETTINGS = ExtractorSettings()
POINTS = np.stack((np.arange(10.0), np.zeros(10)), axis=1)
TWO_WALLS = np.array([0, 0, 0, 0, 1, 1, 1, 1, 1, 1])
"""Of 3 and 5 m."""

labels = hnp.arrays(np.int64, 10, elements=st.integers(NO_SEGMENT, 3))


@pytest.mark.parametrize(
    ("found", "rate"),
    [
        ([7, 7, 7, 7, 2, 2, 2, 2, 2, 2], 1.0),
        ([NO_SEGMENT] * 10, 0.0),
        (
            [0, 0, 0, 0, NO_SEGMENT, NO_SEGMENT, NO_SEGMENT, NO_SEGMENT, NO_SEGMENT, NO_SEGMENT],
            3 / 8,
        ),
        ([0, 0, 0, 0, 1, 1, 1, 1, 2, 2], 6 / 8),
        ([0] * 10, 5 / 8),
        ([0, 0, 0, 0, 1, 2, 3, 4, 5, 6], 3 / 8),
    ],
)
def test_walls_and_pieces_are_matched_one_to_one(found: list[int], rate: float) -> None:
    assert segmentation_rate(POINTS, TWO_WALLS, np.array(found)) == pytest.approx(rate)


def test_a_piece_may_span_the_stretches_of_one_wall() -> None:
    found = np.zeros(10, np.int64)
    assert segmentation_rate(POINTS, TWO_WALLS, found, owners=np.array([0, 0])) == 1.0


def test_without_walls_in_view_there_is_no_rate() -> None:
    assert math.isnan(segmentation_rate(POINTS, np.full(10, NO_SEGMENT), TWO_WALLS))


@given(labels, labels)
def test_no_more_is_detected_than_there_is(true: np.ndarray, found: np.ndarray) -> None:
    detected, expected = detected_length(POINTS, true, found)
    assert 0.0 <= detected <= expected <= 9.0


@given(labels)
def test_the_truth_detects_all_of_itself(true: np.ndarray) -> None:
    detected, expected = detected_length(POINTS, true, true)
    assert detected == expected


@given(labels, labels)
def test_names_of_found_segments_do_not_matter(true: np.ndarray, found: np.ndarray) -> None:
    renamed = np.where(found == NO_SEGMENT, NO_SEGMENT, 9 - found)
    assert detected_length(POINTS, true, renamed) == pytest.approx(
        detected_length(POINTS, true, found)
    )


@settings(max_examples=20, deadline=None)
@given(st.floats(-2.0, 2.0), st.floats(-1.0, 1.0), st.floats(-math.pi, math.pi))
def test_every_beam_in_a_room_is_labelled_with_its_wall(x: float, y: float, heading: float) -> None:
    room = plan_of(closed((-3.0, -2.0), (3.0, -2.0), (3.0, 2.0), (-3.0, 2.0)))
    view = TrueView(room, TIM561)
    scan = view.scan((x, y, heading))
    labelled = label(scan, 0.0, view.scene((x, y, heading)), SETTINGS)
    assert (labelled.surfaces == 0).all()
    assert np.hypot(*labelled.points.T) == pytest.approx(scan.ranges, abs=1e-6)
    assert segmentation_rate(labelled.points, labelled.lines, found_lines(scan, SETTINGS)) > 0.97


def test_the_default_brings_back_97_percent_of_the_walls() -> None:
    rng = np.random.default_rng(5)
    scans = [
        scan
        for name in ("heidelberg_hallway", "office_cross", "villa_hall")
        for scan in labelled_scans(load_floor_plan(name), 10, (0.0, 0.02), rng, SETTINGS)
    ]
    shipped = measure(scans, SETTINGS)
    assert [rate.scans for rate in shipped] == [30, 30]
    assert min(rate.lines for rate in shipped) >= 0.97
    thesis = replace(SETTINGS, breakpoint_angle=math.radians(10.0))
    pairs = zip(shipped, measure(scans, thesis), strict=True)
    assert all(new.lines > old.lines and new.surfaces > old.surfaces for new, old in pairs)


def test_the_command_gives_a_rate_for_every_strategy(capsys: pytest.CaptureFixture[str]) -> None:
    plan = "--plans", "villa_hall"
    words = ["segmentation", *plan, "--poses", "2", "--sigma", "0.02", "--json"]
    assert STUDIES.main(words) == 0
    rows = json.loads(capsys.readouterr().out)
    assert {row["strategy"] for row in rows} >= {
        "default",
        "breakpoint_rule=lee",
        "breakpoint_rule=weerakoon, 10 degrees",
    }
    assert all(0.0 < row["lines"] <= 1.0 for row in rows)
