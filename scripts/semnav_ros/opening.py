"""Opens a connection; each middleware is imported only where it is asked for."""

from __future__ import annotations

from typing import Literal, TypeAlias

from semnav_ros.wire import Wire

WireName: TypeAlias = Literal["ros1", "ros2", "dds"]


def open_wire(name: WireName, node: str) -> Wire:
    """Open a connection.

    Args:
        name: "ros1" (rospy), "ros2" (rclpy), or "dds": Cyclone DDS, which talks to ROS 2.
        node: name of the node.

    Raises:
        ModuleNotFoundError: its packages are not installed; says which.
        ConnectionError: there is no ROS master.
    """
    if name == "ros1":
        from semnav_ros.ros1_wire import Ros1Wire

        return Ros1Wire(node)
    if name == "ros2":
        from semnav_ros.ros2_wire import Ros2Wire

        return Ros2Wire(node)
    from semnav_ros.dds_wire import DdsWire

    return DdsWire()
