"""Everything that moves besides the robot."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import shapely

from semnav_env.robots import RobotSpec
from semnav_env.world.dynamics.body_row import as_body
from semnav_env.world.dynamics.crowd import Crowd
from semnav_env.world.dynamics.doors import AWAY, SwingingDoors
from semnav_env.world.dynamics.leaves import PlanLeaf, swinging_leaves
from semnav_env.world.dynamics.settings import MAX_SPEED_FACTOR, Dynamics
from semnav_env.world.dynamics.social import SocialRecord, gaps
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.placement import footprint
from semnav_features.frames import FloatArray, Point, Pose, Twist
from semnav_features.validation import require

BOX_CLEARANCE = 0.05
"""Space that is left free around a box that is put down by hand, metres."""

SIDES = 4
"""Segments of a box."""


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
        buffers: discs and segments as a lidar reads them, which may take what is added by hand;
            always the same arrays. What is not there yet is far away.
        record: gaps and times to collision between people and robot.
    """

    def __init__(
        self, plan: FloorPlan, robot: RobotSpec, dynamics: Dynamics, seconds: float
    ) -> None:
        leaves, self.still = swinging_leaves(plan) if dynamics.changing_doors else ((), plan)
        self.crowd = Crowd(plan, self.still, dynamics)
        self.doors = SwingingDoors(leaves, dynamics, SIDES * dynamics.by_hand)
        discs = np.full((dynamics.pedestrians + dynamics.by_hand, 3), AWAY)
        discs[:, 2] = dynamics.walking.radius
        self.buffers = discs, self.doors.segments
        self._plan, self._boxes, self._by_hand = plan, 0, dynamics.by_hand
        self.record = SocialRecord()
        self._robot, self._seconds = robot, seconds
        self._radius = dynamics.walking.radius
        fastest = dynamics.walking.speed + 2.0 * dynamics.walking.spread
        self._guard = seconds * (_max_point_speed(robot) + MAX_SPEED_FACTOR * fastest) + 0.05

    @property
    def discs(self) -> FloatArray:
        """x, y and radius of each person, metres, shape (n, 3)."""
        return self.buffers[0][: len(self.crowd.places)]

    @property
    def shapes(self) -> tuple[FloatArray, FloatArray]:
        """Discs, shape (n, 3), and leaves and sides of boxes, shape (m, 4)."""
        return self.discs, self.doors.segments[: len(self.doors.leaves) + SIDES * self._boxes]

    def add_person(self, place: Point, robot: Pose) -> None:
        """Let one more person walk from a place, until the next episode; see `World.add_person`."""
        count = len(self.crowd.places)
        require(count < len(self.buffers[0]), "people", count + 1, f"at most {count} in this run")
        apart = shapely.distance(shapely.Point(place), _lines(self.doors.segments))
        free = apart.min(initial=math.inf) > self._radius + BOX_CLEARANCE
        require(free, "person", place, "a place that no box and no leaf takes")
        self.crowd.add(place, robot)
        self.discs[:, :2] = self.crowd.places

    def add_box(self, outline: FloatArray, robot: Pose) -> None:
        """Put down a box until the next episode; see `World.add_box`."""
        at_most = f"at most {self._by_hand} in a run"
        require(self._boxes < self._by_hand, "boxes", self._boxes + 1, at_most)
        box, where = shapely.Polygon(outline), tuple(outline.mean(axis=0).round(2).tolist())
        require(self._plan.boundary.covers(box), "box", where, "inside the floor plan")
        near = shapely.distance(box, footprint(self._robot, robot))
        require(near > BOX_CLEARANCE, "box", where, "beside the robot, not on it")
        people = shapely.distance(box, shapely.points(self.crowd.places)).min(initial=math.inf)
        require(people > self._radius + BOX_CLEARANCE, "box", where, "where nobody stands")
        for leaf in self.doors.leaves:
            swings = shapely.distance(box, _swept(leaf)) < BOX_CLEARANCE
            require(not swings, "box", where, f"out of the way of the leaf of door {leaf.door}")
        row = len(self.doors.leaves) + SIDES * self._boxes
        self.doors.segments[row : row + SIDES] = np.hstack((outline, np.roll(outline, -1, axis=0)))
        self._boxes += 1

    def begin(self, start: Pose, seed: int) -> None:
        """Begin an episode with the robot at `start`."""
        people, doors = np.random.default_rng(seed).spawn(2)
        self.doors.begin(doors)
        self.crowd.begin(start, people)
        self.buffers[0][:, :2], self._boxes = AWAY, 0
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
        leaves = _lines(self.doors.segments)
        return float(
            min(
                people, shapely.distance(footprint(self._robot, pose), leaves).min(initial=math.inf)
            )
        )


def _lines(segments: FloatArray) -> Any:
    """The segments as lines, shape (m,)."""
    return shapely.linestrings(segments.reshape(-1, 2, 2))


def _swept(leaf: PlanLeaf) -> shapely.Polygon:
    """The sector over which a leaf swings."""
    return shapely.Polygon([leaf.hinge, *map(leaf.tip, np.linspace(0.0, leaf.swing, 9).tolist())])


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
