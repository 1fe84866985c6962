"""Turns a goal into actions, for the scripted agent and the oracle."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from semnav_agents.pilot_rules import (
    REACH_TOLERANCE,
    STUCK_STEPS,
    count_pushing,
    place_aim,
)
from semnav_agents.planning.door_aims import SAME_DOOR_DISTANCE, jambs_facing
from semnav_agents.planning.doorway import barriers_across
from semnav_agents.planning.driver import Driver
from semnav_agents.planning.exit_via_door import ExitViaDoor
from semnav_agents.planning.follower import Steering
from semnav_agents.planning.known_obstacles import (
    NO_POINTS,
    JoinedObstacles,
    Obstacles,
    PointObstacles,
    as_obstacles,
)
from semnav_agents.planning.planner import DriveTarget
from semnav_env.approach import DoorSide
from semnav_env.language.clauses import Speed
from semnav_env.mind.grounding import GoalKind
from semnav_env.mind.grounding.niches import MOST_ASIDE, NICHE_DEPTH
from semnav_env.mind.observations import SeenGoal
from semnav_env.robots import RobotSpec
from semnav_env.robots.actions import shares_of
from semnav_features.frames import (
    FloatArray,
    Pose,
    Twist,
    points_to_parent,
    to_parent,
)

BACKING_STEPS = 12
"""Steps for which a stuck robot backs out."""

BACKING_SPEED, BACKING_YAW_RATE = 0.2, 0.3
"""Velocity with which a stuck robot backs out, m/s and rad/s: slow, because it sees little
behind."""


class Pilot:
    """Drives a robot to goals with the footprint-aware planner.

    A robot that pushes without moving backs out along its own path and plans again. On its path to
    a goal it does not use other doors that it knows, so it takes no detour through the next room.

    Args:
        robot: the body.
        alternatives: whether to try other poses where no path leads straight through a door.

    Attributes:
        tolerance: distance at which a place to stop at counts as reached, metres.
    """

    def __init__(self, robot: RobotSpec, alternatives: bool = True) -> None:
        self.robot, self.tolerance = robot, REACH_TOLERANCE
        self.driver = Driver(robot)
        self._exit = ExitViaDoor(robot, alternatives)
        self._pushed = 0
        self._backing = 0
        self._last: Twist = (0.0, 0.0, 0.0)

    def act(
        self,
        points: FloatArray | Obstacles,
        doors: FloatArray,
        goal: SeenGoal,
        pose: Pose,
        velocity: Twist,
        moving: FloatArray = NO_POINTS,
        pace: Speed | None = None,
    ) -> NDArray[np.float32]:
        """The next action.

        Args:
            points: obstacles, or their points, shape (n, 2), in the frame of `pose`.
            doors: x and y of both jambs of the doors it knows, robot frame, shape (m, 4).
            goal: in the robot frame.
            pose: of the robot's centre.
            velocity: of the robot's centre.
            moving: obstacles that move, shape (m, 2), in the frame of `pose`.
            pace: how fast to drive, by what was said.
        """
        self.driver.take_pace(pace)
        if goal.kind is GoalKind.STOP:
            return self._action(0.0, 0.0, 0.0)
        if self._is_stuck(velocity):
            forward, left, yaw_rate = (-sign(speed) for speed in self._last)
            speed = BACKING_SPEED
            return self._action(speed * forward, speed * left, BACKING_YAW_RATE * yaw_rate)
        obstacles = as_obstacles(points)
        if goal.door is not None:
            jambs = np.array([to_parent(pose, jamb) for jamb in goal.door])
            obstacles = JoinedObstacles((obstacles, as_obstacles(jambs)))
        barriers = PointObstacles(lambda: self._barriers(doors, goal, pose))
        door = _side(goal, pose)
        target = self._target(goal, pose) if door is None else self._exit.target(door)
        steering = self.driver.drive(obstacles, target, pose, velocity, barriers, moving)
        if door is not None:
            self._note(steering, obstacles)
        self._last = steering.twist
        return self._action(*steering.twist)

    def put(self, record: Any) -> None:
        """Write what compiled code must know to drive on, see `cruise.CRUISE`."""
        self.driver.put(record)
        counts = record["counts"]
        if counts["ready"]:
            self._exit.put(record)
            counts["pushed"], counts["backing_out"] = self._pushed, self._backing
            record["last"] = self._last

    def take(self, record: Any) -> None:
        """Read what compiled code has changed."""
        self.driver.take(record)
        self._exit.take(record)
        self._pushed = int(record["counts"]["pushed"])
        forward, left, yaw_rate = record["last"].tolist()
        self._last = forward, left, yaw_rate

    def _barriers(self, doors: FloatArray, goal: SeenGoal, pose: Pose) -> FloatArray:
        """Points across the doors that are not the goal's, in the frame of `pose`."""
        return points_to_parent(pose, barriers_across(_other_doors(doors, goal), self.robot))

    def _target(self, goal: SeenGoal, pose: Pose) -> DriveTarget:
        """The drive target for a goal that is no door, in the frame of `pose`."""
        seeks = goal.kind is GoalKind.SEEK
        target = DriveTarget.of(place_aim(seeks, goal.pose, pose, float(self.robot.axle)))
        return target if seeks else replace(target, position_tolerance=self.tolerance)

    def _note(self, steering: Steering, obstacles: Obstacles) -> None:
        """Move on to the next pose through a door, or to another way if this one failed."""
        path = self.driver.path
        if path is not None and not path.complete:
            if self._exit.failed(obstacles, path.end):
                self.driver.plan_at_once()
        elif steering.done:
            self._exit.reached()

    def _is_stuck(self, velocity: Twist) -> bool:
        """Whether it is time to back out of a contact."""
        if self._backing > 0:
            self._backing -= 1
            return True
        self._pushed = count_pushing(self._pushed, self._last, velocity)
        if self._pushed >= STUCK_STEPS:
            self._pushed, self._backing = 0, BACKING_STEPS
            self.driver.reset()
        return self._backing > 0

    def _action(self, forward: float, left: float, yaw_rate: float) -> NDArray[np.float32]:
        """A twist as shares of the robot's limits."""
        return shares_of((forward, left, yaw_rate), self.robot)


def sign(value: float) -> float:
    """The sign of a value, -1, 0 or 1; below 0.01 in size it is 0."""
    return math.copysign(1.0, value) if abs(value) > 0.01 else 0.0


def _other_doors(doors: FloatArray, goal: SeenGoal) -> FloatArray:
    """The doors that are not the goal's, nor the mouth of the niche at whose back it lies."""
    if goal.door is None:
        return doors
    middles = (doors[:, :2] + doors[:, 2:]) / 2
    from_goal = middles - np.mean(goal.door, axis=0)
    others = np.hypot(*from_goal.T) > SAME_DOOR_DISTANCE
    if goal.kind is GoalKind.PASS:
        others &= ~_is_mouth(middles, from_goal, goal.pose[2])
    kept: FloatArray = doors[others]
    return kept


def _is_mouth(middles: FloatArray, from_goal: FloatArray, heading: float) -> NDArray[np.bool_]:
    """Whether each door lies between the robot and the goal's door, on the axis of that one.

    Args:
        middles: of the doors, robot frame, metres, shape (m, 2).
        from_goal: the same, seen from the middle of the goal's door.
        heading: through that door, radians.
    """
    axis = np.array((math.cos(heading), math.sin(heading)))
    behind, aside = from_goal @ axis, np.abs(from_goal @ (-axis[1], axis[0]))
    between = (middles @ axis > 0.0) & (behind < 0.0) & (behind > -NICHE_DEPTH)
    is_mouth: NDArray[np.bool_] = between & (aside < MOST_ASIDE)
    return is_mouth


def _side(goal: SeenGoal, pose: Pose) -> DoorSide | None:
    """The door to pass, from the side of the robot, in the frame of `pose`; None without one."""
    if goal.kind is not GoalKind.PASS or goal.door is None:
        return None
    start, end = (to_parent(pose, jamb) for jamb in goal.door)
    return DoorSide(*jambs_facing(start, end, pose[2] + goal.pose[2]))
