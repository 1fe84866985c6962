"""Poses at which a robot can stand in a floor plan."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import shapely
from shapely import Polygon

from semnav_env.robots import RobotSpec, robot_spec
from semnav_env.world.maps.box_room import HAS_ROOM, IS_DOUBTFUL, SolidEdges, is_inside
from semnav_env.world.maps.floor_plan import FloorPlan, Region
from semnav_features.frames import FloatArray, Point, Pose, points_to_parent

MAX_DRAWS = 2000
"""Largest number of poses drawn before a region counts as full."""

MARGIN = 0.05
"""Space that is kept free all around a random pose, metres."""


def corners(robot: RobotSpec) -> FloatArray:
    """Corners of the footprint in the robot frame, counter-clockwise, shape (4, 2), metres."""
    x, y = robot.length / 2, robot.width / 2
    return np.array([(-x, -y), (x, -y), (x, y), (-x, y)])


def footprint(robot: RobotSpec, pose: Pose) -> Polygon:
    """The rectangle that a robot covers at a pose (its centre and heading), world frame."""
    return Polygon(points_to_parent(pose, corners(robot)))


def clearance(plan: FloorPlan, robot: RobotSpec, pose: Pose) -> float:
    """Distance between the footprint and the nearest solid segment, metres; 0 if they touch.

    Infinite in a plan without segments.
    """
    if len(plan.solids) == 0:
        return math.inf
    _, distances = plan.solids.query_nearest(
        footprint(robot, pose), return_distance=True, all_matches=False
    )
    return float(distances[0])


def placement_error(
    plan: FloorPlan, robot: str | RobotSpec, pose: Pose, margin: float = 0.0
) -> str | None:
    """The reason why a robot cannot stand at a pose, with a free pose; None if it can.

    Args:
        plan: the plan.
        robot: its name or spec; its footprint must lie in the boundary and touch nothing solid.
        pose: pose of its centre, world frame.
        margin: metres to keep free all around it.

    Raises:
        ValueError: no such robot.
    """
    robot = robot_spec(robot)
    if len(pose) != 3 or not all(map(math.isfinite, pose)):
        return f"the pose is {tuple(pose)}; give finite x and y in metres and heading in radians"
    if has_room(plan, robot, pose, margin):
        return None
    problem = _problem(plan, robot, pose, margin)
    return problem and f"a {robot.name} at {_written(pose)} {problem}{_advice(plan, robot)}"


def sample_pose(
    plan: FloorPlan,
    robot: RobotSpec,
    rng: np.random.Generator,
    region: Region | None = None,
    margin: float = MARGIN,
) -> Pose:
    """A random pose, uniform over place and heading, where the robot can stand.

    Args:
        plan: the plan.
        robot: its footprint must lie in the boundary and touch nothing solid.
        rng: source of randomness.
        region: region for its centre; any corridor by default.
        margin: metres to keep free all around it.

    Raises:
        ValueError: no free pose was found.
    """
    area = area_to_start_in(plan, region)
    west, south, east, north = area.bounds
    for _ in range(MAX_DRAWS):
        x, y = uniform(rng, west, east), uniform(rng, south, north)
        pose = x, y, uniform(rng, -math.pi, math.pi)
        if is_inside(area.edges, x, y) and has_room(plan, robot, pose, margin):
            return pose
    raise no_free_place(plan, robot, area)


def area_to_start_in(plan: FloorPlan, region: Region | None = None) -> Region:
    """A region, or all corridors together.

    Raises:
        ValueError: there is no corridor.
    """
    area = region or plan.derived(_every_corridor)
    if area.polygon.is_empty:
        raise ValueError(f"{plan.name} has no corridor to start in; name a region or a pose")
    return area


def no_free_place(plan: FloorPlan, robot: RobotSpec, area: Region) -> ValueError:
    """The error for an area in which no free pose was found."""
    return ValueError(f"a {robot.name} found no free place in {area.name} of {plan.name}")


def uniform(rng: np.random.Generator, low: float, high: float) -> float:
    """A random number, the same as that of `rng.uniform`, in a third of the time."""
    return low + (high - low) * rng.random()


def _every_corridor(plan: FloorPlan) -> Region:
    joined: Any = shapely.union_all([each.polygon for each in plan.corridors])
    return Region("a corridor", joined)


def has_room(plan: FloorPlan, robot: RobotSpec, pose: Pose, margin: float = 0.0) -> bool:
    """Whether a robot can stand at a pose; see `placement_error`, which also says why not."""
    halves = robot.length / 2 + margin, robot.width / 2 + margin
    answer = plan.derived(SolidEdges.of).room(pose, *halves)
    return answer == HAS_ROOM or (answer == IS_DOUBTFUL and exact_room(plan, robot, pose, margin))


def exact_room(plan: FloorPlan, robot: RobotSpec, pose: Pose, margin: float) -> bool:
    """As `has_room`, by exact geometry alone, which takes far longer."""
    return _problem(plan, robot, pose, margin) is None


def _problem(plan: FloorPlan, robot: RobotSpec, pose: Pose, margin: float) -> str | None:
    west, south, east, north = plan.boundary.bounds
    if not (west <= pose[0] <= east and south <= pose[1] <= north):
        return f"is outside {plan.name}, which spans x {west} to {east} and y {south} to {north}"
    body = footprint(robot, pose).buffer(margin, join_style="mitre")
    if not plan.boundary.covers(body):
        return f"reaches over the boundary of {plan.name}"
    hit = _touched(plan, body)
    return hit and f"overlaps {hit}"


def _touched(plan: FloorPlan, body: Polygon) -> str | None:
    """The first solid thing that a body touches or lies in, and where."""
    rows = plan.solids.query(body, predicate="intersects")
    if len(rows):
        row = int(rows.min())
        at = plan.solids.geometries[row].intersection(body).centroid
        surface = plan.surfaces[int(plan.owners[row])]
        return f"{surface.material.value} at ({at.x:.2f}, {at.y:.2f})"
    if len(plan.furniture.query(body, predicate="covered_by")):
        return f"furniture around ({body.centroid.x:.2f}, {body.centroid.y:.2f})"
    return None


def is_clear(plan: FloorPlan, point: Point, radius: float) -> bool:
    """Whether a point lies in no furniture and nothing solid is within `radius` metres of it."""
    if plan.derived(SolidEdges.of).room((*point, 0.0), radius, radius) == HAS_ROOM:
        return True  # not even the square around the circle meets anything
    place = shapely.Point(point)
    near = plan.solids.query(place, predicate="dwithin", distance=radius)
    return len(near) == 0 and len(plan.furniture.query(place, predicate="covered_by")) == 0


def _advice(plan: FloorPlan, robot: RobotSpec) -> str:
    try:
        return f"; {_written(sample_pose(plan, robot, np.random.default_rng(0)))} is free"
    except ValueError:
        return ""


def _written(pose: Pose) -> str:
    return "({:.4g}, {:.4g}, {:.4g})".format(*pose)
