"""The node and a simulated robot in two processes, over real DDS and a real ROS 1 master."""

import importlib.util
import json
import os
import socket
import struct
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from semnav_env import load_floor_plan
from semnav_features.frames import points_to_parent
from semnav_ros.fields import read, written
from semnav_ros.opening import MISSING
from semnav_ros.simulated_robot import SimulatedRobot
from semnav_scripts.node import LAUNCH_FILES
from tests.support.paths import ROOT, ROOTS

TEXT = "go through the second door on the right"
PLACE = ("--pose=1.0,0.3,0.24", "--seconds", "840")
LOOPBACK = (
    "<CycloneDDS><Domain><General><AllowMulticast>false</AllowMulticast><Interfaces>"
    '<NetworkInterface name="lo" multicast="false"/></Interfaces></General><Discovery>'
    "<ParticipantIndex>auto</ParticipantIndex><Peers><Peer address='127.0.0.1'/></Peers>"
    "</Discovery></Domain></CycloneDDS>"
)
MASTER = Path("/usr/bin/rosmaster")
DEBIAN = Path("/usr/lib/python3/dist-packages")
WORKER = int(os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw"))
PORT, DOMAIN = 11371 + WORKER, 93 + WORKER
"""Of this process of the tests: several may run at a time."""

PATIENCE = 900
"""Time after which a process counts as hung, seconds; a loaded machine took more than 150."""

needs_dds = pytest.mark.skipif(
    importlib.util.find_spec("cyclonedds") is None,
    reason='cyclonedds is not installed: pip install ".[dds]"',
)
needs_ros1 = pytest.mark.skipif(
    not (MASTER.exists() and all((DEBIAN / name).exists() for name in ("rospy", "move_base_msgs"))),
    reason=MISSING["ros1"],
)
ROSLAUNCH, ROSBAG = Path("/usr/bin/roslaunch"), Path("/usr/bin/rosbag")
needs_roslaunch = pytest.mark.skipif(
    not ROSLAUNCH.exists(), reason="roslaunch is missing: apt-get install python3-roslaunch"
)
needs_rosbag = pytest.mark.skipif(
    not ROSBAG.exists() or importlib.util.find_spec("rosbags") is None,
    reason='rosbag is missing: apt-get install python3-rosbag, and pip install ".[ros]"',
)
RCLPY = ROOT / "build" / "ros2" / "bin" / "python"
needs_rclpy = pytest.mark.skipif(
    not RCLPY.exists(), reason="rclpy is not in build/ros2, where `make ros` puts it"
)
pytestmark = pytest.mark.slow
SEMNAV = (sys.executable, "-m", "semnav_scripts.main")


def environment(tmp_path, **more):
    roots = [str(folder) for folder in dict.fromkeys((ROOT, *ROOTS.values()))]
    path = os.pathsep.join([*roots, os.environ.get("PYTHONPATH", "")])
    ros1 = {"ROS_MASTER_URI": f"http://127.0.0.1:{PORT}", "ROS_IP": "127.0.0.1"}
    dds = {"ROS_DOMAIN_ID": str(DOMAIN), "CYCLONEDDS_URI": LOOPBACK}
    dds |= {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}  # of rclpy
    paths = {"ROS_LOG_DIR": str(tmp_path), "ROS_PACKAGE_PATH": str(LAUNCH_FILES)}
    python = os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")])
    return {**os.environ, **ros1, **dds, **paths, "PYTHONPATH": path, "PATH": python, **more}


@pytest.fixture
def start(tmp_path):
    """Starts a sub-command of `semnav` or another program; ends it after the test."""
    running = []

    def begin(*words, program=SEMNAV, **more):
        process = subprocess.Popen(
            [*program, *words],
            env=environment(tmp_path, **more),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        running.append(process)
        return process

    yield begin
    for process in running:
        process.kill()
        process.wait()
        process.stdout.close()


@pytest.fixture
def start_master(start):
    """Starts a ROS 1 master, by Debian's Python and not by this environment's."""

    def begin():
        process = start("--core", "-p", str(PORT), program=("/usr/bin/python3", str(MASTER)))
        for _ in range(100):
            with socket.socket() as door:
                if door.connect_ex(("127.0.0.1", PORT)) == 0:
                    return process
            time.sleep(0.1)
        raise AssertionError(process.stdout.read())

    return begin


@pytest.fixture
def master(start_master):
    return start_master()


def outcome_of(process):
    """What a simulated robot prints in the end."""
    said, _ = process.communicate(timeout=PATIENCE)
    lines = said.splitlines()
    assert lines[-1].startswith("{"), said
    return json.loads(lines[-1])


def lines_of(process):
    """What a node printed until it was ended."""
    process.terminate()
    said, _ = process.communicate(timeout=PATIENCE)
    return [json.loads(line) for line in said.splitlines() if line.startswith("{")]


LOCKSTEP = ("--lockstep", "--speed", "10")
"""Time waits for the node, so that a busy machine drives as well as a quiet one."""


def drive(start, wire, pace, *options):
    """Drive by one wire; returns the judge's outcome and the states of the node."""
    node = start("node", "--over", wire, "--json", *options)
    robot = start("simulate", TEXT, "--over", wire, *PLACE, *pace, *options)
    outcome = outcome_of(robot)
    assert robot.returncode == 0
    return outcome, lines_of(node)


def assert_done(outcome, states):
    """Both the judge and the node find the command carried out."""
    assert outcome["verdicts"] == ["done"]
    assert "done" in [state["phase"] for state in states]


@needs_dds
def test_a_command_by_dds_is_carried_out_in_lockstep_as_the_judge_sees_it(start):
    assert_done(*drive(start, "dds", LOCKSTEP))


@needs_dds
@needs_rclpy
def test_a_node_of_rclpy_drives_a_robot_that_speaks_dds(start):
    """By Fast DDS on one side and Cyclone DDS on the other, as ROS 2 has them."""
    here = [path for path in sys.path if path.endswith("site-packages")]
    path = os.pathsep.join([*map(str, dict.fromkeys((ROOT, *ROOTS.values()))), *here])
    words = ("node", "--over", "ros2", "--json", "--mount=0.45,0,0")
    node = start(*words, program=(str(RCLPY), *SEMNAV[1:]), PYTHONPATH=path)
    robot = start("simulate", TEXT, "--over", "dds", *PLACE, *LOCKSTEP)
    assert_done(outcome_of(robot), lines_of(node))


@needs_ros1
def test_a_command_by_ros_1_is_carried_out_in_lockstep_as_the_judge_sees_it(start, master):
    assert_done(*drive(start, "ros1", LOCKSTEP))


@needs_dds
def test_a_command_is_carried_out_in_time_that_does_not_wait(start):
    assert_done(*drive(start, "dds", ("--speed", "2")))


@pytest.mark.parametrize("kind", ["action", "topic"])
@pytest.mark.parametrize(
    "wire", [pytest.param("dds", marks=needs_dds), pytest.param("ros1", marks=needs_ros1)]
)
def test_a_navigator_carries_a_command_out_by_the_goals_on_the_wire(start, request, wire, kind):
    if wire == "ros1":
        request.getfixturevalue("master")
    outcome, states = drive(start, wire, ("--speed", "2"), "--navigator", kind)
    assert "delay_ms" not in outcome  # no velocity but zero came from the node
    assert_done(outcome, states)


@needs_dds
def test_a_node_without_its_navigator_says_so(start):
    node = start("node", "--over", "dds", "--json", "--navigator", "action")
    robot = start("simulate", TEXT, "--over", "dds", *PLACE[:1], "--seconds", "30")
    robot.communicate(timeout=PATIENCE)
    assert robot.returncode == 1  # it stood still: stopped short, or no verdict in that time
    assert "no navigator has answered" in [state["problem"] for state in lines_of(node)]


@needs_ros1
def test_a_drive_outlives_the_master_of_ros_1(start, master):
    node = start("node", "--over", "ros1", "--json")
    robot = start("simulate", TEXT, "--over", "ros1", *PLACE)
    for line in node.stdout:
        if line.startswith("{") and json.loads(line)["clauses"]:  # so all are connected
            break
    master.kill()
    assert outcome_of(robot)["verdicts"] == ["done"]


@needs_ros1
def test_a_master_that_comes_back_is_told_of_the_node_again(start, start_master):
    master = start_master()
    node = start("node", "--over", "ros1", "--json")
    assert any(line.startswith("{") for line in node.stdout)  # it runs
    master.kill()
    master.wait()
    start_master()
    robot = start("simulate", TEXT, "--over", "ros1", *PLACE, *LOCKSTEP)
    assert_done(outcome_of(robot), lines_of(node))


@needs_ros1
def test_without_a_master_the_node_says_so(start):
    node = start("node", "--over", "ros1")
    said, _ = node.communicate(timeout=PATIENCE)
    assert node.returncode == 2
    assert "no ROS master at http://127.0.0.1" in said


@needs_ros1
@needs_roslaunch
def test_roslaunch_brings_the_node_and_a_simulated_robot_to_a_verdict(start):
    words = ("-p", str(PORT), "semnav", "simulated.launch", "speed:=2")
    launch = start(*words, program=(str(ROSLAUNCH),))
    try:
        said, _ = launch.communicate(timeout=PATIENCE)
    finally:
        launch.terminate()  # and what it has started, if it still runs
    assert '"verdicts": ["done"]' in said


LISTENER = """
import json
from semnav_ros.opening import open_wire
from semnav_ros.topics import NodeTopics

wire, heard = open_wire("ros1", "listener"), []
wire.hear(NodeTopics().belief, lambda values: heard.append(json.loads(values["text"])))
print("listening", flush=True)
while not (heard and heard[-1]["doors"]):
    wire.wait(0.1)
wire.close()
print(json.dumps(heard[-1]))
"""
"""Prints that it listens, and then the first belief with doors."""

START = (1.0, 0.3, 0.24)


def recorded_drive(folder):
    """A bag of eight seconds down the hallway, which begins with a command; and the mount."""
    from tests.support.bags import BagFile, Moved, Said, Sweep

    robot = SimulatedRobot("heidelberg_hallway", pose=START)
    scan, odometry, _ = robot.sensed()
    messages = [Said(TEXT, scan.stamp - 0.5, "/semnav/command")]
    while scan.stamp < 108.0:
        fan = scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max
        messages.append(Moved(odometry.pose, scan.stamp))
        messages.append(Sweep(scan.ranges, scan.stamp, "/scan", *fan))
        robot.drive((0.4, 0.0, 0.0))
        scan, odometry, _ = robot.sensed()
    return BagFile("ros1", messages).write(folder), robot.mount


@needs_ros1
@needs_rosbag
def test_the_doors_of_a_played_bag_are_believed_where_they_are(start, master, tmp_path):
    bag, mount = recorded_drive(tmp_path)
    node = start("node", "--over", "ros1", "--json", f"--mount={','.join(map(str, mount))}")
    assert any(line.startswith("{") for line in node.stdout)  # it runs
    listener = start("-c", LISTENER, program=(sys.executable,))
    assert listener.stdout.readline() == "listening\n"
    start("play", "--wait-for-subscribers", "--quiet", str(bag), program=(str(ROSBAG),))
    said, _ = listener.communicate(timeout=PATIENCE)
    doors = np.array(json.loads(said.splitlines()[-1])["doors"])
    believed = points_to_parent(START, doors.reshape(-1, 2, 2).mean(axis=1))
    true = np.array([door.midpoint for door in load_floor_plan("heidelberg_hallway").doors])
    apart = np.linalg.norm(believed[:, None] - true, axis=2).min(axis=1)
    assert (apart < 0.3).all()


@needs_dds
def test_the_types_on_the_wire_have_the_names_of_ros_2():
    from semnav_ros.dds_wire import dds_type

    scan = dds_type("sensor_msgs/LaserScan")
    assert scan.__idl_typename__ == "sensor_msgs::msg::dds_::LaserScan_"
    message = scan()
    message.ranges = [1.0, 2.0]
    assert scan.deserialize(message.serialize()) == message


@needs_dds
def test_a_request_of_nav2_begins_with_the_client_and_the_number_of_the_request():
    from semnav_ros.dds_wire import dds_type

    kind = "nav2_msgs/NavigateToPose_SendGoal_Request"
    values = {"client": 7, "number": 9, "id": list(range(16)), "frame": "odom", "x": 2.5}
    request = written(kind, values, lambda name: dds_type(name)())
    assert dds_type(kind).__idl_typename__ == (
        "nav2_msgs::action::dds_::NavigateToPose_SendGoal_Request_"
    )
    after_encapsulation = request.serialize()[4:]
    assert struct.unpack("<Qq16B", after_encapsulation[:32]) == (7, 9, *range(16))
    assert read(kind, dds_type(kind).deserialize(request.serialize())) | values == (
        read(kind, request)
    )
