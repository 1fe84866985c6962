"""The robot's side: the same beliefs in the simulator, on records of it, and on a log."""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from semnav_agents.base import steps
from semnav_agents.registry import make_agent
from semnav_env.env import SemNavEnv
from semnav_env.language import parse
from semnav_env.mind.belief import BeliefTracker
from semnav_env.mind.belief.log_following import follow_log
from semnav_features.readers import LogRecord
from semnav_features.scan import Scan
from semnav_scripts.main import main
from tests.support import robots_side
from tests.support.paths import ROOT
from tests.support.robots_side import Recorded, described

COMMAND = "turn left at the intersection and go in the first door on the right"


def recorded(options: dict[str, object], seed: int = 3) -> tuple[Recorded, list[str]]:
    """What a robot sensed in an episode of the scripted agent, and what it believed."""
    env = SemNavEnv(observation="all")
    sensed, believed = [], []

    def note() -> None:
        last = env.simulator.last
        sensed.append((last.ranges.copy(), last.odometry, last.velocity, list(last.bumps)))
        believed.append(described(env.belief))

    begun = env.reset(seed=seed, options=options)
    note()
    for _ in steps(env, make_agent("scripted"), *begun):
        note()
    command = str(env.judge.mission.command)
    return Recorded(command, env.robot.lidar_mount, sensed), believed


@pytest.fixture(scope="module")
def drive() -> tuple[Recorded, list[str]]:
    return recorded({"command": COMMAND, "pose": (-2.5, -0.3, 0.24)})


def test_records_of_an_episode_give_the_same_beliefs(drive) -> None:
    record, believed = drive
    assert len(believed) > 100
    assert robots_side.beliefs(record) == believed


def test_a_first_scan_in_millimetres_is_refused(drive) -> None:
    """And nothing is taken in: the same scan in metres begins as if there had been no other."""
    record, believed = drive
    ranges, odometry, velocity, bumps = record.sensed[0]
    tracker = BeliefTracker(lidar="tim561", mount=record.mount)
    tracker.begin(parse(record.command))
    with pytest.raises(ValueError, match="they look like millimetres: divide them by 1000"):
        tracker.update(1000.0 * ranges, odometry, velocity, bumps)
    assert described(tracker.update(ranges, odometry, velocity, bumps)) == believed[0]


@pytest.mark.parametrize("value", [0.0, np.inf, np.nan, 65.535, 9999.0])
def test_a_first_scan_without_any_return_is_taken(value: float) -> None:
    tracker = BeliefTracker(lidar="tim561")
    tracker.begin(parse(COMMAND))
    assert tracker.update(np.full(811, value), (0.0, 0.0, 0.0)).scene.walls == ()


def test_it_needs_nothing_of_the_simulator(drive, tmp_path: Path) -> None:
    """In a process that does nothing else; this one has loaded the simulator."""
    record, believed = drive
    (tmp_path / "record.pickle").write_bytes(pickle.dumps(record))
    command = [sys.executable, "-m", "tests.support.robots_side", str(tmp_path / "record.pickle")]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == [believed, []]
    assert {"pymunk", "semnav_env.env", "semnav_env.world"} <= {*robots_side.simulator_loaded()}


def test_bumps_are_part_of_what_is_recorded() -> None:
    env = SemNavEnv(observation="all")
    env.reset(seed=0, options={"command": "turn around", "pose": (-2.5, -0.3, 1.64)})
    bumped = [env.step([0.6, 0.0]) and env.simulator.world.touches for _ in range(45)]
    assert any(bumped)


def tracker() -> BeliefTracker:
    """Far from any wall, at the start of "turn around"."""
    fresh = BeliefTracker()
    fresh.begin(parse("turn around"))
    return fresh


def nothing() -> np.ndarray:
    return np.full(811, np.inf)


def test_an_update_and_a_belief_before_a_command_are_errors() -> None:
    with pytest.raises(RuntimeError, match=r"call begin\(command\)"):
        BeliefTracker().update(nothing(), (0.0, 0.0, 0.0))
    with pytest.raises(RuntimeError, match=r"call begin\(\)"):
        _ = BeliefTracker().belief


@pytest.mark.parametrize(
    ("ranges", "odometry", "words"),
    [
        (np.zeros(7), (0.0, 0.0, 0.0), r"shape \(7,\); tim561 gives \(811,\)"),
        (nothing(), (0.0, np.nan, 0.0), "must be three finite"),
    ],
)
def test_what_no_robot_senses_is_refused(ranges, odometry, words) -> None:
    with pytest.raises(ValueError, match=words):
        tracker().update(ranges, odometry)


@pytest.mark.parametrize(
    ("sensed", "words"),
    [
        *(({"seconds": bad}, "seconds is .*above 0") for bad in (0.0, -1.0, np.nan, np.inf)),
        ({"velocity": (np.nan, 0.0, 0.0)}, "velocity is .*three finite numbers"),
        ({"bumps": [(0.5, np.nan, 0.0)]}, "a bump is .*three finite numbers"),
    ],
)
def test_motion_that_no_robot_has_is_refused_and_changes_nothing(sensed, words) -> None:
    robot = tracker()
    believed = robot.update(nothing(), (0.0, 0.0, 0.0)).pose
    with pytest.raises(ValueError, match=words):
        robot.update(nothing(), (0.1, 0.0, 0.0), **sensed)
    assert robot.belief.pose == believed


def test_without_a_velocity_that_of_odometry_counts() -> None:
    robot = tracker()
    robot.update(nothing(), (0.0, 0.0, 0.0))
    belief = robot.update(nothing(), (0.1, 0.0, 0.2), seconds=0.1)
    assert belief.velocity == pytest.approx((1.0, 0.0, 2.0))


def test_a_belief_keeps_its_scene_when_the_robot_goes_on(drive) -> None:
    record, _ = drive
    robot, kept = robots_side.begun(record), []
    for ranges, odometry, velocity, bumps in record.sensed[:60]:
        belief = robot.update(ranges, odometry, velocity, bumps)
        kept.append((belief, [(*wall.start, *wall.end) for wall in belief.scene.walls]))
    for belief, walls in kept:
        assert [(*wall.start, *wall.end) for wall in belief.scene.walls] == walls
    assert kept[-1][1] != kept[5][1]


def test_a_log_is_followed_as_the_robot_itself_would(drive) -> None:
    record, believed = drive
    spec = BeliefTracker().lidar
    log = [
        LogRecord(
            Scan(
                np.where(np.isfinite(ranges), ranges, 0.0),
                spec.angle_min,
                spec.angle_increment,
                spec.range_min,
                spec.range_max,
                k / 15,
            ),
            None,
            odometry,
            k + 1,
        )
        for k, (ranges, odometry, _, _) in enumerate(record.sensed)
    ]
    followed = follow_log(log, parse(record.command), mount=record.mount)
    assert [described(belief) for _, belief in followed] == believed


def test_semnav_follow_says_when_its_mind_changed(drive, tmp_path: Path, capsys) -> None:
    record, _ = drive
    spec, path = BeliefTracker().lidar, tmp_path / "log.npz"
    np.savez(
        path,
        ranges=[np.where(np.isfinite(ranges), ranges, 0.0) for ranges, *_ in record.sensed],
        poses=[odometry for _, odometry, *_ in record.sensed],
        stamps=[k / 15 for k in range(len(record.sensed))],
        angle_min=spec.angle_min,
        angle_increment=spec.angle_increment,
        range_max=spec.range_max,
    )
    picture = tmp_path / "beliefs.png"
    arguments = ["follow", str(path), record.command, "--json", "--plot", str(picture)]
    assert main(arguments) == 0
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [line["clause"] for line in lines] == sorted(line["clause"] for line in lines)
    assert lines[-1]["clause"] == 3
    assert picture.stat().st_size > 10_000
    assert main(["follow", str(path), record.command, "--limit", "10"]) == 1
    assert "0 of 2 clauses" in capsys.readouterr().out
    assert main(["follow", str(path), record.command]) == 0
    said = capsys.readouterr().out
    assert "clause 2  " in said
    assert "clause 3" not in said
    assert "  all clauses done\nbelieved to be done: 2 of 2 clauses" in said


def test_a_belief_keeps_its_scene_when_its_robot_is_pickled(drive) -> None:
    record, _ = drive
    robot = robots_side.begun(record)
    for each in record.sensed[:20]:
        belief = robot.update(*each)
    before = len(belief.scene.walls)
    robot, belief = pickle.loads(pickle.dumps((robot, belief)))
    robot.begin(parse("turn around"))
    assert len(belief.scene.walls) == before > 3
