"""Requests and replies of services, as rmw_cyclonedds_cpp puts them on the wire.

Each begins with the number of its client and of the request. A goal within a request has no
header of its own on the wire, so that its fields stand here directly.
"""

from __future__ import annotations

HEADER = "uint64 client\nint64 number\n"

SERVICE_TYPES = {
    "nav2_msgs/NavigateToPose_SendGoal_Request": (
        "action",
        "unique_identifier_msgs/UUID goal_id\n"
        "geometry_msgs/PoseStamped pose\n"
        "string behavior_tree\n",
    ),
    "nav2_msgs/NavigateToPose_SendGoal_Response": (
        "action",
        "bool accepted\nbuiltin_interfaces/Time stamp\n",
    ),
    "action_msgs/CancelGoal_Request": ("srv", "action_msgs/GoalInfo goal_info\n"),
}
"""Where ROS 2 declares the type, and its definition after the header, by its name."""
