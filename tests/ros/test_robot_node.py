"""The core of a robot's node: what it does when messages are late, lost, doubled or wrong."""

from dataclasses import replace

import numpy as np
import pytest

from semnav_features.frames import compose
from semnav_ros import OdometryMessage, Phase, RobotNode, ScanMessage, TransformMessage
from semnav_ros.robot_node import NO_MOTION, NO_SCAN
from semnav_ros.simulated_robot import SimulatedRobot
from tests.support.asked import asked_about

TEXT = "go through the second door on the right"
STILL = (0.0, 0.0, 0.0)
PERIOD = 1.0 / 15.0


class Rig:
    """A node with a simulated robot, and the node's clock."""

    def __init__(self, **options):
        self.robot = SimulatedRobot("heidelberg_hallway", pose=(1.0, 0.3, 0.24))
        self.node = RobotNode("wheelchair", **({"mount": self.robot.mount} | options))
        self.now = 5.0

    def period(self):
        """One control period; returns what the node answers to the scan."""
        self.now += PERIOD
        scan, odometry, bumps = self.robot.sensed()
        self.node.odometry(odometry, self.now)
        self.node.bumps(bumps)
        reply = self.node.scan(scan, self.now)
        self.robot.drive(reply.velocity)
        return reply

    def drive(self, text=TEXT):
        """Tell a command, and drive until the robot moves; returns the last answer."""
        self.node.command(text, self.now)
        for _ in range(30):
            reply = self.period()
        assert reply.velocity[0] > 0.2
        return reply


@pytest.fixture
def rig():
    return Rig()


def test_a_command_is_carried_out_and_judged_done(rig):
    rig.robot.tell(TEXT)
    rig.node.command(TEXT, rig.now)
    phases = {rig.period().status.phase for _ in range(250)}
    assert rig.robot.outcome["is_success"]
    assert phases == {Phase.RUNNING, Phase.DONE}
    assert rig.period().velocity == STILL


def test_nothing_moves_before_a_command(rig):
    replies = [rig.period() for _ in range(5)]
    assert {reply.velocity for reply in replies} == {STILL}
    assert not any(reply.drives for reply in replies)
    assert replies[-1].status.phase is Phase.IDLE


def test_nothing_moves_without_a_scan(rig):
    reply = rig.node.command(TEXT, rig.now)
    assert reply.velocity == STILL
    assert reply.status.problem == NO_SCAN


def test_without_a_fresh_scan_the_robot_stands_and_says_so(rig):
    driving = rig.drive().velocity
    assert rig.node.tick(rig.now + 0.49).velocity == driving
    reply = rig.node.tick(rig.now + 0.51)
    assert (reply.velocity, reply.status.problem) == (STILL, NO_SCAN)
    assert reply.drives


def test_it_drives_on_when_scans_come_again(rig):
    rig.drive()
    rig.now += 2.0
    assert rig.node.tick(rig.now).velocity == STILL
    assert [rig.period() for _ in range(15)][-1].velocity[0] > 0.2


def test_a_lost_scan_is_counted_and_the_robot_drives_on(rig):
    rig.drive()
    rig.robot.drive((0.5, 0.0, 0.0))
    reply = rig.period()
    assert reply.velocity[0] > 0.2
    assert reply.status.counts.lost == 1


def test_a_doubled_scan_changes_nothing(rig):
    before = rig.drive()
    scan, odometry, _ = rig.robot.sensed()
    rig.node.odometry(odometry, rig.now)
    first = rig.node.scan(scan, rig.now)
    again = rig.node.scan(scan, rig.now)
    assert again.velocity == first.velocity
    assert again.status.counts.doubled == before.status.counts.doubled + 1
    assert rig.node.scan(scan, rig.now + 0.6).velocity == STILL  # it is not fresh either


def test_a_late_scan_is_left_out(rig):
    reply = rig.drive()
    scan, _, _ = rig.robot.sensed()
    late = rig.node.scan(replace(scan, stamp=scan.stamp - 0.3), rig.now)
    assert late.velocity == reply.velocity
    assert late.status.counts.late == 1


def test_a_clock_that_goes_back_stops_the_robot_for_one_scan(rig):
    rig.drive()
    scan, odometry, _ = rig.robot.sensed()
    rig.node.odometry(replace(odometry, stamp=3.0), rig.now)
    reply = rig.node.scan(replace(scan, stamp=3.0), rig.now)
    assert reply.velocity == STILL
    assert "clock" in reply.status.problem
    rig.node.odometry(replace(odometry, stamp=3.0 + PERIOD), rig.now)
    after = rig.node.scan(replace(scan, stamp=3.0 + PERIOD), rig.now)
    assert after.velocity[0] > 0.2
    assert after.status.counts.clock_jumps == 1


@pytest.mark.parametrize("change", ["beams", "start", "step"])
def test_a_scan_of_another_lidar_is_refused_with_one_clear_error(rig, change):
    rig.drive()
    scan, _, _ = rig.robot.sensed()
    other = {
        "beams": replace(scan, ranges=scan.ranges[::3], angle_increment=3 * scan.angle_increment),
        "start": replace(scan, angle_min=scan.angle_min + 0.1),
        "step": replace(scan, angle_increment=0.99 * scan.angle_increment),
    }[change]
    reply = rig.node.scan(other, rig.now)
    assert reply.velocity == STILL
    assert reply.status.problem.startswith("a scan of another lidar: ")
    assert rig.node.tick(rig.now + 1.0).status.problem == reply.status.problem
    assert rig.period().velocity[0] > 0.2  # its own lidar drives on


@pytest.mark.parametrize(
    ("field", "value", "why"),
    [("stamp", np.nan, "not finite"), ("angle_increment", 0.0, "angles"), ("ranges", [], "beams")],
)
def test_what_makes_no_scan_stops_the_robot(rig, field, value, why):
    rig.drive()
    scan, _, _ = rig.robot.sensed()
    reply = rig.node.scan(replace(scan, **{field: value}), rig.now)
    assert reply.velocity == STILL
    assert why in reply.status.problem


def test_odometry_that_jumps_stops_the_robot_and_leaves_it_where_it_stood(rig):
    rig.drive()
    before = rig.node.belief
    scan, odometry, _ = rig.robot.sensed()
    jumped = replace(odometry, pose=(40.0, -7.0, 2.0))
    reply = rig.node.odometry(jumped, rig.now)
    assert reply.velocity == STILL
    assert "jumped" in reply.status.problem
    after = rig.node.scan(scan, rig.now)
    assert after.velocity[0] > 0.2
    assert after.status.counts.odometry_jumps == 1
    belief = rig.node.belief
    assert belief.pose == pytest.approx(jumped.pose)  # shown in the frame that odometry has now
    assert len(belief.doors) == len(before.doors)


def test_odometry_that_is_not_finite_stops_the_robot(rig):
    rig.drive()
    reply = rig.node.odometry(OdometryMessage(200.0, (np.nan, 0.0, 0.0)), rig.now)
    assert reply.velocity == STILL
    assert "not finite" in reply.status.problem


def test_a_robot_that_does_not_move_is_reported_and_told_on(rig):
    rig.drive()
    scan, odometry, _ = rig.robot.sensed()
    replies = []
    for step in range(1, 70):  # its motors are off
        stamp = scan.stamp + step * PERIOD
        rig.node.odometry(replace(odometry, stamp=stamp), rig.now)
        replies.append(rig.node.scan(replace(scan, stamp=stamp), rig.now))
    assert replies[30].status.problem == ""
    assert NO_MOTION in {reply.status.problem for reply in replies[45:]}


def test_a_bump_that_is_not_finite_stops_the_robot_and_not_the_node(rig):
    rig.drive()
    rig.node.bumps([(np.nan, 0.0, 0.0)])
    scan, odometry, _ = rig.robot.sensed()
    rig.node.odometry(odometry, rig.now)
    reply = rig.node.scan(scan, rig.now)
    assert reply.velocity == STILL
    assert "bump" in reply.status.problem
    rig.robot.drive(STILL)
    assert rig.period().velocity != STILL


def test_without_odometry_the_robot_stands(rig):
    rig.node.command(TEXT, rig.now)
    scan, _, _ = rig.robot.sensed()
    reply = rig.node.scan(scan, rig.now)
    assert reply.velocity == STILL
    assert "odometry" in reply.status.problem


@pytest.mark.parametrize("text", ["stop", "Halt!", "stop it"])
def test_a_call_to_stop_acts_in_the_same_call(rig, text):
    rig.drive()
    reply = rig.node.command(text, rig.now)
    assert (reply.velocity, reply.status.phase) == (STILL, Phase.STOPPED)
    assert rig.period().velocity == STILL


def test_the_stop_switch_holds_until_it_is_released_and_a_new_command_comes(rig):
    rig.drive()
    assert rig.node.stop(True, rig.now).velocity == STILL
    assert rig.node.command(TEXT, rig.now).status.phase is Phase.HELD
    assert rig.period().velocity == STILL
    assert rig.node.stop(False, rig.now).status.phase is Phase.STOPPED
    assert rig.period().velocity == STILL
    rig.drive()


def test_a_command_replaces_the_one_that_runs(rig):
    rig.drive()
    reply = rig.node.command("go down the hallway", rig.now)
    assert reply.velocity == STILL  # until the next scan
    assert len(reply.status.clauses) == 1
    assert "hallway" in reply.status.clauses[0]
    assert rig.period().velocity != STILL


def test_a_question_waits_without_moving_and_its_answer_drives(rig):
    rig.drive()
    text, question = asked_about()
    reply = rig.node.command(text, rig.now)
    assert reply.status.phase is Phase.ASKING
    assert reply.said.endswith("?")
    assert {rig.period().velocity for _ in range(5)} == {STILL}
    answered = rig.node.command(question.choices[0].name, rig.now)
    assert (answered.status.phase, answered.said) == (Phase.RUNNING, "")


def test_what_is_not_understood_is_refused_and_the_robot_stands(rig):
    rig.drive()
    reply = rig.node.command("colourless green ideas sleep", rig.now)
    assert reply.status.phase is Phase.REFUSED
    assert reply.said
    assert rig.period().velocity == STILL


def test_the_place_of_the_lidar_comes_from_the_transforms():
    rig = Rig(mount=None)
    rig.node.command(TEXT, rig.now)
    assert "no transform" in rig.period().status.problem
    x, y, _ = rig.robot.mount
    rig.node.transform(TransformMessage("base_link", "mast", (x - 0.1, y)))
    rig.node.transform(TransformMessage("/mast", "laser", (0.1, 0.0)))
    assert [rig.period() for _ in range(30)][-1].velocity[0] > 0.2


def test_a_tilted_lidar_is_refused():
    rig = Rig(mount=None)
    rig.node.command(TEXT, rig.now)
    rig.node.transform(TransformMessage("base_link", "laser", (0.4, 0.0), (1.0, 0.0, 0.0, 0.0)))
    assert "tilted" in rig.period().status.problem


def test_a_base_frame_at_the_axle_gives_the_same_belief():
    by_centre, by_axle = Rig(), Rig(mount=(0.65, 0.0, 0.0), base=-0.2)
    odometry = OdometryMessage(1.0, (1.0, 2.0, 0.5))
    at_axle = replace(odometry, pose=compose(odometry.pose, (-0.2, 0.0, 0.0)))
    for rig, message in ((by_centre, odometry), (by_axle, at_axle)):
        rig.node.command(TEXT, rig.now)
        scan, _, _ = rig.robot.sensed()
        rig.node.odometry(message, rig.now)
        rig.node.scan(replace(scan, stamp=1.0), rig.now)
    assert by_axle.node.belief.pose == pytest.approx(at_axle.pose)
    assert np.allclose(by_axle.node.belief.walls, by_centre.node.belief.walls)


def test_the_belief_is_shown_in_the_frame_of_odometry(rig):
    rig.drive()
    belief = rig.node.belief
    _, odometry, _ = rig.robot.sensed()
    assert belief.pose[:2] == pytest.approx(odometry.pose[:2], abs=0.2)
    assert len(belief.confidence) == len(belief.doors) > 0


@pytest.mark.parametrize(
    ("options", "why"),
    [
        ({"agent": "oracle"}, "floor plan"),
        ({"agent": "nobody"}, "no agent"),
        ({"mount": (3.0, 0.0, 0.0)}, "lidar_mount"),
        ({"robot": "bicycle"}, "robot"),
    ],
)
def test_a_node_that_cannot_be_is_refused(options, why):
    with pytest.raises(ValueError, match=why):
        RobotNode(**options)


def test_a_lidar_that_turns_clockwise_drives_the_same(rig):
    mirrored = Rig()
    for each, turned in ((rig, False), (mirrored, True)):
        each.node.command(TEXT, each.now)
        scan, odometry, _ = each.robot.sensed()
        if turned:
            last = scan.angle_min + scan.angle_increment * (len(scan.ranges) - 1)
            scan = ScanMessage(scan.stamp, scan.ranges[::-1], last, -scan.angle_increment)
        each.node.odometry(odometry, each.now)
        each.reply = each.node.scan(scan, each.now)
    assert np.allclose(mirrored.node.belief.walls, rig.node.belief.walls, atol=1e-6)
