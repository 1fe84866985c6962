"""Talks to ROS 2 by rclpy."""

from __future__ import annotations

from typing import Any

import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from semnav_ros.fields import Values, written
from semnav_ros.message_types import message_type
from semnav_ros.nav2 import NAVIGATE_TO_POSE
from semnav_ros.navigator import Navigator, NavigatorServer, TakeGoal
from semnav_ros.topics import Topic
from semnav_ros.wire import Take, Waiting


class Ros2Wire:
    """A node of ROS 2.

    Args:
        node: its name.
    """

    def __init__(self, node: str) -> None:
        rclpy.init()
        self._node = rclpy.create_node(node)
        self._waiting = Waiting()
        self._publishers: dict[str, Any] = {}

    def hear(self, topic: Topic, take: Take) -> None:
        """Give each message of a topic to `take`, in `wait`."""
        put = self._waiting.add(topic, take)
        self._node.create_subscription(message_type(topic.kind), topic.name, put, _qos(topic))

    def announce(self, topic: Topic) -> None:
        """Say that messages of a topic will come."""
        publisher = self._node.create_publisher(message_type(topic.kind), topic.name, _qos(topic))
        self._publishers[topic.name] = publisher

    def say(self, topic: Topic, values: Values) -> None:
        """Publish a message of a topic that was announced."""
        message = written(topic.kind, values, lambda kind: message_type(kind)())
        self._publishers[topic.name].publish(message)

    def listeners(self, topic: Topic) -> int:
        """How many hear a topic that was announced, itself included."""
        return int(self._publishers[topic.name].get_subscription_count())

    def wait(self, seconds: float) -> None:
        """Wait for messages for at most this time, and give what came to who takes it."""
        rclpy.spin_once(self._node, timeout_sec=seconds)
        self._waiting.give(0.0)

    def navigator(self, action: str | None) -> Navigator:
        """What sends goals to nav2."""
        from semnav_ros.ros2_navigator import Ros2Navigator  # nav2_msgs need not be installed

        return Ros2Navigator(self._node, action or NAVIGATE_TO_POSE)

    def navigator_server(self, take: TakeGoal, action: str | None) -> NavigatorServer:
        """None: nav2 itself is there.

        Raises:
            ValueError: always.
        """
        raise ValueError("over ros2 there is no stand-in for nav2: run nav2, or take --over dds")

    def close(self) -> None:
        """Leave the graph."""
        self._node.destroy_node()
        rclpy.shutdown()


def _qos(topic: Topic) -> QoSProfile:
    reliable, latched = ReliabilityPolicy.RELIABLE, DurabilityPolicy.TRANSIENT_LOCAL
    return QoSProfile(
        depth=topic.depth,
        reliability=reliable if topic.reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=latched if topic.latched else DurabilityPolicy.VOLATILE,
    )
