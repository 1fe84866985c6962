"""The study of ways of finding somebody: its houses, and how it counts."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from studies.__main__ import STUDIES
from studies.finding.command import summary
from studies.finding.houses import APART, TURNING_ROOM, House
from studies.finding.ways import WAYS, WayResult, compared

HOUSE = House.of(20_001)


def test_a_robot_can_turn_at_every_place_and_they_are_apart() -> None:
    for room in HOUSE.plan.rooms:
        places = HOUSE.places(room.polygon, 4)
        for k, place in enumerate(places):
            middle, needed = shapely.Point(place), 0.99 * TURNING_ROOM
            assert not len(HOUSE.plan.solids.query(middle, "dwithin", needed))
            assert all(math.dist(place, other) >= APART for other in places[:k])


def test_a_tour_visits_each_place_once() -> None:
    places = [p for room in HOUSE.plan.rooms for p in HOUSE.places(room.polygon, 2)]
    assert sorted(HOUSE.tour(places)) == sorted(places)


def test_a_report_counts_for_the_person_who_is_nearest() -> None:
    (x, y), (other_x, other_y) = HOUSE.people
    found = compared(HOUSE, [(x + 0.1, y), (x + 0.3, y), (other_x, other_y + 3.0)], 60.0, 0.5)
    assert found.errors == pytest.approx((0.1, 3.0))
    assert found.false_reports == 1
    assert compared(HOUSE, [], 60.0, 0.0).errors == (math.inf, math.inf)


@pytest.mark.parametrize("name", WAYS)
def test_the_same_draws_find_the_same(name: str) -> None:
    once, again = (WAYS[name](HOUSE, np.random.default_rng(0)) for _ in range(2))
    assert once == again
    assert once.seconds > 0.0


def test_people_without_a_report_are_not_found() -> None:
    row = summary([WayResult((0.2, math.inf), 0, 10.0, 0.5), WayResult((0.4, 2.0), 1, 30.0, 0.7)])
    assert row["people found within 1 m"] == "2 of 4"
    assert row["error of the place, m: median"] == "0.40"
    assert row["time, s: median"] == "20"


def test_no_houses_are_refused_in_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert STUDIES.main(["finding", "--houses", "0"]) == 2
    assert "houses is 0; it must be 1 or more" in capsys.readouterr().err
