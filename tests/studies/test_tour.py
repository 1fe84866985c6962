"""The study of a tour with drift, in small."""

from __future__ import annotations

import json

import numpy as np
import pytest
from shapely import LineString

from semnav_env.robots import SPOT
from semnav_env.world.maps.check import check
from studies.__main__ import STUDIES
from studies.tour.pursuit import PlanPursuit
from studies.tour.tour import CORRECTIONS, result, tour
from studies.tour.villa import ROOMS, SPACING, START, STOPS, room_at, tour_way, villa
from tests.support.command_line import run

TUNED = 1000
"""A seed on which rules may be chosen."""


def test_the_villa_has_ten_rooms_and_no_fault():
    assert len(ROOMS) == 10
    assert check(villa(), SPOT) == []


def test_the_way_enters_every_room_and_comes_back():
    way = tour_way()
    assert {room_at(tuple(place)) for place in way.tolist()} == {*ROOMS, ""}
    assert way[0] == pytest.approx(START[:2])
    assert way[-1] == pytest.approx(STOPS[-1][1])
    assert np.hypot(*np.diff(way, axis=0).T).max() <= SPACING + 1e-9


def test_the_way_crosses_no_wall_but_in_doors():
    line = LineString(tour_way())
    assert not any(line.intersects(LineString(s.points)) for s in villa().surfaces)


def test_exact_odometry_needs_no_correction():
    figures = result(list(tour("none", 0.0, TUNED)))
    assert figures.error == pytest.approx(0.0, abs=1e-9)
    assert figures.rooms == 10
    assert figures.contacts == 0.0
    assert not figures.lost


def test_a_robot_steps_away_from_what_it_touches():
    pursuit = PlanPursuit(np.column_stack((np.arange(0.0, 2.0, SPACING), np.zeros(40))))
    free = pursuit.twist((0.0, 0.0, 0.0), [])
    assert free[0] > 0.5
    forward, left, turn = pursuit.twist((0.0, 0.0, 0.0), [(0.5, 0.2, 0.0)])
    assert forward < 0.0
    assert (left, turn) == pytest.approx(free[1:])


def test_doors_of_the_plan_keep_a_drifting_robot_in_its_rooms():
    """What is measured over 100 seeds, on one: ten times smaller, never in the wrong room."""
    figures = result(list(tour("doors, lidar", 2.0, TUNED)))
    assert figures.rooms == 10
    assert not figures.lost
    assert figures.error < 0.1 * figures.reckoned_error
    assert figures.worst_correction < 0.30


@pytest.mark.slow
@pytest.mark.parametrize("correction", ["doors, finder", "doors, lidar, and walls"])
@pytest.mark.parametrize("seed", range(TUNED, TUNED + 3))
def test_detected_doors_correct_the_drift(correction, seed):
    figures = result(list(tour(correction, 1.0, seed)))
    assert figures.rooms == 10
    assert not figures.lost
    assert figures.error < 0.1 * figures.reckoned_error
    assert figures.worst_correction < 0.30


def test_the_same_seed_gives_the_same_tour():
    ends = [result(list(tour("walls seen again", 1.0, TUNED))) for _ in range(2)]
    assert ends[0] == ends[1]


def test_the_study_prints_a_row_for_each_correction(capsys, tmp_path):
    rows = tmp_path / "tour.jsonl"
    options = ("--seeds", "1", "--factors", "0", "--corrections", "none", "walls seen again")
    code, out, _ = run(capsys, "tour", *options, "--out", str(rows), command=STUDIES.main)
    assert code == 0
    printed = [json.loads(line) for line in out.splitlines() if line.startswith("{")]
    assert [row["correction"] for row in printed] == ["none", "walls seen again"]
    assert all(row["all_rooms"] == 1.0 for row in printed)
    assert all(name in CORRECTIONS for name in ("none", "walls seen again"))
    kept = [json.loads(line) for line in rows.read_text().splitlines()]
    assert [len(row["tours"]) for row in kept] == [1, 1]
