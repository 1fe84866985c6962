"""Targets for driving through a door, with alternatives (Mes 2021, 2.1 and 9.1.2)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import chain
from typing import Any

import numpy as np

from semnav_agents.planning.door_aims import (
    MAX_OBSTACLE_DISTANCE,
    aim_through,
    ends_at_door,
    is_same_door,
)
from semnav_agents.planning.known_obstacles import Obstacles, as_obstacles
from semnav_agents.planning.planner import DriveTarget
from semnav_env.approach import DoorSide, Surroundings, plan_approach
from semnav_env.approach.poses import is_behind
from semnav_env.robots import RobotSpec
from semnav_features.frames import ORIGIN, FloatArray, Point, Pose, compose, relative

POSES_TRIED = 6
"""Largest number of poses that are tried on either side of a door."""

POINT_RADIUS = 0.03
"""Radius of an obstacle point, metres: remembered ones are 5 cm apart."""

PAUSE = 30
"""Steps before all ways are tried again after the last one failed: a person may stand in the
door."""

WayThrough = tuple[Pose | None, ...]
"""Poses to drive to in turn, in the frame of the door; None for the region behind it."""


@dataclass
class ExitViaDoor:
    """Gives the targets that lead a robot through a door.

    The first is the region straight behind the door. If no path leads there, the poses behind the
    door are tried from best to worst, each forwards and then backwards; and then the poses before
    it, from each of which the robot goes on to those behind.

    Attributes:
        robot: the body.
        alternatives: whether to try other poses than the region behind the door.
    """

    robot: RobotSpec
    alternatives: bool = True
    _ways: Iterator[WayThrough] = field(default=iter(()), init=False)
    _way: WayThrough = field(default=(None,), init=False)
    _door: DoorSide | None = field(default=None, init=False)
    _middle: Point = field(default=(math.inf, math.inf), init=False)
    _pause: int = field(default=0, init=False)

    def target(self, side: DoorSide) -> DriveTarget:
        """The present target.

        Args:
            side: the door and the side from which it is passed, in any frame; a door that
                `is_same_door` as the last one is that one, better seen.
        """
        if not is_same_door(self._middle, side.middle):
            self._ways, self._way, self._pause = iter(()), (None,), 0
        self._door, self._middle = side, side.middle
        pose, last = self._way[0], len(self._way) == 1
        jambs, has_pose = (side.right, side.left), pose is not None
        aim = aim_through(*jambs, has_pose, pose or ORIGIN, float(self.robot.axle))
        return DriveTarget.of(aim, None if has_pose and not last else jambs)

    def put(self, record: Any) -> None:
        """Write what compiled code needs to know, see `cruise.CRUISE`."""
        pose = self._way[0]
        record["counts"]["knows_door"] = self._door is not None
        record["counts"]["aims_at_pose"] = pose is not None
        record["counts"]["tries_ways"] = self.alternatives
        record["door"] = (*self._middle, *(pose or ORIGIN))

    def take(self, record: Any) -> None:
        """Read where compiled code saw the door last."""
        x, y = record["door"][:2].tolist()
        self._middle = x, y

    def reached(self) -> None:
        """Move on to the next pose of the way; after the last one, begin again."""
        self._way = self._way[1:] or (None,)

    def failed(self, points: FloatArray | Obstacles, end: Pose) -> bool:
        """Give up the target, and choose the next way; returns whether there is one.

        Args:
            points: obstacles, or their points, shape (n, 2), in the frame of the door.
            end: where the path to the target ends before it, in that frame.
        """
        if self._door is None or not self.alternatives:
            return False
        if not ends_at_door(end[:2], self._door.middle):
            return False
        way = next(self._ways, None)
        if way is None and self._pause == 0:
            self._ways, self._pause = (
                _ways(self._door, as_obstacles(points).points(), self.robot),
                PAUSE,
            )
            way = next(self._ways)
        elif way is None:
            self._pause -= 1
        self._way = way or (None,)
        return way is not None


def _ways(side: DoorSide, points: FloatArray, robot: RobotSpec) -> Iterator[WayThrough]:
    """The ways through a door among obstacles, in the order in which they are tried."""
    near = points[np.hypot(*(points - side.middle).T) < MAX_OBSTACLE_DISTANCE]
    solid = Surroundings(np.empty((0, 4)), np.empty((0, 4))).with_points(near, POINT_RADIUS)
    behind = _poses(side.opposite, solid, robot)
    leaving = [
        local for pose in behind if is_behind(side, pose, robot) for local in _both(side, pose)
    ]
    before = [relative(side.frame, pose) for pose in _poses(side, solid, robot)]
    yield from ((pose,) for pose in leaving)
    yield from ((pose, None) for pose in before)
    yield from ((start, end) for start in before for end in leaving[:2])
    yield (None,)


def _poses(side: DoorSide, solid: Surroundings, robot: RobotSpec) -> list[Pose]:
    """Poses where the body is clear, the safe ones first; none at a door that is too narrow."""
    if side.width < robot.width:
        return []
    plan = plan_approach(side, solid, robot)
    others = (each.pose for each in plan.ranked if each.body_clear and not each.is_safe)
    return list(chain(plan.usable, others))[:POSES_TRIED]


def _both(side: DoorSide, pose: Pose) -> tuple[Pose, Pose]:
    """A pose behind the door for leaving forwards, and the turned pose for leaving backwards."""
    local = relative(side.frame, pose)
    return compose(local, (0.0, 0.0, math.pi)), local
