"""A robot without physics, for tests of planning: exact footprints, limited acceleration."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import shapely

from semnav_agents.planning.doorway import target_behind
from semnav_agents.planning.driver import Driver
from semnav_agents.planning.obstacles import ObstacleMemory, points_of_segments
from semnav_agents.planning.planner import DriveTarget
from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray, Pose, compose, points_to_parent, relative
from semnav_features.scene import Door
from tests.support.raycaster import heidelberg, polygon, polyline, scan_of

PERIOD, SUBSTEPS = 1.0 / 15.0, 4


def around(start: Pose, rng: np.random.Generator) -> Pose:
    """A start up to 0.2 m and 0.2 rad off."""
    x, y, heading = (np.array(start) + rng.uniform(-0.2, 0.2, 3)).tolist()
    return x, y, heading


def footprint(robot: RobotSpec, pose: Pose) -> shapely.Polygon:
    half = np.array([robot.length, robot.width]) / 2
    corners = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]) * half
    return shapely.Polygon(points_to_parent(pose, corners))


@dataclass
class Kinematics:
    """A robot among segments (n, 2, 2), with odometry that drifts by a share of each motion."""

    segments: FloatArray
    robot: RobotSpec
    pose: Pose
    rng: np.random.Generator
    drift: float = 0.0

    def __post_init__(self) -> None:
        self.odom = self.pose
        self.velocity = np.zeros(3)
        self.clearance, self.seconds = math.inf, 0.0
        self._walls = shapely.MultiLineString(list(self.segments))
        self._scale = 1.0 + self.rng.uniform(-self.drift, self.drift, 2)
        self._bend = self.rng.uniform(-self.drift, self.drift) / 2

    def step(self, command: tuple[float, float, float]) -> None:
        self.seconds += PERIOD
        robot = self.robot
        most = np.array([robot.max_speed, robot.max_sideways_speed, robot.max_turn_rate])
        gain = np.array([robot.max_acceleration] * 2 + [robot.max_turn_acceleration])
        gain *= PERIOD / SUBSTEPS
        for _ in range(SUBSTEPS):
            wanted = np.clip(command, -most, most)
            self.velocity = self.velocity + np.clip(wanted - self.velocity, -gain, gain)
            self._move(self.velocity * PERIOD / SUBSTEPS)
        body = footprint(robot, self.pose)
        self.clearance = min(self.clearance, shapely.distance(body, self._walls))

    def _move(self, moved: FloatArray) -> None:
        forward, left, turn = moved.tolist()
        self.pose = self._after(self.pose, forward, left, turn)
        noise = 1.0 + self.drift * self.rng.normal(size=2)
        bend = self._bend * math.hypot(forward, left)
        along, across = np.array([forward, left]) * self._scale[0] * noise[0]
        self.odom = self._after(self.odom, along, across, turn * self._scale[1] * noise[1] + bend)

    def _after(self, pose: Pose, forward: float, left: float, turn: float) -> Pose:
        axle = compose(pose, (self.robot.axle, 0.0, 0.0))
        c, s = math.cos(turn / 2), math.sin(turn / 2)
        axle = compose(axle, (c * forward - s * left, s * forward + c * left, turn))
        return compose(axle, (-self.robot.axle, 0.0, 0.0))


@dataclass(frozen=True)
class Drive:
    """What came of a drive."""

    arrived: bool
    clearance: float
    deviation: float
    plans: int
    pose: Pose
    seconds: float


def drive_knowing(
    segments: FloatArray, robot: RobotSpec, start: Pose, target: DriveTarget, steps: int = 700
) -> Drive:
    """Drive with the true pose and all obstacles known."""
    world = Kinematics(segments, robot, start, np.random.default_rng(0))
    driver, points = Driver(robot), points_of_segments(segments.reshape(-1, 4))
    deviation = 0.0
    for _ in range(steps):
        steering = driver.drive(points, target, world.pose, tuple(world.velocity.tolist()))
        deviation = max(deviation, steering.deviation)
        if steering.done:
            break
        world.step(steering.twist)
    arrived = steering.done
    return Drive(arrived, world.clearance, deviation, driver.plans, world.pose, world.seconds)


def drive_seeing(
    segments: FloatArray,
    robot: RobotSpec,
    start: Pose,
    target: DriveTarget,
    rng: np.random.Generator,
    steps: int = 900,
) -> Drive:
    """Drive by drifting odometry and a noisy lidar; the target is seen while it is not behind."""
    world = Kinematics(segments, robot, start, rng, drift=0.015)
    driver, memory, deviation = Driver(robot), ObstacleMemory(), 0.0
    mount, seen = robot.lidar_mount, target
    for _ in range(steps):
        scan = scan_of(segments, compose(world.pose, mount), sigma=0.02, rng=rng)
        directions = np.stack((np.cos(scan.angles), np.sin(scan.angles)), axis=1)
        memory.update(compose(world.odom, mount), scan.ranges, directions, scan.range_max)
        place = relative(world.pose, target.pose)
        if abs(math.atan2(place[1], place[0])) < 2.3:
            pose = compose(world.odom, place)
            seen = DriveTarget(pose, target.position_tolerance, target.heading_tolerance)
        velocity = tuple(world.velocity.tolist())
        steering = driver.drive(memory.points(), seen, world.odom, velocity)
        deviation = max(deviation, steering.deviation)
        if steering.done:
            break
        world.step(steering.twist)
    arrived = steering.done
    return Drive(arrived, world.clearance, deviation, driver.plans, world.pose, world.seconds)


def corridor_with_door(width: float, door: float) -> tuple[FloatArray, Door]:
    """A corridor along x with a door from (4, width) on its left into a room, and the door."""
    end = 4.0 + door
    walls = [
        polyline((-3.0, 0.0), (9.0, 0.0), (9.0, width), (end, width)),
        polyline((4.0, width), (-3.0, width), (-3.0, 0.0)),
        polyline((4.0, width), (4.0, width + 0.1), (2.0, width + 0.1), (2.0, width + 4.0)),
        polyline((2.0, width + 4.0), (8.0, width + 4.0), (8.0, width + 0.1), (end, width + 0.1)),
        polyline((end, width + 0.1), (end, width)),
    ]
    return np.concatenate(walls), Door((4.0, width), (end, width))


def room_with_pillar() -> FloatArray:
    """A room of 6 by 4 m with a pillar of 0.6 m in its middle."""
    room = polygon((0.0, 0.0), (6.0, 0.0), (6.0, 4.0), (0.0, 4.0))
    return np.concatenate((room, polygon((2.7, 1.7), (3.3, 1.7), (3.3, 2.3), (2.7, 2.3))))


HALLWAY_STARTS = {
    "north": (-1.0, 1.0, 1.9),
    "south_1": (-2.5, -0.3, 0.24),
    "south_2": (-2.5, -0.3, 0.24),
    "south_3": (-2.5, -0.3, 0.24),
}


def hallway_task(name: str) -> tuple[FloatArray, Pose, DriveTarget]:
    """The corridor, where to start for a door of it, and the target behind that door."""
    segments, doors = heidelberg()
    start = HALLWAY_STARTS[name]
    jambs = doors[name].tolist()
    return segments, start, target_behind(Door(tuple(jambs[0]), tuple(jambs[1])), start[:2])
