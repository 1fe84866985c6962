"""A node that says goals to a navigator, and when it wants the robot to stand."""

from dataclasses import replace

import pytest

from semnav_features.frames import relative
from semnav_ros import Phase
from semnav_ros.robot_node import NO_SCAN
from tests.ros.test_robot_node import PERIOD, STILL, TEXT, Rig
from tests.support.asked import asked_about


class GoalRig(Rig):
    """A node without an agent, and a simulated robot with a navigator."""

    def __init__(self):
        super().__init__(agent=None)
        self.navigator = self.robot.navigator

    def period(self):
        """One control period; returns what the node answers to the scan."""
        self.now += PERIOD
        scan, odometry, bumps = self.robot.sensed()
        self.node.odometry(odometry, self.now)
        self.node.bumps(bumps)
        reply = self.node.scan(scan, self.now)
        self.navigator.take(reply.goal)
        self.robot.drive(self.navigator.velocity(scan, odometry))
        return reply

    def drive(self, text=TEXT):
        """Tell a command, and drive to its goals; returns the last answer."""
        self.node.command(text, self.now)
        for _ in range(30):
            reply = self.period()
        assert reply.goal is not None
        return reply


@pytest.fixture
def rig():
    return GoalRig()


def test_a_navigator_that_knows_no_command_carries_one_out_by_its_goals(rig):
    rig.robot.tell(TEXT)
    rig.node.command(TEXT, rig.now)
    replies = [rig.period() for _ in range(300)]
    assert rig.robot.outcome["is_success"]
    assert {reply.velocity for reply in replies} == {STILL}
    assert replies[-1].status.phase is Phase.DONE
    assert replies[-1].goal is None


def test_the_goal_lies_in_the_frame_of_odometry(rig):
    goal = rig.drive().goal
    assert goal == pytest.approx(rig.node.belief.goal)
    turned = GoalRig()
    scan, odometry, _ = turned.robot.sensed()
    turned.node.command(TEXT, turned.now)
    turned.node.odometry(replace(odometry, pose=(5.0, -2.0, 1.0)), turned.now)
    there = turned.node.scan(scan, turned.now).goal
    straight = GoalRig()
    straight.node.command(TEXT, straight.now)
    straight.node.odometry(odometry, straight.now)
    here = straight.node.scan(scan, straight.now).goal
    assert relative((5.0, -2.0, 1.0), there) == pytest.approx(relative(odometry.pose, here))


def test_without_a_fresh_scan_no_goal_is_wanted(rig):
    goal = rig.drive().goal
    assert rig.node.tick(rig.now + 0.49).goal == goal
    reply = rig.node.tick(rig.now + 0.51)
    assert (reply.goal, reply.status.problem) == (None, NO_SCAN)
    assert rig.period().goal is not None  # a scan came again


def test_a_stop_a_switch_and_a_question_want_no_goal_in_the_same_call(rig):
    rig.drive()
    assert rig.node.command("stop", rig.now).goal is None
    rig.drive()
    assert rig.node.stop(True, rig.now).goal is None
    rig.node.stop(False, rig.now)
    rig.drive()
    text, _ = asked_about()
    assert rig.node.command(text, rig.now).goal is None


def test_odometry_that_jumps_wants_no_goal_until_the_next_scan(rig):
    rig.drive()
    scan, odometry, _ = rig.robot.sensed()
    assert rig.node.odometry(replace(odometry, pose=(40.0, 3.0, 1.0)), rig.now).goal is None
    assert rig.node.scan(scan, rig.now).goal is not None
