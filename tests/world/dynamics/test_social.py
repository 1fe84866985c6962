"""Personal space and time to collision, against hand-worked and brute-force cases."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import Point, box
from shapely.affinity import rotate, translate

from semnav_env.world.dynamics.social import (
    PERSONAL_SPACE,
    SocialRecord,
    gaps,
    times_to_collision,
)

STILL = np.array([0.0, 0.0, 0.0, 0.5, 0.3, 0.0, 0.0, 0.0])
coordinate, speed = st.floats(-4.0, 4.0), st.floats(-2.0, 2.0)


def one_gap(x: float, y: float, body: np.ndarray = STILL) -> float:
    return float(gaps(body, np.array([[x, y, 0.25]]))[0])


def one_time(x: float, y: float, u: float, v: float, body: np.ndarray = STILL) -> float:
    discs, velocities = np.array([[x, y, 0.25]]), np.array([[u, v]])
    return float(times_to_collision(body, discs, velocities)[0])


def test_gaps_worked_by_hand() -> None:
    assert one_gap(1.5, 0.0) == pytest.approx(0.75)
    assert one_gap(0.0, -1.0) == pytest.approx(0.45)
    assert one_gap(0.8, 0.7) == pytest.approx(0.25)
    assert one_gap(0.6, 0.1) == 0.0


def test_times_worked_by_hand() -> None:
    assert one_time(2.75, 0.0, -1.0, 0.0) == pytest.approx(2.0)
    assert one_time(2.75, 0.0, 1.0, 0.0) == math.inf
    assert one_time(2.75, 2.0, -1.0, 0.0) == math.inf
    assert one_time(0.6, 0.0, 1.0, 0.0) == 0.0
    moving = np.array([0.0, 0.0, 0.0, 0.5, 0.3, 1.0, 0.0, 0.0])
    assert one_time(2.75, 0.0, 0.0, 0.0, moving) == pytest.approx(2.0)
    assert one_time(2.75, 0.0, 1.0, 0.0, moving) == math.inf


@given(coordinate, coordinate, speed, speed, st.floats(-3.1, 3.1), speed, speed)
@settings(max_examples=100, deadline=None)
def test_bodies_touch_first_at_the_time_to_collision(
    x: float, y: float, u: float, v: float, heading: float, forward: float, left: float
) -> None:
    body = np.array([0.3, -0.2, heading, 0.55, 0.325, forward, left, 0.7])
    found = one_time(x, y, u, v, body)
    outline = translate(rotate(box(-0.55, -0.325, 0.55, 0.325), heading, (0, 0), True), 0.3, -0.2)

    def apart(seconds: float) -> float:
        person = Point(x + seconds * (u - forward), y + seconds * (v - left))
        return float(outline.distance(person)) - 0.25

    assert one_gap(x, y, body) == pytest.approx(max(apart(0.0), 0.0), abs=1e-9)
    if found == math.inf:
        assert min(apart(t) for t in np.linspace(0.0, 20.0, 400)) > -1e-9
    else:
        assert apart(found) <= 1e-6
        earlier = np.linspace(0.0, found, 50)[:-1] if found > 0.0 else []
        assert all(apart(t) > -1e-6 for t in earlier)


def test_an_intrusion_is_counted_once_while_it_lasts() -> None:
    record = SocialRecord()
    record.begin()
    for gap in (1.0, 0.4, 0.3, 0.6, 0.2):
        record.note(STILL, np.array([[0.75 + gap, 0.0, 0.25]]), np.zeros((1, 2)), 0.5)
    assert record.outcome() == {
        "personal_space_intrusions": 2,
        "personal_space_seconds": pytest.approx(1.5),
        "least_gap_to_people": pytest.approx(0.2),
        "least_time_to_collision": math.inf,
    }
    assert PERSONAL_SPACE == 0.45


def test_without_people_nothing_is_near() -> None:
    record = SocialRecord()
    record.begin()
    record.note(STILL, np.zeros((0, 3)), np.zeros((0, 2)), 0.5)
    assert record.intrusions == 0
    assert record.least_gap == math.inf
