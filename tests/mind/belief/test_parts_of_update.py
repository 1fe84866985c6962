"""An update in its three parts: what is sensed, the compiled call, and what its events call for."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from semnav_env.env import SemNavEnv
from semnav_env.mind.belief.understand import FIRST_SCAN, understand
from semnav_env.mind.grounding.clause_progress import CLAUSE_DONE
from tests.support import robots_side
from tests.support.robots_side import Recorded, described

COMMAND = "turn left at the intersection and go in the first door on the right"


@pytest.fixture(scope="module")
def record() -> Recorded:
    """What a robot senses that drives ahead and turns, and bumps into a wall at last."""
    env, sensed = SemNavEnv(), []
    env.reset(seed=3, options={"command": COMMAND, "pose": (-2.5, -0.3, 0.24)})
    for k in range(150):
        scan = env.simulator.step((0.8, 0.0, 0.3 if k % 40 > 30 else 0.0))
        sensed.append((scan.ranges.copy(), scan.odometry, scan.velocity, list(scan.bumps)))
    assert any(bumps for *_, bumps in sensed)
    return Recorded(COMMAND, env.robot.lidar_mount, sensed)


def in_parts(record: Recorded) -> tuple[list[str], list[int]]:
    """Beliefs and events, with thinking only where there is an event."""
    robot, believed, seen = robots_side.begun(record), [], []
    for ranges, odometry, velocity, bumps in record.sensed:
        robot.take(ranges, odometry, velocity, bumps)
        events = understand(robot.senses)
        if events:
            robot.think(events)
        believed.append(described(robot.belief))
        seen.append(events)
    return believed, seen


def test_the_parts_of_an_update_give_its_beliefs(record) -> None:
    believed, seen = in_parts(record)
    assert believed == robots_side.beliefs(record)
    assert [bool(events & FIRST_SCAN) for events in seen] == [True, *[False] * 149]
    assert seen.count(0) > 75


def test_robots_on_threads_believe_what_they_believe_alone(record) -> None:
    alone = in_parts(record)
    with ThreadPoolExecutor(4) as threads:
        assert list(threads.map(in_parts, [record] * 4)) == [alone] * 4


def test_a_completed_clause_is_an_event(record) -> None:
    robot = robots_side.begun(record._replace(command="wait for 1 second"))
    scan = record.sensed[0]
    seen = []
    for _ in range(20):
        robot.take(scan[0], scan[1], (0.0, 0.0, 0.0), seconds=0.25)
        seen.append(understand(robot.senses))
        robot.think(seen[-1])
    assert [k for k, events in enumerate(seen) if events & CLAUSE_DONE] == [5]
    assert robot.belief.clause == 1


def test_an_update_takes_numbers_of_numpy(record) -> None:
    ranges, odometry, velocity, _ = record.sensed[0]
    plain = robots_side.begun(record).update(ranges, odometry, velocity)
    told = robots_side.begun(record).update(ranges, np.array(odometry), np.array(velocity))
    assert described(told) == described(plain)
    assert told.velocity == plain.velocity
