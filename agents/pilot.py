"""What the scripted agent and the oracle share: from a goal to an action."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_env.agents.planning.doorway import target_behind
from semnav_env.agents.planning.driver import Driver
from semnav_env.agents.planning.planner import Target
from semnav_env.features.frames import FloatArray, Point, Pose, compose, to_parent
from semnav_env.features.scene import Door
from semnav_env.grounding import GoalKind
from semnav_env.observations import SeenGoal
from semnav_env.robots import RobotSpec


class Pilot:
    """Drives a robot to goals with the footprint-aware planner.

    Args:
        robot: the body.
    """

    def __init__(self, robot: RobotSpec) -> None:
        self.robot = robot
        self.driver = Driver(robot)

    def act(
        self, points: FloatArray, goal: SeenGoal, pose: Pose, velocity: Pose
    ) -> NDArray[np.float32]:
        """The next action.

        Args:
            points: obstacles, shape (n, 2), in the frame of `pose`.
            goal: in the robot frame.
            pose: of the robot's centre.
            velocity: forward, left (m/s) and turning (rad/s), robot frame.
        """
        if goal.kind is GoalKind.STOP:
            return self._action(0.0, 0.0, 0.0)
        steering = self.driver.drive(points, _target(goal, pose), pose, velocity)
        return self._action(*steering.command)

    def _action(self, forward: float, left: float, turn: float) -> NDArray[np.float32]:
        robot = self.robot
        shares = [forward / robot.max_speed, turn / robot.max_turn_rate]
        if robot.holonomic:
            shares.insert(1, left / robot.max_sideways_speed)
        return np.clip(np.array(shares, dtype=np.float32), -1.0, 1.0)


def _target(goal: SeenGoal, pose: Pose) -> Target:
    place = compose(pose, goal.pose)
    if goal.kind is GoalKind.PASS and goal.door is not None:
        start, end = (to_parent(pose, jamb) for jamb in goal.door)
        door = Door(start, end)
        return target_behind(door, _in_front(door.midpoint, place[2]))
    if goal.kind is GoalKind.SEEK:
        return Target(place, 0.4, None)
    return Target(place, 0.2, 0.15)


def _in_front(midpoint: Point, outward: float) -> Point:
    return midpoint[0] - math.cos(outward), midpoint[1] - math.sin(outward)
