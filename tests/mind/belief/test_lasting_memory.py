"""A robot that keeps what it saw in a building when it gets another command there."""

from __future__ import annotations

import math
import pickle
from collections.abc import Iterator

import numpy as np
import pytest

from semnav_env.language import parse
from semnav_env.mind.belief import BeliefTracker
from tests.mind.belief.test_belief import recorded
from tests.support.robots_side import Recorded, described

FIRST = "turn left at the intersection and go in the first door on the right"
SECOND = parse("go to the first door on the left")


@pytest.fixture(scope="module")
def record() -> Recorded:
    return recorded({"command": FIRST, "pose": (-2.5, -0.3, 0.24)})[0]


def driven(record: Recorded) -> BeliefTracker:
    """A tracker after the first command."""
    tracker = BeliefTracker("tim561", record.mount)
    tracker.begin(parse(record.command))
    for sensed in record.sensed:
        tracker.update(*sensed)
    return tracker


def blind(record: Recorded) -> tuple[object, ...]:
    """A scan that shows nothing, where the robot stands at the end."""
    ranges, odometry, _, _ = record.sensed[-1]
    return np.zeros_like(ranges), odometry, (0.0, 0.0, 0.0)


def test_after_two_commands_it_knows_the_doors_that_it_saw_in_the_first(record) -> None:
    tracker = driven(record)
    before = tracker.belief
    doors = before.scene.doors
    assert len(doors) > 1
    tracker.begin(SECOND, keep=True)
    after = tracker.update(*blind(record))
    assert after.scene.doors == doors
    assert after.scene.walls == before.scene.walls
    tracker.begin(SECOND)
    assert tracker.update(*blind(record)).scene.doors == ()


def test_the_frame_stays_and_the_command_begins_where_the_robot_stands(record) -> None:
    tracker = driven(record)
    before = tracker.belief.pose
    tracker.begin(SECOND, keep=True)
    after = tracker.update(*record.sensed[-1])
    assert math.dist(after.pose[:2], before[:2]) < 0.05
    assert tracker.follower.begin == after.pose
    assert after.clause == 0


def test_a_new_memory_is_the_same_kept_or_not(record) -> None:
    def beliefs(keep: bool) -> Iterator[str]:
        tracker = BeliefTracker("tim561", record.mount)
        tracker.begin(parse(record.command), keep=keep)
        for sensed in record.sensed[:20]:
            yield described(tracker.update(*sensed))

    assert list(beliefs(True)) == list(beliefs(False))


def test_a_pickled_robot_keeps_the_same(record) -> None:
    tracker = driven(record)
    twin = pickle.loads(pickle.dumps(tracker))
    for each in (tracker, twin):
        each.begin(SECOND, keep=True)
    for sensed in record.sensed[-10:]:
        assert described(tracker.update(*sensed)) == described(twin.update(*sensed))
    assert tracker.belief.scene.doors == twin.belief.scene.doors


def test_what_is_not_kept_leaves_no_trace(record) -> None:
    """A tracker that has driven behaves like a new one."""
    used, new = driven(record), BeliefTracker("tim561", record.mount)
    for tracker in (used, new):
        tracker.begin(SECOND)
    for sensed in record.sensed[:20]:
        assert described(used.update(*sensed)) == described(new.update(*sensed))
