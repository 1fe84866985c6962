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

import pytest

from semnav_ros.fields import read, written
from semnav_ros.opening import MISSING
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
pytestmark = pytest.mark.slow


def environment(tmp_path, **more):
    roots = [str(folder) for folder in dict.fromkeys((ROOT, *ROOTS.values()))]
    path = os.pathsep.join([*roots, os.environ.get("PYTHONPATH", "")])
    ros1 = {"ROS_MASTER_URI": f"http://127.0.0.1:{PORT}", "ROS_IP": "127.0.0.1"}
    dds = {"ROS_DOMAIN_ID": str(DOMAIN), "CYCLONEDDS_URI": LOOPBACK}
    return {**os.environ, **ros1, **dds, "ROS_LOG_DIR": str(tmp_path), "PYTHONPATH": path, **more}


@pytest.fixture
def start(tmp_path):
    """Starts a sub-command of `semnav` or another program; ends it after the test."""
    running = []

    def begin(*words, program=(sys.executable, "-m", "semnav_scripts.main")):
        process = subprocess.Popen(
            [*program, *words],
            env=environment(tmp_path),
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


def drive(start, wire, *options):
    """Drive by one wire, twice as fast; returns the judge's outcome and the states of the node."""
    node = start("node", "--over", wire, "--json", *options)
    robot = start("simulate", TEXT, "--over", wire, *PLACE, "--speed", "2", *options)
    outcome = outcome_of(robot)
    assert robot.returncode == 0
    return outcome, lines_of(node)


@needs_dds
def test_a_command_by_dds_is_carried_out_as_the_judge_sees_it(start):
    outcome, states = drive(start, "dds")
    assert outcome["verdicts"] == ["done"]
    assert "done" in [state["phase"] for state in states]


@needs_ros1
def test_a_command_by_ros_1_is_carried_out_as_the_judge_sees_it(start, master):
    outcome, states = drive(start, "ros1")
    assert outcome["verdicts"] == ["done"]
    assert "done" in [state["phase"] for state in states]


@pytest.mark.parametrize("kind", ["action", "topic"])
@pytest.mark.parametrize(
    "wire", [pytest.param("dds", marks=needs_dds), pytest.param("ros1", marks=needs_ros1)]
)
def test_a_navigator_carries_a_command_out_by_the_goals_on_the_wire(start, request, wire, kind):
    if wire == "ros1":
        request.getfixturevalue("master")
    outcome, states = drive(start, wire, "--navigator", kind)
    assert outcome["verdicts"] == ["done"]
    assert "delay_ms" not in outcome  # no velocity but zero came from the node
    assert "done" in [state["phase"] for state in states]


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
    robot = start("simulate", TEXT, "--over", "ros1", *PLACE)
    assert outcome_of(robot)["verdicts"] == ["done"]
    assert "done" in [state["phase"] for state in lines_of(node)]


@needs_ros1
def test_without_a_master_the_node_says_so(start):
    node = start("node", "--over", "ros1")
    said, _ = node.communicate(timeout=PATIENCE)
    assert node.returncode == 2
    assert "no ROS master at http://127.0.0.1" in said


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
