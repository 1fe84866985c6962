"""Everything that moves besides the robot."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import shapely

from semnav_env.robots import RobotSpec
from semnav_env.world.dynamics.body_row import as_body
from semnav_env.world.dynamics.boxes import (
    BOX_CLEARANCE,
    SIDES,
    box_corners,
    box_sides,
    check_box_place,
)
from semnav_env.world.dynamics.crowd import Crowd
from semnav_env.world.dynamics.doors import SwingingDoors
from semnav_env.world.dynamics.leaves import swinging_leaves
from semnav_env.world.dynamics.settings import AWAY, MAX_SPEED_FACTOR, Dynamics
from semnav_env.world.dynamics.social import SocialRecord, gaps
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.placement import footprint
from semnav_features.frames import FloatArray, Point, Pose, Twist
from semnav_features.validation import require


class Moving:
    """People, leaves, and boxes that were put down by hand in a floor plan.

    Their motion follows from seed, start, the robot's motion and what was added by hand alone.

    Args:
        plan: the plan with its doors as they stand at first.
        robot: the body that they keep away from.
        dynamics: settings of what moves.
        seconds: length of a time step.

    Attributes:
        still: the plan without what can move.
        crowd: the people.
        doors: the leaves.
        buffers: discs and segments as a lidar reads them, with rows for what may be added by hand;
            always the same arrays. What is not there yet is `AWAY`.
        record: gaps and times to collision between people and robot.
    """

    def __init__(
        self, plan: FloorPlan, robot: RobotSpec, dynamics: Dynamics, seconds: float
    ) -> None:
        leaves, self.still = swinging_leaves(plan) if dynamics.changing_doors else ((), plan)
        self.crowd = Crowd(plan, self.still, dynamics)
        self.doors = SwingingDoors(leaves, dynamics)
        self._dynamics, self._boxes = dynamics, 0
        discs = np.full((dynamics.pedestrians + dynamics.by_hand, 3), AWAY)
        discs[:, 2] = self._radius = dynamics.walking.radius
        self.buffers = discs, np.full((len(leaves) + SIDES * dynamics.by_hand, 4), AWAY)
        self._show()
        self.record = SocialRecord()
        self._robot, self._seconds = robot, seconds
        fastest = dynamics.walking.speed + 2.0 * dynamics.walking.spread
        self._guard = seconds * (_max_point_speed(robot) + MAX_SPEED_FACTOR * fastest) + 0.05

    def _show(self) -> None:
        """Write where people and leaves are into the buffers."""
        self.discs[:, :2] = self.crowd.places
        self.buffers[1][: len(self.doors.leaves)] = self.doors.segments

    @property
    def discs(self) -> FloatArray:
        """x, y and radius of each person, metres, shape (n, 3)."""
        return self.buffers[0][: len(self.crowd.places)]

    @property
    def segments(self) -> FloatArray:
        """Leaves, then sides of boxes, as x1, y1, x2, y2, metres, shape (m, 4)."""
        return self.buffers[1][: len(self.doors.leaves) + SIDES * self._boxes]

    def add_person(self, place: Point, robot: Pose) -> None:
        """Let one more person walk from a place, until the next episode; see `World.add_person`."""
        self._check_room("people", len(self.crowd.places) - self._dynamics.pedestrians)
        apart = shapely.distance(shapely.Point(place), _lines(self.segments))
        free = apart.min(initial=math.inf) > self._radius + BOX_CLEARANCE
        require(free, "person", place, "a place that no box and no leaf takes")
        self.crowd.add(place, robot)
        self._show()

    def add_box(self, middle: Point, robot: Pose) -> None:
        """Put down a box until the next episode; see `World.add_box`."""
        self._check_room("boxes", self._boxes)
        check_box_place(self.still, middle)
        box = shapely.Polygon(box_corners(middle))
        near = shapely.distance(box, footprint(self._robot, robot))
        require(near > BOX_CLEARANCE, "box", middle, "beside the robot, not on it")
        people = shapely.distance(box, shapely.points(self.crowd.places)).min(initial=math.inf)
        require(people > self._radius + BOX_CLEARANCE, "box", middle, "where nobody stands")
        boxes = _lines(self.segments[len(self.doors.leaves) :])
        apart = shapely.distance(box, boxes).min(initial=math.inf) > BOX_CLEARANCE
        require(apart, "box", middle, "beside the other boxes")
        for leaf in self.doors.leaves:
            swings = shapely.distance(box, leaf.swept) < BOX_CLEARANCE
            require(not swings, "box", middle, f"out of the way of the leaf of door {leaf.door}")
        self._boxes += 1
        self.segments[-SIDES:] = box_sides(middle)

    def check_robot(self, pose: Pose) -> None:
        """Refuse a place where the robot would touch somebody or something that moves."""
        free = self.clearance(pose) > BOX_CLEARANCE
        require(free, "pose", pose, "where no person, leaf or box of this episode is")

    def _check_room(self, what: str, added: int) -> None:
        most = self._dynamics.by_hand
        require(added < most, f"{what} added by hand", added + 1, f"at most {most}")

    def begin(self, start: Pose, seed: int) -> None:
        """Begin an episode with the robot at `start`."""
        people, doors = np.random.default_rng(seed).spawn(2)
        self.doors.begin(doors)
        self.crowd.begin(start, people)
        self._boxes = 0
        self.buffers[0][:, :2] = self.buffers[1][:] = AWAY
        self._show()
        self.record.begin()

    def step(self, pose: Pose, velocity: Twist) -> None:
        """Move on by a time step.

        Args:
            pose: pose of the robot's centre, world frame.
            velocity: forward, left (m/s) and yaw rate (rad/s), robot frame.
        """
        body = as_body(self._robot, pose, velocity)
        touch = _step_length(self._robot, velocity, self._seconds)
        self.crowd.step(body, self.segments, self._guard, touch, self._seconds)
        self.doors.step(self._seconds, self.crowd.places, self._radius, body, self._guard)
        self._show()

    def note(self, pose: Pose, velocity: Twist) -> None:
        """Record the present gaps between people and robot."""
        body = as_body(self._robot, pose, velocity)
        self.record.note(body, self.discs, self.crowd.velocities, self._seconds)

    def clearance(self, pose: Pose) -> float:
        """Distance from the footprint at `pose` to the nearest person, leaf or box, metres."""
        body = as_body(self._robot, pose, (0.0, 0.0, 0.0))
        people = gaps(body, self.discs).min(initial=math.inf)
        apart = shapely.distance(footprint(self._robot, pose), _lines(self.segments))
        return float(min(people, apart.min(initial=math.inf)))


def _lines(segments: FloatArray) -> Any:
    """The segments as lines, shape (m,)."""
    return shapely.linestrings(segments.reshape(-1, 2, 2))


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
