"""Talks to ROS 1 by rospy."""

from __future__ import annotations

import sys
from importlib import import_module
from typing import Any

from semnav_ros.fields import Values, written
from semnav_ros.message_types import message_type
from semnav_ros.move_base import MOVE_BASE, MoveBaseNavigator, MoveBaseServer
from semnav_ros.navigator import TakeGoal
from semnav_ros.ros1_master import MasterWatch
from semnav_ros.topics import Topic
from semnav_ros.wire import Take, Waiting

DEBIAN = "/usr/lib/python3/dist-packages"
"""Where Debian's packages of ROS 1 lie. It is searched last, after this environment's packages."""

if DEBIAN not in sys.path:
    sys.path.append(DEBIAN)
rosgraph, rospy = import_module("rosgraph"), import_module("rospy")


class Ros1Wire:
    """A node of ROS 1.

    If the master dies, what is connected stays connected; a master that comes back is told again of
    this node's topics, see `MasterWatch`.

    Args:
        node: its name.

    Raises:
        ConnectionError: there is no master at ROS_MASTER_URI.
    """

    def __init__(self, node: str) -> None:
        if not rosgraph.is_master_online():
            uri = rosgraph.get_master_uri()
            raise ConnectionError(f"no ROS master at {uri}: start roscore, or set ROS_MASTER_URI")
        rospy.init_node(node, disable_signals=True)
        self._watch = MasterWatch(rospy.get_name())
        self._watch.start()
        self._waiting = Waiting()
        self._publishers: dict[str, Any] = {}

    def hear(self, topic: Topic, take: Take) -> None:
        """Give each message of a topic to `take`, in `wait`."""
        put = self._waiting.add(topic, take)
        options = {"queue_size": topic.depth, "tcp_nodelay": True, "buff_size": 2**20}
        rospy.Subscriber(topic.name, message_type(topic.kind), put, **options)

    def announce(self, topic: Topic) -> None:
        """Say that messages of a topic will come."""
        options = {"queue_size": topic.depth, "latch": topic.latched, "tcp_nodelay": True}
        publisher = rospy.Publisher(topic.name, message_type(topic.kind), **options)
        self._publishers[topic.name] = publisher

    def say(self, topic: Topic, values: Values) -> None:
        """Publish a message of a topic that was announced."""
        message = written(topic.kind, values, lambda kind: message_type(kind)())
        self._publishers[topic.name].publish(message)

    def listeners(self, topic: Topic) -> int:
        """How many hear a topic that was announced, itself included."""
        return int(self._publishers[topic.name].get_num_connections())

    def wait(self, seconds: float) -> None:
        """Wait for messages for at most this time, and give what came to who takes it."""
        self._waiting.give(seconds)

    def navigator(self, action: str | None) -> MoveBaseNavigator:
        """What sends goals to move_base."""
        return MoveBaseNavigator(self, action or MOVE_BASE)

    def navigator_server(self, take: TakeGoal, action: str | None) -> MoveBaseServer:
        """What hears the goals of move_base in its place."""
        return MoveBaseServer(self, take, action or MOVE_BASE)

    def close(self) -> None:
        """Leave the graph."""
        self._watch.end()
        rospy.signal_shutdown("closed")
