"""A stand-in for nav2 and move_base in the simulator: drives to goals by what its lidar sees."""

from __future__ import annotations

import math

from semnav_agents.scripted import ScriptedAgent
from semnav_env.language import encode
from semnav_env.mind.belief import BeliefTracker
from semnav_env.mind.grounding import GoalKind
from semnav_env.mind.observations import Moment, SeenGoal
from semnav_env.robots import RobotSpec
from semnav_env.robots.actions import Actions
from semnav_features.frames import Pose, Twist, relative, wrap_angle
from semnav_features.lidar_spec import LidarSpec
from semnav_ros.command_drive import WARM_UP
from semnav_ros.goal_state import GoalState
from semnav_ros.messages import OdometryMessage, ScanMessage

NEAR, TURNED = 0.25, 0.25
"""Largest distance and heading error at a goal that is reached, metres and radians: the defaults of
nav2's goal checker."""

STILL: Twist = (0.0, 0.0, 0.0)


class SimulatedNavigator:
    """Plans to a goal as the scripted agent does, and knows no command.

    Args:
        robot: the body, with the lidar on its mount; its base frame lies in its middle.
        lidar: its lidar.

    Attributes:
        goal: pose of the base frame, odometry frame; None without one.
        state: what has become of the last goal.
    """

    def __init__(self, robot: RobotSpec, lidar: LidarSpec) -> None:
        self._tracker = BeliefTracker(lidar, robot.lidar_mount)
        self._agent, self._actions = ScriptedAgent(), Actions(robot)
        self._agent.observation.space(robot, lidar)
        self._info = {"robot": vars(robot).copy(), "lidar": vars(lidar).copy()}
        self._start: Pose | None = None
        self.goal: Pose | None = None
        self.state = GoalState.CANCELLED

    def take(self, goal: Pose | None) -> None:
        """Take a goal; None calls the last one back."""
        if goal is None:
            self.state = GoalState.CANCELLED
        elif self.goal is None:
            self.state = GoalState.DRIVING
        self.goal = goal

    def velocity(self, scan: ScanMessage, odometry: OdometryMessage) -> Twist:
        """The velocity that leads to the goal; zero without one."""
        if self._start is None:
            self._start = odometry.pose
            self._tracker.begin(WARM_UP)
            self._agent.reset(self._info)
        self._tracker.update(scan.ranges, relative(self._start, odometry.pose))
        if self.goal is None:
            return STILL
        goal = relative(odometry.pose, self.goal)
        if math.hypot(*goal[:2]) < NEAR and abs(wrap_angle(goal[2])) < TURNED:
            self.goal, self.state = None, GoalState.REACHED
            return STILL
        moment = Moment(self._tracker, encode(WARM_UP), str(WARM_UP))
        observation = self._agent.observation.observe(moment)
        observation["goal"] = SeenGoal(GoalKind.REACH, goal, None).values
        return self._actions.twist(self._agent.act(observation))
