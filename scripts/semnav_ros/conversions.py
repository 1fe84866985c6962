"""Between the plain data of `fields.FIELDS` and the messages of the node."""

from __future__ import annotations

import json
import math
from dataclasses import asdict

import numpy as np

from semnav_features.frames import Pose, Twist
from semnav_ros.fields import Values
from semnav_ros.laser_frame import heading_of
from semnav_ros.messages import (
    BeliefMessage,
    Bumps,
    MarkerMessage,
    NodeStatus,
    OdometryMessage,
    ScanMessage,
    TransformMessage,
)

LINE_LIST, ADD = 5, 0
"""Numbers of visualization_msgs/Marker."""


def scan_message(values: Values) -> ScanMessage:
    """A sensor_msgs/LaserScan."""
    known = {name: value for name, value in values.items() if name != "angle_max"}
    return ScanMessage(**(known | {"ranges": np.asarray(known["ranges"], np.float64)}))


def scan_values(message: ScanMessage) -> Values:
    """A scan as a sensor_msgs/LaserScan."""
    ranges = np.asarray(message.ranges, np.float64)
    last = message.angle_min + message.angle_increment * (len(ranges) - 1)
    return vars(message) | {"ranges": ranges.tolist(), "angle_max": last}


def odometry_message(values: Values) -> OdometryMessage:
    """A nav_msgs/Odometry."""
    twist = values["forward"], values["left"], values["yaw_rate"]
    return OdometryMessage(values["stamp"], pose_of(values), twist, values["frame"])


def odometry_values(message: OdometryMessage, base_frame: str) -> Values:
    """Odometry as a nav_msgs/Odometry."""
    where = {"stamp": message.stamp, "frame": message.frame, "child": base_frame}
    return where | pose_values(message.pose) | twist_values(message.twist)


def transform_messages(values: Values) -> list[TransformMessage]:
    """The transforms of a tf2_msgs/TFMessage."""
    return [
        TransformMessage(each["frame"], each["child"], (each["x"], each["y"]), _quaternion_of(each))
        for each in values["transforms"]
    ]


def transform_values(parent: str, child: str, pose: Pose) -> Values:
    """One fixed transform as a tf2_msgs/TFMessage."""
    return {"transforms": [{"frame": parent, "child": child} | pose_values(pose)]}


def bumps_of(values: Values) -> Bumps:
    """The contacts of a geometry_msgs/PoseArray: each pose looks into what is touched."""
    return [pose_of(each) for each in values["poses"]]


def bumps_values(bumps: Bumps, base_frame: str) -> Values:
    """Contacts as a geometry_msgs/PoseArray."""
    return {"frame": base_frame, "poses": [pose_values(each) for each in bumps]}


def pose_of(values: Values) -> Pose:
    """The pose of x, y and a quaternion."""
    return values["x"], values["y"], heading_of(*_quaternion_of(values))


def pose_values(pose: Pose) -> Values:
    """X, y and the quaternion of a pose."""
    x, y, heading = map(float, pose)
    return {"x": x, "y": y, "qz": math.sin(heading / 2), "qw": math.cos(heading / 2)}


def twist_values(twist: Twist) -> Values:
    """A geometry_msgs/Twist."""
    return dict(zip(("forward", "left", "yaw_rate"), map(float, twist), strict=True))


def twist_of(values: Values) -> Twist:
    """The velocity of a geometry_msgs/Twist."""
    return values["forward"], values["left"], values["yaw_rate"]


def status_text(status: NodeStatus) -> str:
    """A status as JSON."""
    return json.dumps(asdict(status))


def belief_text(belief: BeliefMessage) -> str:
    """A belief as JSON, metres and radians, with three decimals."""
    known = {name: np.round(value, 3).tolist() for name, value in vars(belief).items()}
    return json.dumps(known)


def marker_values(markers: tuple[MarkerMessage, ...], frame: str) -> Values:
    """Markers as a visualization_msgs/MarkerArray."""
    return {"markers": [_marker(each, frame) for each in markers]}


def _marker(marker: MarkerMessage, frame: str) -> Values:
    colour = dict(zip(("red", "green", "blue"), marker.colour, strict=True))
    points = [{"x": x, "y": y} for x, y in marker.points.tolist()]
    kind = {"name": marker.name, "kind": LINE_LIST, "action": ADD, "qw": 1.0, "opacity": 1.0}
    return kind | colour | {"frame": frame, "width": marker.width, "points": points}


def _quaternion_of(values: Values) -> tuple[float, float, float, float]:
    return values["qx"], values["qy"], values["qz"], values["qw"]
