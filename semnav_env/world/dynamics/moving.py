"""Everything that moves besides the robot."""

from __future__ import annotations

import math

import numpy as np
import shapely

from semnav_env.robots import RobotSpec
from semnav_env.world.dynamics.body_row import as_body
from semnav_env.world.dynamics.crowd import Crowd
from semnav_env.world.dynamics.doors import SwingingDoors
from semnav_env.world.dynamics.leaves import swinging_leaves
from semnav_env.world.dynamics.settings import MAX_SPEED_FACTOR, Dynamics
from semnav_env.world.dynamics.social import SocialRecord, gaps
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.placement import footprint
from semnav_features.frames import FloatArray, Pose, Twist


class Moving:
    """People and leaves in a floor plan.

    Their motion follows from seed, start and the robot's motion alone.

    Args:
        plan: the plan with its doors as they stand at first.
        robot: the body that they keep away from.
        dynamics: settings of what moves.
        seconds: length of a time step.

    Attributes:
        still: the plan without what can move.
        crowd: the people.
        doors: the leaves.
        discs: x, y and radius of each person, metres, shape (n, 3); always the same array.
        record: gaps and times to collision between people and robot.
    """

    def __init__(
        self, plan: FloorPlan, robot: RobotSpec, dynamics: Dynamics, seconds: float
    ) -> None:
        leaves, self.still = swinging_leaves(plan) if dynamics.changing_doors else ((), plan)
        self.crowd = Crowd(plan, self.still, dynamics)
        self.doors = SwingingDoors(leaves, dynamics)
        self.discs = np.full((dynamics.pedestrians, 3), dynamics.walking.radius)
        self.record = SocialRecord()
        self._robot, self._seconds = robot, seconds
        self._radius = dynamics.walking.radius
        fastest = dynamics.walking.speed + 2.0 * dynamics.walking.spread
        self._guard = seconds * (_max_point_speed(robot) + MAX_SPEED_FACTOR * fastest) + 0.05

    @property
    def shapes(self) -> tuple[FloatArray, FloatArray]:
        """Discs, shape (n, 3), and leaves, shape (m, 4), as a lidar takes them."""
        return self.discs, self.doors.segments

    def begin(self, start: Pose, seed: int) -> None:
        """Begin an episode with the robot at `start`."""
        people, doors = np.random.default_rng(seed).spawn(2)
        self.doors.begin(doors)
        self.crowd.begin(start, people)
        self.discs[:, :2] = self.crowd.places
        self.record.begin()

    def step(self, pose: Pose, velocity: Twist) -> None:
        """Move on by a time step.

        Args:
            pose: pose of the robot's centre, world frame.
            velocity: forward, left (m/s) and yaw rate (rad/s), robot frame.
        """
        body = as_body(self._robot, pose, velocity)
        touch = _step_length(self._robot, velocity, self._seconds)
        self.crowd.step(body, self.doors.segments, self._guard, touch, self._seconds)
        self.doors.step(self._seconds, self.crowd.places, self._radius, body, self._guard)
        self.discs[:, :2] = self.crowd.places

    def note(self, pose: Pose, velocity: Twist) -> None:
        """Record the present gaps between people and robot."""
        body = as_body(self._robot, pose, velocity)
        self.record.note(body, self.discs, self.crowd.velocities, self._seconds)

    def clearance(self, pose: Pose) -> float:
        """Distance from the footprint at `pose` to the nearest person or leaf, metres."""
        body = as_body(self._robot, pose, (0.0, 0.0, 0.0))
        people = gaps(body, self.discs).min(initial=math.inf)
        leaves = shapely.linestrings(self.doors.segments.reshape(-1, 2, 2))
        return float(
            min(
                people, shapely.distance(footprint(self._robot, pose), leaves).min(initial=math.inf)
            )
        )


def _turning_radius(robot: RobotSpec) -> float:
    """Distance from the axle to the farthest corner, metres."""
    return math.hypot(robot.length / 2 + abs(robot.axle), robot.width / 2)


def _max_point_speed(robot: RobotSpec) -> float:
    """Upper bound of the speed of any point of the body, m/s."""
    straight = math.hypot(robot.max_speed, robot.max_sideways_speed)
    return straight + robot.max_turn_rate * _turning_radius(robot)


def _step_length(robot: RobotSpec, velocity: Twist, seconds: float) -> float:
    """Upper bound of the motion of any point of the body in the next step, metres."""
    forward, left, yaw_rate = velocity
    gain = seconds * (robot.max_acceleration + robot.max_turn_acceleration * _turning_radius(robot))
    return (
        seconds * (math.hypot(forward, left) + abs(yaw_rate) * _turning_radius(robot) + gain) + 0.01
    )
