"""A node on a wire: what goes out first, and what goes out when scans end."""

import gc

import pytest

from semnav_ros import RobotNode, conversions, node_shell
from semnav_ros.garbage import garbage_when_idle
from semnav_ros.node_shell import NodeShell
from semnav_ros.simulated_robot import SimulatedRobot
from semnav_ros.topics import NodeTopics
from tests.ros.navigators import LoopWire, NotedNavigator
from tests.ros.test_robot_node import PERIOD, TEXT

TOPICS = NodeTopics()
ZERO = conversions.twist_values((0.0, 0.0, 0.0))


class Rig:
    """A shell with a simulated robot on its wire, and both clocks."""

    def __init__(self, monkeypatch, navigator=None):
        self.robot = SimulatedRobot("heidelberg_hallway", pose=(1.0, 0.3, 0.24))
        agent = "scripted" if navigator is None else None
        node = RobotNode("wheelchair", agent, mount=self.robot.mount)
        self.wire, self.navigator, self.now = LoopWire(), navigator, 5.0
        self.shell = NodeShell(node, self.wire, TOPICS, navigator=navigator)
        monkeypatch.setattr(node_shell, "_now", lambda: self.now)

    def rounds(self, count, senses=True):
        """Run the shell for control periods; returns what it said."""
        left = iter(range(count))

        def goes_on():
            if next(left, None) is None:
                return False
            self.now += PERIOD
            if senses:
                self.sense()
            return True

        self.wire.said.clear()
        self.shell.run(goes_on)
        return [name for name, _ in self.wire.said if name != "odom" and name != "scan"]

    def sense(self):
        """Say what the robot senses, and let it drive as it is told."""
        scan, odometry, _ = self.robot.sensed()
        self.wire.say(TOPICS.odom, conversions.odometry_values(odometry, "base_link"))
        self.wire.say(TOPICS.scan, conversions.scan_values(scan))
        told = [v for name, v in self.wire.said if name == "cmd_vel"]
        self.robot.drive(conversions.twist_of(told[-1]) if told else (0.0, 0.0, 0.0))

    def command(self, text):
        """Tell a command."""
        self.wire.say(TOPICS.command, {"text": text})


def test_the_velocity_is_the_first_that_is_said_after_a_scan(monkeypatch):
    rig = Rig(monkeypatch)
    rig.command(TEXT)
    said = rig.rounds(1)
    assert said[0] == "cmd_vel"
    assert said.index("semnav/markers") > said.index("semnav/status") > 0


def test_the_belief_is_shown_only_after_a_scan_was_answered(monkeypatch):
    """Another scan is then far off, so that it need not wait for the pictures."""
    rig = Rig(monkeypatch)
    rig.command(TEXT)
    rig.rounds(5)
    assert "semnav/markers" not in rig.rounds(30, senses=False)
    assert "semnav/markers" in rig.rounds(2)


def test_a_navigator_gets_the_goal_and_the_node_says_no_velocity(monkeypatch):
    rig = Rig(monkeypatch, NotedNavigator())
    rig.command(TEXT)
    said = rig.rounds(1)
    assert len(rig.navigator.goals) == 1
    assert said.count("cmd_vel") == 1  # the last word, that the robot stands
    assert rig.navigator.cancels == 1


@pytest.mark.parametrize("event", ["stop", "switch", "nonsense"])
def test_a_goal_is_called_back_in_the_same_call_and_zero_is_said(monkeypatch, event):
    rig = Rig(monkeypatch, NotedNavigator())
    rig.command(TEXT)
    rig.sense()
    assert (len(rig.navigator.goals), rig.navigator.cancels) == (1, 0)
    rig.wire.said.clear()
    if event == "switch":
        rig.wire.say(TOPICS.stop, {"value": True})
    else:
        rig.command("stop" if event == "stop" else "colourless green ideas sleep")
    assert rig.navigator.cancels == 1
    assert [velocity for name, velocity in rig.wire.said if name == "cmd_vel"] == [ZERO]


def test_a_goal_is_called_back_half_a_second_after_the_last_scan(monkeypatch):
    rig = Rig(monkeypatch, NotedNavigator())
    rig.command(TEXT)
    rig.sense()
    before, cancels = rig.now, []

    def goes_on():
        cancels.append(rig.navigator.cancels)
        rig.now += 0.05
        return rig.now < before + 0.99

    rig.shell.run(goes_on)
    assert cancels[:10] == [0] * 10
    assert cancels[12:] == [1] * len(cancels[12:])
    assert ("cmd_vel", ZERO) in rig.wire.said


def test_no_garbage_is_collected_but_in_idle_moments():
    assert gc.isenabled()
    with garbage_when_idle() as collect:
        assert not gc.isenabled()
        collect()
    assert gc.isenabled()
    assert gc.get_freeze_count() == 0
