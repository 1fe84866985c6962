"""The calls of rclpy, on a stand-in for it: rclpy itself comes only with ROS 2."""

import sys
from types import ModuleType, SimpleNamespace

import pytest

from semnav_ros.topics import NodeTopics


class StandIn:
    """The part of an rclpy node that is used; what is published comes back at the next spin."""

    def __init__(self):
        self.takers, self.sent, self.profiles = {}, [], {}

    def create_subscription(self, kind, name, take, qos):
        self.takers[name], self.profiles[name] = take, qos

    def create_publisher(self, kind, name, qos):
        send = lambda message: self.sent.append((name, message))  # noqa: E731
        return SimpleNamespace(publish=send, get_subscription_count=lambda: 1)

    def spin(self, timeout_sec):
        for name, message in self.sent:
            self.takers[name](message)
        self.sent.clear()

    def destroy_node(self):
        self.takers.clear()


class Text:
    def __init__(self):
        self.data = ""


@pytest.fixture
def node(monkeypatch):
    node = StandIn()
    rclpy, qos, messages = (ModuleType(name) for name in ("rclpy", "rclpy.qos", "std_msgs.msg"))
    rclpy.init, rclpy.shutdown, rclpy.qos = (lambda: None), (lambda: None), qos
    rclpy.create_node = lambda name: node
    rclpy.spin_once = lambda node, timeout_sec: node.spin(timeout_sec)
    qos.ReliabilityPolicy = SimpleNamespace(RELIABLE="reliable", BEST_EFFORT="best effort")
    qos.DurabilityPolicy = SimpleNamespace(TRANSIENT_LOCAL="kept", VOLATILE="volatile")
    qos.QoSProfile = SimpleNamespace
    messages.String = messages.Bool = Text
    for module in (rclpy, qos, messages):
        monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.delitem(sys.modules, "semnav_ros.ros2_wire", raising=False)
    yield node
    sys.modules.pop("semnav_ros.ros2_wire", None)


def test_a_text_goes_out_and_comes_in_with_the_quality_of_its_topic(node):
    from semnav_ros.opening import open_wire

    wire, topics, heard = open_wire("ros2", "semnav"), NodeTopics(), []
    wire.hear(topics.status, heard.append)
    wire.announce(topics.status)
    assert wire.listeners(topics.status) == 1
    wire.say(topics.status, {"text": "hello"})
    wire.wait(0.1)
    wire.close()
    assert heard == [{"text": "hello"}]
    assert vars(node.profiles["semnav/status"]) == {
        "depth": 10,
        "reliability": "reliable",
        "durability": "kept",
    }


def test_a_package_of_messages_that_is_missing_is_named_with_its_remedy(node, monkeypatch):
    """The wheels of ROS 2 have no tf2_msgs, which a simulated robot says its mount by."""
    from semnav_ros.opening import open_wire

    for name in ("tf2_msgs", "tf2_msgs.msg"):
        monkeypatch.setitem(sys.modules, name, None)
    wire = open_wire("ros2", "semnav_robot")
    with pytest.raises(ImportError, match=r"tf2_msgs is missing.*ros-\$ROS_DISTRO-tf2-msgs"):
        wire.announce(NodeTopics().tf_static)


def test_a_stop_is_given_out_before_a_scan_that_came_earlier():
    from semnav_ros.wire import Waiting

    waiting, order, topics = Waiting(), [], NodeTopics()
    stop = waiting.add(topics.stop, lambda values: order.append("stop"))
    told = waiting.add(topics.command, lambda values: order.append(values["text"]))
    for message in ("turn left", "go on"):
        told(SimpleNamespace(data=message))
    stop(SimpleNamespace(data=True))
    waiting.give(0.0)
    assert order == ["stop", "turn left"]
    waiting.give(0.0)
    assert order == ["stop", "turn left", "go on"]
