"""`semnav simulate`: the simulator as a robot that publishes scans and obeys velocities."""

from __future__ import annotations

import json
import time
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from tyro.conf import Positional

from semnav_ros.opening import NavigatorKind, WireName, open_navigator_server, open_wire
from semnav_ros.robot_shell import RobotShell
from semnav_ros.simulated_robot import SimulatedRobot
from semnav_ros.topics import NodeTopics
from semnav_scripts.arguments import OptionalText, parse_pose
from semnav_scripts.node import renamings


@dataclass(frozen=True)
class Arguments:
    """Let the simulator be a robot, to try `semnav node` and nodes of yours with.

    It publishes scan, odom, tf_static and semnav/bumps, and obeys cmd_vel. It hears the commands on
    semnav/command, too: the first that it understands begins an episode, and the judge says in the
    end whether it was carried out, and how long the velocities took to come after the scans. The
    exit code is 0 if the command was carried out, and 1 if not.

    Attributes:
        command: told on that topic as soon as a node listens; by somebody else if not given.
        over: what carries the messages: ros1 (rospy), ros2 (rclpy), or dds, which talks to ROS 2
            without ROS.
        map: a floor plan: a name (office_cross, or office:medium:17, generated) or a path.
        robot: wheelchair or spot.
        pose: start pose of the robot, x,y,heading in metres and radians; random if not given.
        seed: seed of everything that is random.
        speed: simulated seconds a second, at most.
        lockstep: let simulated time stand still until the node has answered a scan, so that a
            machine that is busy drives as well as another.
        seconds: give up after this time.
        topics: other names of topics, such as scan=/front/scan.
        navigator: be a navigator, too, for `semnav node --navigator`: action stands in for nav2
            (dds) or move_base (ros1), topic hears goal_pose.
        action: name of the action; navigate_to_pose, or move_base in ROS 1, if not given.
    """

    command: Positional[str | None] = None
    over: WireName = "ros2"
    map: str = "heidelberg_hallway"
    robot: str = "wheelchair"
    pose: OptionalText = None
    seed: int = 0
    speed: float = 1.0
    lockstep: bool = False
    seconds: float = 3600.0
    topics: tuple[str, ...] = field(default=())
    navigator: NavigatorKind | None = None
    action: OptionalText = None

    def run(self) -> int:
        """Run until the judge has said its verdict, or time is up."""
        if not 0.1 <= self.speed <= 10.0:
            raise ValueError(f"--speed is {self.speed:g}; it must lie in 0.1 to 10")
        if self.lockstep and self.navigator is not None:
            raise ValueError("--lockstep waits for velocities; with --navigator leave it out")
        topics = NodeTopics().renamed(renamings(self.topics))
        pose = None if self.pose is None else parse_pose(self.pose)
        wire = open_wire(self.over, "semnav_robot")
        try:
            robot = SimulatedRobot(self.map, self.robot, pose, self.seed)
            if self.command is not None:
                robot.read(self.command)  # refused now, and not when a node listens
            navigator, server = None, None
            if self.navigator is not None:
                navigator = robot.navigator
                heard = topics, navigator.take, self.action
                server = open_navigator_server(self.navigator, wire, *heard)
            told = self.speed, self.lockstep, navigator, server, partial(print, flush=True)
            shell = RobotShell(robot, wire, topics, *told)
            print(self._waits_for(), flush=True)
            end = time.monotonic() + self.seconds
            outcome = shell.run(lambda: time.monotonic() < end, self.command)
        finally:
            wire.close()
        if outcome is None:
            print("no verdict")
            return 1
        kept = {name: outcome[name] for name in ("verdicts", "is_success", "collisions")}
        if shell.delays:
            shares = np.percentile(shell.delays, (50, 99)) * 1e3
            kept |= {"delay_ms": dict(zip(("median", "99 of 100"), shares.round(1), strict=True))}
        print(json.dumps(kept, default=str), flush=True)
        return 0 if outcome["is_success"] else 1

    def _waits_for(self) -> str:
        """What the robot waits for, in words."""
        if self.command is None:
            return "publishing; tell a command on semnav/command"
        return f"publishing; the command waits for a node: semnav node --over {self.over}"
