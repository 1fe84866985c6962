"""What the scripted agent and the oracle share: from a goal to an action."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_env.agents.planning.doorway import barriers_across, target_behind
from semnav_env.agents.planning.driver import NOTHING, Driver
from semnav_env.agents.planning.planner import Target
from semnav_env.features.frames import (
    FloatArray,
    Point,
    Pose,
    compose,
    points_to_parent,
    to_parent,
)
from semnav_env.features.scene import Door
from semnav_env.grounding import GoalKind
from semnav_env.observations import SeenGoal
from semnav_env.robots import RobotSpec

STUCK_AFTER, FREE_AFTER = 8, 12
"""Steps of pushing without moving after which the robot is stuck, and of backing out of it."""


SAME_DOOR = 0.5
"""Doors whose middles are nearer than this are one, metres."""


class Pilot:
    """Drives a robot to goals with the footprint-aware planner.

    A robot that pushes without moving backs out the way it came and plans anew. It takes no way
    around through the next room, by doors that it knows and that are not its goal's.

    Args:
        robot: the body.
    """

    def __init__(self, robot: RobotSpec) -> None:
        self.robot = robot
        self.driver = Driver(robot)
        self._pushed = 0
        self._backing = 0
        self._last: Pose = (0.0, 0.0, 0.0)

    def act(
        self, points: FloatArray, doors: FloatArray, goal: SeenGoal, pose: Pose, velocity: Pose
    ) -> NDArray[np.float32]:
        """The next action.

        Args:
            points: obstacles, shape (n, 2), in the frame of `pose`.
            doors: x and y of the jambs of the doors it knows, robot frame, shape (m, 4).
            goal: in the robot frame.
            pose: of the robot's centre.
            velocity: forward, left (m/s) and turning (rad/s), robot frame.
        """
        if goal.kind is GoalKind.STOP:
            return self._action(0.0, 0.0, 0.0)
        if self._is_stuck(velocity):
            forward, left, turn = self._last
            return self._action(-0.2 * sign(forward), -0.2 * sign(left), -0.3 * sign(turn))
        if goal.door is not None:
            points = np.vstack((points, [to_parent(pose, jamb) for jamb in goal.door]))
        barriers = NOTHING
        if goal.kind is not GoalKind.SEEK:  # where the goal is no place, doors may be none either
            others = barriers_across(_other_doors(doors, goal), self.robot)
            barriers = points_to_parent(pose, others)
        steering = self.driver.drive(points, _target(goal, pose), pose, velocity, barriers)
        self._last = steering.command
        return self._action(*steering.command)

    def _is_stuck(self, velocity: Pose) -> bool:
        """Whether it is time to back out of a contact."""
        if self._backing > 0:
            self._backing -= 1
            return True
        pushing = max(map(abs, self._last)) > 0.03 and max(map(abs, velocity)) < 0.02
        self._pushed = self._pushed + 1 if pushing else 0
        if self._pushed >= STUCK_AFTER:
            self._pushed, self._backing = 0, FREE_AFTER
            self.driver.reset()
        return self._backing > 0

    def _action(self, forward: float, left: float, turn: float) -> NDArray[np.float32]:
        robot = self.robot
        shares = [forward / robot.max_speed, turn / robot.max_turn_rate]
        if robot.holonomic:
            shares.insert(1, left / robot.max_sideways_speed)
        return np.clip(np.array(shares, dtype=np.float32), -1.0, 1.0)


def sign(value: float) -> float:
    """-1, 0 or 1; what is almost nothing is 0."""
    return math.copysign(1.0, value) if abs(value) > 0.01 else 0.0


def _other_doors(doors: FloatArray, goal: SeenGoal) -> FloatArray:
    """The doors that are not the goal's."""
    if goal.door is None:
        return doors
    middles = (doors[:, :2] + doors[:, 2:]) / 2 - np.mean(goal.door, axis=0)
    others: FloatArray = doors[np.hypot(*middles.T) > SAME_DOOR]
    return others


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
