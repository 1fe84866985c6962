"""Where the fields of ROS messages lie: one table for ROS 1, ROS 2 and DDS.

Messages of all three have the same attributes, except that a time has `secs` and `nsecs` in ROS 1
and `sec` and `nanosec` elsewhere.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import reduce
from typing import Any, TypeAlias

Values: TypeAlias = dict[str, Any]
"""A message as plain data, by the names of `FIELDS`."""

Field: TypeAlias = str | tuple[str, str]
"""The path of a value; or the path of a list, and the type of its items."""

_HEADER: dict[str, Field] = {"stamp": "header.stamp", "frame": "header.frame_id"}
_TWIST: dict[str, Field] = {"forward": "linear.x", "left": "linear.y", "yaw_rate": "angular.z"}
_POSE: dict[str, Field] = {
    "x": "position.x",
    "y": "position.y",
    **{f"q{axis}": f"orientation.{axis}" for axis in "xyzw"},
}
_GOAL_ID: dict[str, Field] = {"id": "goal_id.id"}
_REQUEST: dict[str, Field] = {"client": "client", "number": "number"}


def _under(path: str, fields: Mapping[str, Field]) -> dict[str, Field]:
    return {name: f"{path}.{field}" for name, field in fields.items()}


_POSE_STAMPED = _HEADER | _under("pose", _POSE)

FIELDS: dict[str, dict[str, Field]] = {
    "std_msgs/String": {"text": "data"},
    "std_msgs/Bool": {"value": "data"},
    "sensor_msgs/LaserScan": _HEADER
    | {name: name for name in ("angle_min", "angle_max", "angle_increment", "scan_time")}
    | {name: name for name in ("range_min", "range_max", "ranges")},
    "nav_msgs/Odometry": _HEADER
    | {"child": "child_frame_id"}
    | _under("pose.pose", _POSE)
    | _under("twist.twist", _TWIST),
    "geometry_msgs/Twist": _TWIST,
    "geometry_msgs/Pose": _POSE,
    "geometry_msgs/PoseStamped": _POSE_STAMPED,
    "geometry_msgs/PoseArray": _HEADER | {"poses": ("poses", "geometry_msgs/Pose")},
    "geometry_msgs/TransformStamped": _HEADER
    | {"child": "child_frame_id", "x": "transform.translation.x", "y": "transform.translation.y"}
    | {f"q{axis}": f"transform.rotation.{axis}" for axis in "xyzw"},
    "tf2_msgs/TFMessage": {"transforms": ("transforms", "geometry_msgs/TransformStamped")},
    "geometry_msgs/Point": {"x": "x", "y": "y"},
    "visualization_msgs/Marker": _HEADER
    | {"name": "ns", "kind": "type", "action": "action", "width": "scale.x"}
    | {"red": "color.r", "green": "color.g", "blue": "color.b", "opacity": "color.a"}
    | {"qw": "pose.orientation.w", "points": ("points", "geometry_msgs/Point")},
    "visualization_msgs/MarkerArray": {"markers": ("markers", "visualization_msgs/Marker")},
    "actionlib_msgs/GoalID": {"id": "id"},
    "actionlib_msgs/GoalStatus": {"id": "goal_id.id", "state": "status"},
    "actionlib_msgs/GoalStatusArray": {"states": ("status_list", "actionlib_msgs/GoalStatus")},
    "move_base_msgs/MoveBaseActionGoal": _GOAL_ID | _under("goal.target_pose", _POSE_STAMPED),
    "action_msgs/GoalStatus": {"id": "goal_info.goal_id.uuid", "state": "status"},
    "action_msgs/GoalStatusArray": {"states": ("status_list", "action_msgs/GoalStatus")},
    "action_msgs/CancelGoal_Request": _REQUEST | {"id": "goal_info.goal_id.uuid"},
    "nav2_msgs/NavigateToPose_Goal": _under("pose", _POSE_STAMPED),
    "nav2_msgs/NavigateToPose_SendGoal_Request": _REQUEST
    | {"id": "goal_id.uuid"}
    | _under("pose", _POSE_STAMPED),
    "nav2_msgs/NavigateToPose_SendGoal_Response": _REQUEST | {"accepted": "accepted"},
}
"""The fields that are read and written, by the type of the message."""


def read(kind: str, message: Any) -> Values:
    """A message of a type as plain data."""
    values: Values = {}
    for name, field in FIELDS[kind].items():
        path, items = (field, None) if isinstance(field, str) else field
        value = reduce(getattr, path.split("."), message)
        if items is not None:
            value = [read(items, each) for each in value]
        values[name] = _seconds(value) if name == "stamp" else value
    return values


def written(kind: str, values: Values, new: Callable[[str], Any]) -> Any:
    """A message of a type with these values; the others are zero.

    Args:
        kind: the type, as in `FIELDS`.
        values: by the names of `FIELDS`.
        new: makes an empty message of a type.
    """
    message = new(kind)
    for name, value in values.items():
        field = FIELDS[kind][name]
        path, items = (field, None) if isinstance(field, str) else field
        *way, last = path.split(".")
        place = reduce(getattr, way, message)
        if name == "stamp":
            _set_seconds(getattr(place, last), value)
        elif items is None:
            setattr(place, last, value)
        else:
            setattr(place, last, [written(items, each, new) for each in value])
    return message


def _seconds(time: Any) -> float:
    if hasattr(time, "secs"):
        return float(time.secs) + 1e-9 * float(time.nsecs)
    return float(time.sec) + 1e-9 * float(time.nanosec)


def _set_seconds(time: Any, seconds: float) -> None:
    whole = int(seconds // 1)
    rest = min(round((seconds - whole) * 1e9), 999_999_999)
    if hasattr(time, "secs"):
        time.secs, time.nsecs = whole, rest
    else:
        time.sec, time.nanosec = whole, rest
