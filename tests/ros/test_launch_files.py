"""The launch files start what the commands know: their options, and the topics of the node."""

import os
import shlex
import subprocess
import sys
from dataclasses import fields
from pathlib import Path
from types import ModuleType, SimpleNamespace
from xml.etree import ElementTree

import pytest

from semnav_ros.topics import NodeTopics
from semnav_scripts import node, simulate
from semnav_scripts.arguments import parse
from semnav_scripts.node import LAUNCH_FILES, renamings
from tests.support.paths import ROOT, ROOTS

TOPICS = {field.name for field in fields(NodeTopics)}
HERE_ONLY = {"over", "topics", "json", "launch_files"}
"""Options that say nothing of a robot."""

OPTIONS = {field.name for field in fields(node.Arguments)} - HERE_ONLY
ROSLAUNCH = Path("/usr/bin/roslaunch")
needs_roslaunch = pytest.mark.skipif(
    not ROSLAUNCH.exists(), reason="roslaunch is missing: apt-get install python3-roslaunch"
)


def ros1(name, **given):
    """Arguments, and the words and the remappings of each node, of a launch file of ROS 1."""
    launch = ElementTree.parse(LAUNCH_FILES / name).getroot()
    values = {arg.get("name"): arg.get("default") for arg in launch.findall("arg")} | given
    nodes = {}
    for each in launch.findall("node"):
        words = each.get("args")
        for argument, value in values.items():
            words = words.replace(f"$(arg {argument})", value)
        assert "$(" not in words
        remaps = {remap.get("from"): remap.get("to") for remap in each.findall("remap")}
        nodes[each.get("name")] = shlex.split(words), remaps
    return values, nodes


def ros2(monkeypatch, **given):
    """Arguments and words of the launch file of ROS 2, on a stand-in for its library."""
    parts = {
        "launch": {"LaunchDescription": list},
        "launch.actions": {
            "DeclareLaunchArgument": lambda name, default_value, description: (name, default_value),
            "ExecuteProcess": lambda cmd, output: SimpleNamespace(cmd=cmd),
        },
        "launch.substitutions": {"LaunchConfiguration": lambda name: SimpleNamespace(name=name)},
    }
    for name, members in parts.items():
        module = ModuleType(name)
        vars(module).update(members)
        monkeypatch.setitem(sys.modules, name, module)
    names = {}
    file = LAUNCH_FILES / "node.launch.py"
    exec(compile(file.read_text("utf-8"), str(file), "exec"), names)
    *declared, process = names["generate_launch_description"]()
    values = dict(declared) | given
    words = [
        "".join(values[part.name] if hasattr(part, "name") else part for part in word)
        if isinstance(word, list)
        else word
        for word in process.cmd
    ]
    return values, words


def test_ros_1_starts_the_node_as_it_is_without_options():
    values, nodes = ros1("node.launch")
    (words, remaps) = nodes["semnav"]
    assert words[0] == "node"
    assert parse(node.Arguments, words[1:], "node") == node.Arguments(over="ros1")
    assert all(remaps[name] == f"$(arg {name})" and values[name] == name for name in remaps)


def test_ros_2_starts_the_node_as_it_is_without_options(monkeypatch):
    values, (program, command, *words) = ros2(monkeypatch)
    assert (program, command) == ("semnav", "node")
    started = parse(node.Arguments, words, "node")
    topics = NodeTopics().renamed(renamings(started.topics))
    assert topics == NodeTopics()
    assert started == node.Arguments(over="ros2", topics=started.topics)
    assert all(values[name] == getattr(topics, name).name for name in values if name in TOPICS)


def test_both_take_every_option_of_a_robot_and_its_topics(monkeypatch):
    for values in (ros1("node.launch")[0], ros2(monkeypatch)[0]):
        assert set(values) >= OPTIONS
        assert set(values) - OPTIONS <= TOPICS
        assert {"scan", "odom", "cmd_vel", "goal_pose"} <= set(values)


GIVEN = {"robot": "spot", "mount": "0.2,0,0", "base_frame": "base", "navigator": "topic"}


def test_what_is_given_arrives(monkeypatch):
    (words, remaps) = ros1("node.launch", **GIVEN)[1]["semnav"]
    assert parse(node.Arguments, words[1:], "node") == node.Arguments(over="ros1", **GIVEN)
    assert set(remaps) <= {getattr(NodeTopics(), name).name for name in TOPICS}
    _, words = ros2(monkeypatch, **GIVEN, scan="/front/scan")
    started = parse(node.Arguments, words[2:], "node")
    assert started == node.Arguments(over="ros2", topics=started.topics, **GIVEN)
    assert NodeTopics().renamed(renamings(started.topics)).scan.name == "front/scan"


def test_the_simulated_robot_is_told_a_command_of_several_words():
    values, nodes = ros1("simulated.launch", command="turn left and stop")
    command, *words = nodes["semnav_robot"][0]
    started = parse(simulate.Arguments, words, "simulate")
    assert command == "simulate"
    assert started == simulate.Arguments("turn left and stop", over="ros1", pose=values["pose"])


def environment(**more):
    roots = [str(folder) for folder in dict.fromkeys((ROOT, *ROOTS.values()))]
    paths = {
        "PYTHONPATH": os.pathsep.join([*roots, os.environ.get("PYTHONPATH", "")]),
        "PATH": os.pathsep.join([str(Path(sys.executable).parent), os.environ.get("PATH", "")]),
    }
    return {**os.environ, **paths, "ROS_PACKAGE_PATH": str(LAUNCH_FILES), **more}


def test_remappings_are_left_to_rospy():
    """The file that roslaunch runs must be executable, in a wheel, too."""
    words = [LAUNCH_FILES / "run", "node", "--launch-files", "scan:=/front/scan", "__name:=nav"]
    done = subprocess.run(words, env=environment(), capture_output=True, text=True, check=True)
    assert done.stdout.strip() == str(LAUNCH_FILES)


@needs_roslaunch
def test_roslaunch_starts_what_the_file_says():
    words = [ROSLAUNCH, "--args", "semnav", "semnav", "node.launch", "robot:=spot", "scan:=/front"]
    done = subprocess.run(words, env=environment(), capture_output=True, text=True, check=True)
    started = shlex.split(done.stdout)
    assert str(LAUNCH_FILES / "run") in started
    assert {"node", "--robot=spot", "scan:=/front", "__name:=semnav"} <= set(started)
