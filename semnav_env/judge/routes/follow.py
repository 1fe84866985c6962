"""Follows a route exactly: the doors that are crossed, and the verdict of the judge."""

from __future__ import annotations

import math

import numpy as np
import shapely

from semnav_env.judge import Judge, Motion, plan_mission
from semnav_env.judge.routes.route import Route, RouteError
from semnav_env.language import Approach, Command
from semnav_env.mind.grounding.crossing import first_crossed
from semnav_env.rules import GroundingRules
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import FloatArray, path_length, to_parent

_STAND_OFF = GroundingRules().stand_off

MAX_DEPTH_BEHIND_DOOR = 2.0
"""Largest length of a route behind its last door at which it still leads through that door,
metres."""

STAND_OFF_TOLERANCE = 0.2
"""Tolerance of the place `stand_off` before the middle of a door at which a route to that door
ends, metres."""

LEAST_ROUTE_LENGTH = 0.5
"""Length below which a route without a turn is too short, metres."""

REST_POSES = 2
"""Number of poses at rest after the end of a route; some goals count only once the robot stands."""

STEP_SECONDS = 0.1
"""Time from one pose of a route to the next, seconds."""


def follows(floor_plan: FloorPlan, command: Command, route: Route) -> bool:
    """Whether a robot that follows a route carries out a command, as the judge decides.

    Raises:
        GroundingError: the command cannot be carried out from the start of the route.
    """
    geodesic = floor_plan.derived(Geodesic)
    judge = Judge(plan_mission(floor_plan, geodesic, command, route.start), measures_way=False)
    poses = with_rest(route).tolist()
    for k, (x, y, heading) in enumerate(poses[1:], 1):
        speed = 1.0 if k < len(poses) - REST_POSES else 0.0
        judge.update(Motion((x, y, heading), speed, 0.0, in_contact=False, seconds=STEP_SECONDS))
    return judge.success


def with_rest(route: Route) -> FloatArray:
    """The poses of a route and of a short rest at its end, shape (n, 3)."""
    return np.vstack((route.poses, *(route.poses[-1:],) * REST_POSES))


def crossings(floor_plan: FloorPlan, poses: FloatArray) -> list[tuple[int, str]]:
    """The doors that poses lead through: index of the pose and name of the door."""
    doors, ends = floor_plan.doors, floor_plan.door_ends
    steps = np.hstack((poses[:-1, :2], poses[1:, :2])).tolist()
    hits = ((k, first_crossed(ends, *step)) for k, step in enumerate(steps, 1))
    return [(k, doors[hit].name) for k, hit in hits if hit >= 0]


def destination(floor_plan: FloorPlan, route: Route) -> tuple[str, Approach] | None:
    """The door through which, or up to which, a route leads at its end; None if there is none."""
    poses = route.poses
    crossed = crossings(floor_plan, poses)
    if crossed:
        index, name = crossed[-1]
        if path_length(poses[index:, :2]) <= MAX_DEPTH_BEHIND_DOOR:
            return name, Approach.THROUGH
    if route.facing is not None:
        x, y, heading = poses[-1].tolist()
        middle = to_parent((x, y, heading), (_STAND_OFF, 0.0))
        for door in floor_plan.doors:
            if door.open and math.dist(door.midpoint, middle) <= STAND_OFF_TOLERANCE:
                return door.name, Approach.TO
    return None


def check_route(floor_plan: FloorPlan, route: Route) -> None:
    """Refuse a route that no robot can follow.

    Raises:
        RouteError: the route leads through something solid, or is too short.
    """
    closed = {door.name for door in floor_plan.doors if not door.open}
    for _, name in crossings(floor_plan, route.poses):
        if name in closed:
            raise RouteError(f"the route leads through door {name}, which is closed")
    way = shapely.LineString(route.points)
    rows = floor_plan.solids.query(way, predicate="intersects")
    if len(rows):
        at = floor_plan.solids.geometries[int(rows.min())].intersection(way).centroid
        raise RouteError(f"the route leads through something solid at ({at.x:.2f}, {at.y:.2f})")
    if route.length < LEAST_ROUTE_LENGTH and route.facing is None:
        raise RouteError(f"the route is {route.length:.2f} m long; there is nothing to describe")
