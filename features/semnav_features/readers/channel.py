"""Channels and raw messages of a bag, before decoding."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias


class Channel(NamedTuple):
    """A channel of a bag, with messages of one type.

    Attributes:
        topic: its name, such as /scan.
        type: of its messages, in ROS 2's words: sensor_msgs/msg/LaserScan.
        encoding: of their bytes: ros1, cdr, or something that is not ROS's.
    """

    topic: str
    type: str
    encoding: str

    @classmethod
    def of(cls, topic: str, type_name: str, encoding: str) -> Channel:
        """A channel, its type in ROS 1's or ROS 2's words."""
        package, _, name = type_name.partition("/")
        return cls(topic, f"{package}/msg/{name.removeprefix('msg/')}", encoding)


Message: TypeAlias = tuple[Channel, int, bytes]
"""Channel, time of recording in nanoseconds, and content of a message."""
