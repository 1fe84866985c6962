"""What happened on a way, told from its recording."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from semnav_env.env import SemNavEnv
from semnav_env.judge.metrics import Recorder, Recording
from semnav_env.judge.metrics.event_log import events_of, runs
from semnav_env.judge.metrics.events import (
    Arm,
    ContactBegun,
    DoorCrossed,
    JunctionEntered,
    JunctionLeft,
    Stopped,
    Turned,
)
from semnav_env.world.maps import load_floor_plan
from semnav_features.frames import FloatArray
from tests.support.driving import at_the_wall
from tests.support.episodes import START, actions

PLAN = load_floor_plan("office_cross")
PERIOD = 0.1


def walked(*points: tuple[float, float], speed: float = 1.0) -> Recording:
    """Along straight lines, facing the way it goes."""
    path = [np.array(points[0])]
    for a, b in pairwise(points):
        count = max(1, round(math.dist(a, b) / (speed * PERIOD)))
        path += [
            np.array(a) + share * np.subtract(b, a) for share in np.arange(1, count + 1) / count
        ]
    return recorded(np.array(path))


def recorded(path: FloatArray) -> Recording:
    moves = np.diff(path, axis=0)
    headings = np.arctan2(moves[:, 1], moves[:, 0])
    poses = np.column_stack((path, np.concatenate((headings[:1], headings))))
    velocities = np.zeros((len(path), 3))
    velocities[1:, 0] = np.hypot(*moves.T) / PERIOD
    velocities[1:, 2] = np.diff(np.unwrap(poses[:, 2])) / PERIOD
    return Recording(poses, velocities, np.zeros(len(path), int), np.zeros(len(path)), PERIOD)


def found(recording: Recording, kind: type) -> list:  # type: ignore[type-arg]
    return [event for event in events_of(recording, PLAN) if isinstance(event, kind)]


def test_a_door_is_crossed_from_its_corridor_and_back() -> None:
    out, back = found(walked((3.4, 9.0), (3.4, 7.0), (3.4, 9.0)), DoorCrossed)
    assert (out.door, out.from_left, out.origin) == ("west_south_1", True, "main_corridor")
    assert (back.door, back.from_left, back.into) == ("west_south_1", False, "main_corridor")
    assert (out.into, back.origin) == ("room_west_south_1",) * 2
    assert out.seconds == pytest.approx(out.step * PERIOD)
    assert 0.9 < out.seconds < 1.2


def test_passing_beside_a_door_is_no_crossing() -> None:
    assert found(walked((1.3, 9.1), (12.0, 9.1)), DoorCrossed) == []


@pytest.mark.parametrize(
    ("onward", "arm"),
    [
        ((20.0, 9.1), Arm.AHEAD),
        ((15.0, 14.0), Arm.LEFT),
        ((15.0, 4.0), Arm.RIGHT),
        ((10.0, 9.1), Arm.BACK),
    ],
)
def test_a_crossing_is_left_by_the_arm_that_one_takes(
    onward: tuple[float, float], arm: Arm
) -> None:
    recording = walked((10.0, 9.1), (15.0, 9.1), onward)
    [entered] = found(recording, JunctionEntered)
    [left] = found(recording, JunctionLeft)
    assert (entered.junction, entered.origin) == ("crossing", "main_corridor")
    assert (left.junction, left.arm) == ("crossing", arm)
    assert entered.step < left.step


def test_a_start_in_a_junction_is_left_without_being_entered() -> None:
    recording = walked((15.0, 9.1), (15.0, 14.0))
    assert found(recording, JunctionEntered) == []
    assert [event.arm for event in found(recording, JunctionLeft)] == [Arm.AHEAD]


@given(st.floats(-3.0, 3.0), st.floats(0.2, 1.4))
def test_a_turn_has_its_angle_and_small_ones_are_none(angle: float, rate: float) -> None:
    steps = math.ceil(abs(angle) / (rate * PERIOD))
    headings = np.concatenate(([0.0] * 3, np.linspace(0.0, angle, steps + 1), [angle] * 3))
    count = len(headings)
    velocities = np.zeros((count, 3))
    velocities[1:, 2] = np.diff(headings) / PERIOD
    poses = np.column_stack((np.full((count, 2), 5.0), headings))
    turns = found(
        Recording(poses, velocities, np.zeros(count, int), np.zeros(count), PERIOD), Turned
    )
    if abs(angle) < math.radians(29.9):
        assert turns == []
    elif abs(angle) > math.radians(30.1) and abs(angle) / steps > 0.1 * PERIOD * 1.01:
        [turn] = turns
        assert turn.angle == pytest.approx(angle)
        assert turn.duration == pytest.approx(steps * PERIOD)


def test_a_stop_lasts_a_second_and_is_not_at_the_start() -> None:
    """Standing still at the start is no event."""
    there = np.linspace((5.0, 9.1), (8.0, 9.1), 30)
    path = np.vstack((np.repeat(there[:1], 30, axis=0), there, np.repeat(there[-1:], 15, axis=0)))
    [stop] = found(recorded(path), Stopped)
    assert stop.duration == pytest.approx(1.5)
    assert stop.step == 60
    assert found(recorded(path[:-8]), Stopped) == []


def test_a_contact_begins_once_with_its_impulse() -> None:
    recording = replace(
        walked((5.0, 9.1), (6.0, 9.1)),
        contacts=np.array([0, 0, 2, 1, 0, 0, 1, 0, 0, 0, 0]),
        impulses=np.array([0.0, 0.0, 4.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0]),
    )
    first, second = found(recording, ContactBegun)
    assert (first.step, first.impulse, first.total) == (2, 4.0, 5.0)
    assert first.duration == pytest.approx(2 * PERIOD)
    assert (second.step, second.total) == (6, 2.0)
    assert recording.collisions == 2


def test_a_recorder_writes_down_what_the_world_does() -> None:
    world = at_the_wall()
    recorder = Recorder(world)
    for _ in range(5):
        world.step((1.0, 0.0, 0.0))
        recorder.note()
    recording = recorder.recording()
    assert recording.steps == 5
    assert tuple(recording.poses[-1]) == world.pose
    assert tuple(recording.velocities[-1]) == world.velocity
    assert recording.impulses[-1] == world.contacts.impulse > 0.0
    assert recording.collisions == 1


def test_events_doors_and_collisions_are_those_of_the_verifier() -> None:
    env = SemNavEnv(observation="raw", max_seconds=30.0)
    env.reset(seed=5, options=START)
    recorder = Recorder(env.world)
    for action in actions(450, 2, seed=3):
        env.step(action)
        recorder.note()
    recording, judge = recorder.recording(), env.judge
    events = events_of(recording, env.floor_plan)
    assert [e.door for e in events if isinstance(e, DoorCrossed)] == judge.crossed
    assert recording.collisions == judge.period.collisions > 0
    assert len([e for e in events if isinstance(e, ContactBegun)]) == judge.period.collisions
    assert [e.step for e in events] == sorted(e.step for e in events)


@given(st.lists(st.booleans(), max_size=30))
def test_runs_are_the_true_stretches(mask: list[bool]) -> None:
    covered = [
        row for start, stop in runs(np.array(mask, dtype=bool)) for row in range(start, stop)
    ]
    assert covered == [row for row, true in enumerate(mask) if true]
