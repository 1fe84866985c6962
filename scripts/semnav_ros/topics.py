"""The topics of the node, with their types and qualities of service."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace


@dataclass(frozen=True)
class Topic:
    """A topic.

    Attributes:
        name: without the slash at its beginning.
        kind: type of its messages, such as "std_msgs/String".
        depth: how many messages wait before the oldest is dropped.
        reliable: whether lost messages are sent again.
        latched: whether who comes late gets the last message (transient local in ROS 2).
        prefix: of the name in DDS, as ROS 2 has it: rt for a topic, rq and rr for the requests and
            the replies of a service.
    """

    name: str
    kind: str
    depth: int = 10
    reliable: bool = True
    latched: bool = False
    prefix: str = "rt"


@dataclass(frozen=True)
class NodeTopics:
    """All topics of the node. The first part is heard, the second is said.

    What is heard waits in this order: a stop goes before all else, odometry before its scan.
    `goal_pose` is said only to a navigator that hears goals there.
    """

    stop: Topic = Topic("semnav/stop", "std_msgs/Bool")
    command: Topic = Topic("semnav/command", "std_msgs/String")
    tf_static: Topic = Topic("tf_static", "tf2_msgs/TFMessage", 100, latched=True)
    odom: Topic = Topic("odom", "nav_msgs/Odometry", 50, reliable=False)
    bumps: Topic = Topic("semnav/bumps", "geometry_msgs/PoseArray", 1, reliable=False)
    scan: Topic = Topic("scan", "sensor_msgs/LaserScan", 1, reliable=False)

    cmd_vel: Topic = Topic("cmd_vel", "geometry_msgs/Twist", 1)
    status: Topic = Topic("semnav/status", "std_msgs/String", latched=True)
    said: Topic = Topic("semnav/said", "std_msgs/String", latched=True)
    belief: Topic = Topic("semnav/belief", "std_msgs/String", 1)
    goal: Topic = Topic("semnav/goal", "geometry_msgs/PoseStamped", 1)
    goal_pose: Topic = Topic("goal_pose", "geometry_msgs/PoseStamped", 1)
    markers: Topic = Topic("semnav/markers", "visualization_msgs/MarkerArray", 1)

    def renamed(self, names: dict[str, str]) -> NodeTopics:
        """The topics with other names, by the fields of this class.

        Raises:
            ValueError: there is no such topic; names those there are.
        """
        known = [field.name for field in fields(self)]
        for name in names:
            if name not in known:
                raise ValueError(f"no topic {name!r}; there are: {', '.join(known)}")
        changed = {
            key: replace(getattr(self, key), name=name.strip("/")) for key, name in names.items()
        }
        return replace(self, **changed)
