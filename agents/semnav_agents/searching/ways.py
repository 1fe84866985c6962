"""Paths of a robot on its search map, from its present place."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from semnav_agents.searching.outlines import Mask
from semnav_agents.searching.search_map import SAFE, SearchMap
from semnav_env.robots import RobotSpec
from semnav_env.world.grid.costs import costs_from
from semnav_env.world.grid.distance import distance_to_marked
from semnav_env.world.grid.poses import Reach, reach_in_grid
from semnav_features.frames import FloatArray, Point, Pose

COMFORT = 0.8
"""Distance from everything solid beyond which a way costs no more than its length, metres."""

CROWDING = 2.0
"""Extra cost of a metre right beside something solid."""

HEADINGS = 24
"""Headings over a whole turn in which it is asked where the whole body can get to."""

SHRUNK = 0.0, 0.1, 0.2
"""By how much shorter and narrower it is taken for if it does not fit where it is, metres."""


@dataclass(frozen=True, eq=False)
class Ways:
    """Paths of a robot from its present place, and their costs.

    Attributes:
        costs: of the path to each cell, metres, shape (rows, columns); infinite if there is none.
        room: distance of each cell from the nearest solid cell, metres, same shape.
        poses: that the whole body can reach; None if not computed.
    """

    costs: FloatArray
    room: FloatArray
    poses: Reach | None = None

    def lead_to(self, x: FloatArray, y: FloatArray, heading: FloatArray) -> Mask:
        """Whether the whole body can reach poses, if that was computed; arrays of one shape."""
        if self.poses is None:
            return np.ones(np.broadcast_shapes(x.shape, heading.shape), np.bool_)
        return self.poses.has(x, y, heading)


def ways_from(
    chart: SearchMap, place: Point, half_width: float, body: tuple[RobotSpec, Pose] | None = None
) -> Ways:
    """Compute the paths on floor that is safe or that is floor in the plan.

    Args:
        chart: the map.
        place: where the robot is.
        half_width: of the robot, metres.
        body: the body and its pose, to compute the poses that the whole body can reach; slow.
    """
    spacing, solid = chart.grid.spacing, chart.solid
    room = np.empty(solid.shape)
    distance_to_marked(solid, spacing, room)
    passable = chart.has(SAFE) | (chart.rooms >= 0)
    row, column = chart.grid.cell(place)
    open_ = passable & (room > half_width)
    open_[max(row - 6, 0) : row + 7, max(column - 6, 0) : column + 7] |= ~solid[
        max(row - 6, 0) : row + 7, max(column - 6, 0) : column + 7
    ]
    near = np.clip(1.0 - room / COMFORT, 0.0, 1.0)
    weight = np.where(open_, 1.0 + CROWDING * near, np.inf)
    costs = costs_from((row, column), weight, spacing)
    poses = None if body is None else reachable_poses(chart, solid | ~passable, *body)
    return Ways(costs, room, poses)


def reachable_poses(chart: SearchMap, blocked: Mask, robot: RobotSpec, pose: Pose) -> Reach | None:
    """The poses that a body can reach; None if it does not fit even at its present pose.

    Walls of the map are thicker than the true walls. If the body does not fit, a smaller one is
    tried.
    """
    cell = chart.grid.cell(pose[:2])
    for thinner in SHRUNK:
        size = robot.length - thinner, robot.width - thinner
        area = reach_in_grid(blocked, chart.grid, size, HEADINGS, cell, math.tau, pose[2])
        if area.cells.any():
            return area
    return None
