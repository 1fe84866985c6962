"""The ROS messages that hold scans and odometry, of either version."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_features.frames import Pose
from semnav_features.readers.channel import Channel
from semnav_features.readers.geometry import Geometry, checked_pose, checked_scan
from semnav_features.readers.log import BadRecordError
from semnav_features.scan import Scan

LASER_SCAN = "sensor_msgs/msg/LaserScan"
ODOMETRY = "nav_msgs/msg/Odometry"
ENCODINGS = ("ros1", "cdr")


class Decoder:
    """From raw messages to scans and poses, with the definitions that ROS itself ships.

    Bags need not carry definitions of these types, and many of ROS 2 do not.
    """

    def __init__(self) -> None:
        from rosbags.typesys import Stores, get_typestore

        self._decode = {
            "ros1": get_typestore(Stores.ROS1_NOETIC).deserialize_ros1,
            "cdr": get_typestore(Stores.LATEST).deserialize_cdr,
        }

    def scan(self, channel: Channel, time: int, data: bytes, geometry: Geometry) -> Scan:
        """The scan of a sensor_msgs/LaserScan; intensities are left out.

        Args:
            channel: the message's.
            time: of recording, nanoseconds; taken where the message has no stamp.
            data: its content.
            geometry: whose `range_max` counts where it is the smaller.

        Raises:
            BadRecordError: its numbers make no scan.
        """
        message = self._message(channel, data)
        stamp = message.header.stamp
        nanoseconds = stamp.sec * 10**9 + stamp.nanosec or time
        return checked_scan(
            np.asarray(message.ranges, np.float64),
            float(message.angle_min),
            float(message.angle_increment),
            geometry.nearer(float(message.range_max)),
            nanoseconds * 1e-9,
            float(message.range_min),
        )

    def odometry(self, channel: Channel, data: bytes) -> Pose:
        """The robot's pose of a nav_msgs/Odometry.

        Raises:
            BadRecordError: it is not finite.
        """
        pose = self._message(channel, data).pose.pose
        place, q = pose.position, pose.orientation
        sine, cosine = 2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z)
        heading = math.atan2(sine, cosine) if math.isfinite(sine + cosine) else math.nan
        return checked_pose(place.x, place.y, heading)

    def _message(self, channel: Channel, data: bytes) -> Any:
        try:  # bytes that are no such message raise whatever the parser stumbles over
            return self._decode[channel.encoding](data, channel.type)
        except Exception:
            raise BadRecordError("bytes that are not such a message") from None
