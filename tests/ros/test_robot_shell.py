"""The simulated robot on a wire whose node answers late, or never; both by a clock of the test."""

import itertools
import json
from types import SimpleNamespace

import pytest

from semnav_env.language import CommandError
from semnav_ros import conversions, robot_shell
from semnav_ros.messages import Phase
from semnav_ros.robot_shell import PATIENCE, RobotShell
from semnav_ros.simulated_robot import SimulatedRobot
from semnav_ros.topics import NodeTopics
from semnav_scripts import simulate
from tests.ros.navigators import LoopWire

TOPICS = NodeTopics()
AHEAD = conversions.twist_values((0.3, 0.0, 0.0))
SPEED = 2.0


class LateNode(LoopWire):
    """A wire with a node that answers each scan after some time, or never again."""

    def __init__(self, delay, answers=10**9):
        super().__init__()
        self.now, self.delay, self.left = 100.0, delay, answers
        self.due = None

    def listeners(self, topic):
        return 2

    def wait(self, seconds):
        if self.due is None or self.due > self.now + seconds:
            self.now += seconds
            return
        self.now, self.due, self.left = self.due, None, self.left - 1
        self.say(TOPICS.cmd_vel, AHEAD)

    def say(self, topic, values):
        super().say(topic, values)
        if topic == TOPICS.scan and self.due is None and self.left > 0:
            self.due = self.now + self.delay


@pytest.fixture
def run(monkeypatch):
    """Runs a robot until some scans are said; returns the names of the topics that were said."""

    def begin(wire, lockstep, scans):
        monkeypatch.setattr(robot_shell, "time", SimpleNamespace(monotonic=lambda: wire.now))
        robot = SimulatedRobot("heidelberg_hallway", pose=(1.0, 0.3, 0.24))
        left = iter(range(scans))
        RobotShell(robot, wire, TOPICS, SPEED, lockstep).run(
            lambda: next(left, None) is not None, "go down the hallway"
        )
        return [name for name, _ in wire.said if name in (TOPICS.scan.name, TOPICS.cmd_vel.name)]

    return begin


@pytest.mark.parametrize("delay", [0.001, 0.3, 5.0])
def test_in_lockstep_each_scan_is_answered_before_the_next(run, delay):
    """But the first, after which the command is told."""
    said = run(LateNode(delay), True, 20)[1:]
    assert said.count("scan") == 19
    assert ("scan", "scan") not in itertools.pairwise(said)
    assert said[-1] == "cmd_vel"


def test_without_lockstep_a_robot_waits_for_nobody(run):
    said = run(LateNode(0.3), False, 20)
    assert said.count("cmd_vel") < 7


def test_in_lockstep_time_does_not_pass_faster_than_told(run):
    wire = LateNode(0.0)
    run(wire, True, 30)
    assert wire.now - 100.0 == pytest.approx(30 / 15.0 / SPEED, abs=0.05)


def test_a_node_that_falls_silent_is_waited_for_once(run):
    wire = LateNode(0.01, answers=10)
    run(wire, True, 40)
    assert PATIENCE < wire.now - 100.0 < PATIENCE + 3.0


def test_lockstep_is_refused_where_no_velocities_are_said():
    with pytest.raises(ValueError, match="with --navigator leave it out"):
        simulate.Arguments(lockstep=True, navigator="topic").run()


def noted(*said):
    """What a robot notes of commands and of what its node says."""
    wire, notes = LoopWire(), []
    robot = SimulatedRobot("heidelberg_hallway", pose=(1.0, 0.3, 0.24))
    RobotShell(robot, wire, TOPICS, notes=notes.append)
    for topic, text in said:
        wire.say(topic, {"text": text})
    return notes


def test_a_command_that_begins_no_episode_is_noted():
    assert noted((TOPICS.command, "go down the hallway")) == []
    (note,) = noted((TOPICS.command, "sing a song"))
    assert "sing" in note


def test_a_robot_notes_once_that_its_node_finds_a_clause_impossible():
    running = json.dumps({"phase": Phase.RUNNING, "reasons": []})
    impossible = json.dumps({"phase": Phase.IMPOSSIBLE, "reasons": ["no door on the left"]})
    states = [(TOPICS.status, text) for text in (running, impossible, impossible, running)]
    assert noted(*states) == ["impossible: no door on the left"]


def test_a_command_that_is_none_is_refused_before_a_node_listens(monkeypatch):
    wire = LoopWire()
    wire.close = lambda: None
    monkeypatch.setattr(simulate, "open_wire", lambda *_: wire)
    with pytest.raises(CommandError, match="sing"):
        simulate.Arguments("sing a song").run()
    assert wire.said == []
