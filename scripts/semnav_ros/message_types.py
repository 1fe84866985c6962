"""The classes of messages, from the packages of ROS that hold them."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def message_type(kind: str) -> Any:
    """The class of a message, such as "sensor_msgs/LaserScan"; ROS 1 and ROS 2 name them alike.

    Raises:
        ImportError: its package is not installed; says how it is.
    """
    package, name = kind.split("/")
    try:
        module = import_module(f"{package}.msg")
    except ModuleNotFoundError as error:
        dashed = package.replace("_", "-")
        raise ImportError(
            f"{package} is missing, which holds the messages {kind}: apt-get install "
            f"ros-$ROS_DISTRO-{dashed} (ROS 2; there is no wheel of each) or python3-{dashed} "
            "(Debian's ROS 1); or do without ROS by --over dds"
        ) from error
    return getattr(module, name)
