"""Bags of every kind, written for the tests."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from rosbags import rosbag1, rosbag2
from rosbags.typesys import Stores, get_typestore

KINDS = ("ros1", "sqlite3", "mcap")
STORES = {"ros1": Stores.ROS1_NOETIC, "sqlite3": Stores.ROS2_HUMBLE, "mcap": Stores.ROS2_HUMBLE}
TYPES = {kind: get_typestore(store) for kind, store in STORES.items()}


@dataclass(frozen=True)
class Sweep:
    """One LaserScan message."""

    ranges: Any
    time: float = 1.0
    topic: str = "/scan"
    angle_min: float = -1.0
    angle_increment: float = 0.01
    range_min: float = 0.1
    range_max: float = 12.0


@dataclass(frozen=True)
class Moved:
    """One Odometry message."""

    pose: tuple[float, float, float]
    time: float = 1.0
    topic: str = "/odom"


@dataclass(frozen=True)
class Said:
    """One String message, to stand in the way."""

    text: str = "hello"
    time: float = 1.0
    topic: str = "/chatter"


@dataclass
class BagFile:
    """A bag to be written."""

    kind: str
    messages: list[Any] = field(default_factory=list)
    compression: str | None = None

    def write(self, folder: Path, name: str = "bag") -> Path:
        """Write it, and return its path: a file of ROS 1, a folder of ROS 2."""
        path = folder / (f"{name}.bag" if self.kind == "ros1" else name)
        with self._writer(path) as writer:
            connections: dict[str, Any] = {}
            for message in self.messages:
                made, type_name = MAKERS[type(message)](self.kind, message)
                if message.topic not in connections:
                    connections[message.topic] = writer.add_connection(
                        message.topic, type_name, typestore=TYPES[self.kind]
                    )
                data = self._serialized(made, type_name)
                writer.write(connections[message.topic], round(message.time * 1e9), data)
        return path

    def _writer(self, path: Path) -> Any:
        if self.kind == "ros1":
            writer = rosbag1.Writer(path)
            if self.compression:
                writer.set_compression(writer.CompressionFormat[self.compression.upper()])
            return writer
        plugin = rosbag2.StoragePlugin[self.kind.upper()]
        writer2 = rosbag2.Writer(path, version=8, storage_plugin=plugin)
        if self.compression:
            mode = rosbag2.CompressionMode[self.compression.upper()]
            writer2.set_compression(mode, rosbag2.CompressionFormat.ZSTD)
        return writer2

    def _serialized(self, message: Any, type_name: str) -> Any:
        types = TYPES[self.kind]
        if self.kind == "ros1":
            return types.serialize_ros1(message, type_name)
        return types.serialize_cdr(message, type_name)


def storage(bag: Path) -> Path:
    """The file of a bag in which its messages lie."""
    return bag if bag.is_file() else next(p for p in bag.iterdir() if p.suffix != ".yaml")


def _header(kind: str, time: float) -> Any:
    types = TYPES[kind].types
    nanoseconds = round(time * 1e9)
    stamp = types["builtin_interfaces/msg/Time"](nanoseconds // 10**9, nanoseconds % 10**9)
    sequence = {"seq": 0} if kind == "ros1" else {}
    return types["std_msgs/msg/Header"](**sequence, stamp=stamp, frame_id="laser")


def _sweep(kind: str, sweep: Sweep) -> tuple[Any, str]:
    name = "sensor_msgs/msg/LaserScan"
    ranges = np.ascontiguousarray(sweep.ranges, np.float32)
    message = TYPES[kind].types[name](
        header=_header(kind, sweep.time),
        angle_min=sweep.angle_min,
        angle_max=sweep.angle_min + sweep.angle_increment * (len(ranges) - 1),
        angle_increment=sweep.angle_increment,
        time_increment=0.0,
        scan_time=0.1,
        range_min=sweep.range_min,
        range_max=sweep.range_max,
        ranges=ranges,
        intensities=np.ones(len(ranges), np.float32),
    )
    return message, name


def _moved(kind: str, moved: Moved) -> tuple[Any, str]:
    types = TYPES[kind].types
    x, y, heading = moved.pose
    turn = types["geometry_msgs/msg/Quaternion"](
        x=0.0, y=0.0, z=float(np.sin(heading / 2)), w=float(np.cos(heading / 2))
    )
    vector = types["geometry_msgs/msg/Vector3"]
    still = types["geometry_msgs/msg/Twist"](
        linear=vector(0.0, 0.0, 0.0), angular=vector(0.0, 0.0, 0.0)
    )
    place = types["geometry_msgs/msg/Point"](x=x, y=y, z=0.0)
    message = types["nav_msgs/msg/Odometry"](
        header=_header(kind, moved.time),
        child_frame_id="base",
        pose=types["geometry_msgs/msg/PoseWithCovariance"](
            pose=types["geometry_msgs/msg/Pose"](position=place, orientation=turn),
            covariance=np.zeros(36),
        ),
        twist=types["geometry_msgs/msg/TwistWithCovariance"](twist=still, covariance=np.zeros(36)),
    )
    return message, "nav_msgs/msg/Odometry"


def _said(kind: str, said: Said) -> tuple[Any, str]:
    return TYPES[kind].types["std_msgs/msg/String"](data=said.text), "std_msgs/msg/String"


MAKERS = {Sweep: _sweep, Moved: _moved, Said: _said}
