"""`semnav node`: the node of a robot of yours, by ROS 1, ROS 2 or DDS."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass, field
from pathlib import Path

from semnav_ros.messages import NodeReply, Phase
from semnav_ros.node_shell import NodeShell
from semnav_ros.opening import NavigatorKind, WireName, open_navigator, open_wire
from semnav_ros.robot_node import RobotNode
from semnav_ros.topics import NodeTopics
from semnav_scripts.arguments import OptionalText, parse_pose

LAUNCH_FILES = Path(__file__).parent / "launch"
"""A package of ROS 1, and what `ros2 launch` takes."""


@dataclass(frozen=True)
class Arguments:
    """Carry out spoken commands on a robot that publishes scans and odometry.

    It hears scan, odom, tf_static, semnav/command and semnav/stop, and says cmd_vel, semnav/status,
    semnav/said (questions and refusals), semnav/belief, semnav/goal and semnav/markers;
    docs/guides/ros.md tells the types. Nothing moves before a command, nor without a scan of the
    last 0.5 s.

    Attributes:
        over: what carries the messages: ros1 (rospy), ros2 (rclpy), or dds, which talks to ROS 2
            without ROS.
        robot: wheelchair or spot.
        agent: scripted, drive, listener, listener_drives, the folder of a trained agent, or
            package.module:Class.
        mount: pose of the lidar in the base frame, x,y,heading in metres and radians; from the
            fixed transforms if not given.
        base: x of the base frame in the robot frame, whose origin is the middle of the body.
        base_frame: name of the base frame.
        language: of the commands: en or de; recognised if not given.
        navigator: say goals to the robot's navigator and no velocities: action is nav2's
            NavigateToPose, or move_base in ROS 1, and topic is goal_pose for any other; the agent
            drives if not given.
        action: name of the action; navigate_to_pose, or move_base in ROS 1, if not given.
        topics: other names of topics, such as scan=/front/scan cmd_vel=/nav_vel.
        json: print each change of the status as JSON.
        launch_files: print the folder of the launch files of ROS 1 and ROS 2, and end; in ROS 1 add
            it to ROS_PACKAGE_PATH.
    """

    over: WireName = "ros2"
    robot: str = "wheelchair"
    agent: str = "scripted"
    mount: OptionalText = None
    base: float = 0.0
    base_frame: str = "base_link"
    language: OptionalText = None
    navigator: NavigatorKind | None = None
    action: OptionalText = None
    topics: tuple[str, ...] = field(default=())
    json: bool = False
    launch_files: bool = False

    def run(self) -> int:
        """Run until interrupted."""
        if self.launch_files:
            print(LAUNCH_FILES)
            return 0
        topics = NodeTopics().renamed(renamings(self.topics))
        mount = None if self.mount is None else parse_pose(self.mount)
        wire = open_wire(self.over, "semnav")  # first, for what is missing is then said at once
        try:
            navigator = None
            if self.navigator is not None:
                navigator = open_navigator(self.navigator, wire, topics, self.action)
            agent = self.agent if navigator is None else None
            node = RobotNode(self.robot, agent, mount, self.base, self.base_frame, self.language)
            NodeShell(node, wire, topics, self._note, navigator).run()
        finally:
            wire.close()
        return 0

    def _note(self, reply: NodeReply) -> None:
        status = reply.status
        if self.json:
            print(json.dumps(asdict(status) | {"said": reply.said}), flush=True)
            return
        line = str(status.phase)
        if status.phase in (Phase.RUNNING, Phase.IMPOSSIBLE) and status.clauses:
            line += f", clause {status.clause + 1} of {len(status.clauses)}"
        parts = [line, *status.reasons, status.problem, reply.said]
        print("; ".join(part for part in parts if part), flush=True)


def renamings(words: tuple[str, ...]) -> dict[str, str]:
    """The names of topics that are written as topic=/name.

    Raises:
        ValueError: a word is something else.
    """
    pairs = [word.partition("=") for word in words]
    for name, sign, new in pairs:
        if not (name and sign and new.strip("/")):
            raise ValueError(f"--topics {name}{sign}{new}: write it as scan=/front/scan")
    return {name: new for name, _, new in pairs}
