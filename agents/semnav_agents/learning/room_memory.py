"""How much room is around a robot, and how far it can move: from the obstacles it remembers.

A lidar in front sees nothing behind, where a robot turns and backs, and each of its ranges errs by
some centimetres. So obstacles are remembered in the odometry frame and averaged over many hits.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_agents.planning.motion import Move, moved
from semnav_agents.planning.obstacles import ObstacleMemory
from semnav_env.robots import RobotSpec
from semnav_features.frames import FloatArray, Pose, compose, points_to_local
from semnav_features.kernels.compiling import kernel
from semnav_features.lidar_spec import LidarSpec

SECTORS = 72
"""Directions around the robot for which there is a clearance: 5 degrees each."""

NO_HIT = 10.0
"""Clearance of a direction in which nothing is known, metres."""

SWEEP_STEP, DEEPER = 0.05, 0.004
"""Farthest that a part of the body moves between two tested poses; and how much deeper a point must
get into the body to stop a move, metres. A point that noise puts into it lets it move away."""

_CURVATURES = (0.0, 0.4, -0.4, 0.8, -0.8, 1.5, -1.5, 3.0, -3.0)
_ARCS = [(min(1.2, 1.6 / abs(k) if k else 1.2), k) for k in _CURVATURES]

PROBED_MOVES: FloatArray = np.array(
    [(sign * length, 0.0, sign * length * k) for sign in (1.0, -1.0) for length, k in _ARCS]
    + [(0.0, 0.0, math.pi / 2), (0.0, 0.0, -math.pi / 2), (0.0, 0.4, 0.0), (0.0, -0.4, 0.0)]
)
"""Moves of the axle (forward and left in metres, turn in radians) of which is told how much is
free: arcs of nine curvatures forward and backward, quarter turns on the spot, and sideways."""


class BodyShape(NamedTuple):
    """A footprint for kernels: half its length and width, and x of its axle, metres."""

    half_length: float
    half_width: float
    axle: float


class RoomAround(NamedTuple):
    """The room around a robot.

    Attributes:
        clearances: from the footprint to the nearest obstacle in each direction from its centre,
            metres, shape (`SECTORS`,), counter-clockwise; the first sector begins straight behind.
        free: which share of each of `PROBED_MOVES` is free, shape (22,).
    """

    clearances: NDArray[np.float32]
    free: NDArray[np.float32]


class RoomMemory:
    """The obstacles around one robot.

    Args:
        robot: its body.
        lidar: on it.

    Attributes:
        points: obstacles in the odometry frame, metres, shape (n, 2), as last taken in.
    """

    def __init__(self, robot: RobotSpec, lidar: LidarSpec) -> None:
        self._mount, self._range_max = robot.lidar_mount, lidar.range_max
        self._beams, self._shape = lidar.directions, body_shape(robot)
        self._memory = ObstacleMemory()
        self.forget()

    def forget(self) -> None:
        """Begin anew."""
        self._memory.reset()
        self.points: FloatArray = np.empty((0, 2))

    def take_in(self, pose: Pose, scan: NDArray[np.floating]) -> None:
        """Remember what a scan hit.

        Args:
            pose: of the robot, odometry frame.
            scan: ranges, metres.
        """
        self._memory.update(compose(pose, self._mount), scan, self._beams, self._range_max)
        self.points = self._memory.points()

    def room(self, pose: Pose, more: FloatArray) -> RoomAround:
        """The room around the robot.

        Args:
            pose: of the robot, odometry frame.
            more: other obstacles, robot frame, shape (n, 2).
        """
        points = np.vstack((points_to_local(pose, self.points), more))
        nearest = np.full(SECTORS, NO_HIT, np.float32)
        free = np.ones(len(PROBED_MOVES), np.float32)
        measure_room(points, self._shape, PROBED_MOVES, nearest, free)
        return RoomAround(nearest, free)


def body_shape(robot: RobotSpec) -> BodyShape:
    """The footprint of a robot."""
    return BodyShape(robot.length / 2, robot.width / 2, robot.axle)


@kernel
def measure_room(
    points: FloatArray,
    body: BodyShape,
    moves: FloatArray,
    nearest: NDArray[np.float32],
    free: NDArray[np.float32],
) -> None:
    """Measure the room around a robot.

    Args:
        points: obstacles, robot frame, shape (n, 2).
        body: its footprint.
        moves: of its axle, shape (m, 3).
        nearest: clearances, shape (`SECTORS`,); lowered.
        free: share of each move that is free, shape (m,); changed.
    """
    longest = 1.3 + math.hypot(body.half_length, body.half_width)
    near = np.empty((len(points), 3))
    count = 0
    for k in range(len(points)):
        x, y = points[k, 0], points[k, 1]
        ahead, aside = abs(x) - body.half_length, abs(y) - body.half_width
        clearance = math.hypot(max(ahead, 0.0), max(aside, 0.0))
        sector = int((math.atan2(y, x) + math.pi) * (SECTORS / math.tau)) % SECTORS
        nearest[sector] = min(nearest[sector], np.float32(clearance))
        if math.hypot(x, y) < longest:
            near[count, 0], near[count, 1], near[count, 2] = x, y, max(ahead, aside)
            count += 1
    for m in range(len(moves)):
        move = Move(moves[m, 0], moves[m, 1], moves[m, 2])
        free[m] = free_share(near[:count], body, move)


@kernel
def free_share(near: FloatArray, body: BodyShape, move: Move) -> float:
    """The share of a move of the axle that is free.

    Args:
        near: obstacles, robot frame: x, y, and by how much they lie outside the footprint (negative
            inside); shape (n, 3).
        body: the footprint.
        move: at constant twist.
    """
    reach = math.hypot(body.half_length + abs(body.axle), body.half_width)
    extent = math.hypot(move.forward, move.left) + reach * abs(move.turn)
    steps = max(1, math.ceil(extent / SWEEP_STEP))
    for k in range(1, steps + 1):
        x, y, heading = moved(body.axle, 0.0, 0.0, move, k / steps)
        c, s = math.cos(heading), math.sin(heading)
        x, y = x - c * body.axle, y - s * body.axle
        for p in range(len(near)):
            dx, dy = near[p, 0] - x, near[p, 1] - y
            aside = abs(c * dy - s * dx) - body.half_width
            if aside < 0.0:
                outside = max(abs(c * dx + s * dy) - body.half_length, aside)
                if outside < 0.0 and outside < near[p, 2] - DEEPER:
                    return (k - 1) / steps
    return 1.0
