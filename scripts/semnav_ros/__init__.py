"""A robot's own node: spoken commands carried out on a real robot, with ROS 1, ROS 2 or neither."""

from semnav_ros.messages import (
    BeliefMessage,
    MarkerMessage,
    NodeReply,
    NodeStatus,
    OdometryMessage,
    Phase,
    ScanMessage,
    TransformMessage,
)
from semnav_ros.robot_node import RobotNode
from semnav_ros.shown_belief import markers_of

__all__ = [
    "BeliefMessage",
    "MarkerMessage",
    "NodeReply",
    "NodeStatus",
    "OdometryMessage",
    "Phase",
    "RobotNode",
    "ScanMessage",
    "TransformMessage",
    "markers_of",
]
