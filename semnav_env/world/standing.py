"""Where a robot stands: its footprint, and how far it is from what is solid."""

from __future__ import annotations

import math

from semnav_env.features.frames import Point, Pose
from semnav_env.maps.floor_plan import FloorPlan
from semnav_env.maps.placement import footprint, has_room
from semnav_env.robots import RobotSpec


def corners(robot: RobotSpec) -> list[Point]:
    """Of the footprint in the robot frame, counter-clockwise."""
    x, y = robot.length / 2, robot.width / 2
    return [(-x, -y), (x, -y), (x, y), (-x, y)]


def clearance(floor_plan: FloorPlan, robot: RobotSpec, pose: Pose) -> float:
    """Distance between the footprint and the nearest solid segment, metres; 0 if they touch.

    Infinite in a plan without segments.
    """
    solids = floor_plan.solids
    if len(solids) == 0:
        return math.inf
    _, distances = solids.query_nearest(
        footprint(robot, pose), return_distance=True, all_matches=False
    )
    return float(distances[0])


def standing_error(floor_plan: FloorPlan, robot: RobotSpec, pose: Pose) -> str | None:
    """Why the robot cannot stand at a pose; None if it can."""
    if has_room(floor_plan, robot, pose):
        return None
    where = f"the pose {tuple(round(value, 3) for value in pose)}"
    if not floor_plan.boundary.covers(footprint(robot, pose)):
        return f"{where} puts the {robot.name} outside the boundary of {floor_plan.name}"
    if clearance(floor_plan, robot, pose) == 0.0:
        return (
            f"at {where} the {robot.name} would stand in something solid: "
            f"it needs a free {robot.length} m x {robot.width} m"
        )
    return None
