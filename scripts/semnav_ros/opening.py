"""Opens a connection; each middleware is imported only where it is asked for."""

from __future__ import annotations

from typing import Literal, TypeAlias

from semnav_ros.navigator import Navigator, NavigatorServer, TakeGoal
from semnav_ros.topic_navigator import TopicNavigator, TopicServer
from semnav_ros.topics import NodeTopics
from semnav_ros.wire import Wire

WireName: TypeAlias = Literal["ros1", "ros2", "dds"]
NavigatorKind: TypeAlias = Literal["action", "topic"]

MISSING: dict[WireName, str] = {
    "ros1": "rospy is missing: apt-get install python3-rospy python3-rosmaster python3-sensor-msgs "
    "python3-nav-msgs python3-visualization-msgs python3-tf2-msgs python3-move-base-msgs (Debian)",
    "ros2": "rclpy is missing, which comes with ROS 2: install ROS 2, source its "
    "setup.bash in this shell and use its Python; or do without ROS by --over dds "
    '(pip install "semnav-env[dds]"), or take --over ros1',
    "dds": 'Cyclone DDS is missing: pip install "semnav-env[dds]"',
}
"""What to do where the packages of a middleware are not installed."""


def open_wire(name: WireName, node: str) -> Wire:
    """Open a connection.

    Args:
        name: "ros1" (rospy), "ros2" (rclpy), or "dds": Cyclone DDS, which talks to ROS 2.
        node: name of the node.

    Raises:
        ImportError: its packages are not installed; says which, and how they are.
        ConnectionError: there is no ROS master.
    """
    try:
        if name == "ros1":
            from semnav_ros.ros1_wire import Ros1Wire

            return Ros1Wire(node)
        if name == "ros2":
            from semnav_ros.ros2_wire import Ros2Wire

            return Ros2Wire(node)
        from semnav_ros.dds_wire import DdsWire

        return DdsWire()
    except ModuleNotFoundError as error:
        raise ImportError(MISSING[name]) from error


def open_navigator(
    kind: NavigatorKind, wire: Wire, topics: NodeTopics, action: str | None = None
) -> Navigator:
    """The robot's navigator, on a wire that `open_wire` opened.

    Args:
        kind: "action" (nav2's NavigateToPose, or move_base in ROS 1) or "topic" (goal_pose).
        wire: what carries the goals.
        topics: of the node.
        action: name of the action; the usual one if not given.
    """
    if kind == "topic":
        return TopicNavigator(wire, topics.goal_pose)
    return wire.navigator(action)


def open_navigator_server(
    kind: NavigatorKind, wire: Wire, topics: NodeTopics, take: TakeGoal, action: str | None = None
) -> NavigatorServer:
    """The other side of `open_navigator`, for what drives in place of nav2 or move_base."""
    if kind == "topic":
        return TopicServer(wire, take, topics.goal_pose)
    return wire.navigator_server(take, action)
