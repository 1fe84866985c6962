"""Makes routes to a door, a room or a place."""

from __future__ import annotations

import math

import numpy as np
import shapely

from semnav_env.judge.routes.follow import crossings
from semnav_env.judge.routes.route import Route, RouteError
from semnav_env.language import Approach
from semnav_env.language.vocabulary.typos import did_you_mean
from semnav_env.rules import GroundingRules
from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor, Region
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import FloatArray, Point, Pose

_STAND_OFF = GroundingRules().stand_off

MAX_ROOM_DISTANCE = 0.5
"""Largest distance of the middle of a door from the room to which it belongs, metres."""


PREFERRED_CLEARANCE = 0.8
"""Clearance below which a path counts as longer than it is, metres."""

SMOOTHING_POINTS = 7
"""Number of points of a way, 0.1 m apart, over which each one is averaged."""


def comfortable(floor_plan: FloorPlan) -> Geodesic:
    """Shortest paths that keep to the middle of corridors, for routes."""
    return Geodesic(floor_plan, PREFERRED_CLEARANCE)


def route_to(
    floor_plan: FloorPlan,
    start: Pose,
    goal: str | Point,
    approach: Approach = Approach.THROUGH,
    geodesic: Geodesic | None = None,
) -> Route:
    """Make a route of a robot's centre to a door, a room or a place.

    Args:
        floor_plan: the floor plan.
        start: pose of the robot's centre, world frame.
        goal: name of a door, a room, a corridor or an intersection, or a point.
        approach: whether to go through a door that is named, or up to it.
        geodesic: shortest ways as `comfortable` makes them; give them to make many routes.

    Raises:
        RouteError: there is no such goal, which lists those there are, or no way there; or a point
            lies outside the floor plan.
    """
    if len(start) != 3:
        raise RouteError(f"start is {tuple(start)}; give x, y and heading, metres and radians")
    geodesic = geodesic or comfortable(floor_plan)
    if not isinstance(goal, str):
        _check_inside(floor_plan, goal)
        return Route(start, _way(geodesic, start, goal, "that place"))
    door = next((door for door in floor_plan.doors if door.name == goal), None)
    if door is None:
        region = _region(floor_plan, goal)
        centre = region.polygon.representative_point()
        way = _way(geodesic, start, (centre.x, centre.y), goal)
        door = _door_into(floor_plan, region, way)
        if door is None:
            return Route(start, way)
    if not door.open:
        raise RouteError(f"door {door.name} is closed")
    way = _way(geodesic, start, door.midpoint, goal)
    route = _to_door(start, way, door, approach)
    straight = not len(floor_plan.solids.query(shapely.LineString(route.points), "intersects"))
    return route if straight or approach is Approach.TO else _winding(geodesic, route)


def _check_inside(floor_plan: FloorPlan, goal: Point) -> None:
    if not shapely.intersects_xy(floor_plan.boundary, *goal):
        west, south, east, north = floor_plan.boundary.bounds
        raise RouteError(
            f"({goal[0]:g}, {goal[1]:g}) is outside {floor_plan.name}, "
            f"which spans x {west:g} to {east:g} and y {south:g} to {north:g}"
        )


def _winding(geodesic: Geodesic, route: Route) -> Route:
    """A route to about the same end around obstacles in a doorway, such as a half-open leaf."""
    x, y = route.points[-1].tolist()
    way = geodesic.to((x, y)).way(route.start[:2])
    return Route(route.start, way[:-1]) if len(way) > 2 else route


def _to_door(start: Pose, way: FloatArray, door: PlanDoor, approach: Approach) -> Route:
    """Straight through the doorway, or up to a place before it."""
    middle = np.array(door.midpoint)
    along = (np.array(door.end) - np.array(door.start)) / door.width
    outward = np.array((along[1], -along[0]))
    if outward @ (middle - _before(way, middle)) < 0:
        outward = -outward
    if approach is Approach.THROUGH:
        apart = np.hypot(*(way - middle).T) > _STAND_OFF / 2
        apart[0] = True
        inside = middle + np.outer((-_STAND_OFF / 2, _STAND_OFF), outward)
        return Route(start, np.vstack((way[apart], inside)))
    apart = np.hypot(*(way - middle).T) > _STAND_OFF
    apart[0] = True
    heading = math.atan2(outward[1], outward[0])
    return Route(start, np.vstack((way[apart], middle - _STAND_OFF * outward)), heading)


def _before(way: FloatArray, middle: FloatArray) -> FloatArray:
    """The last point of a path that is clearly before the doorway to which it leads."""
    apart = np.flatnonzero(np.hypot(*(way - middle).T) > _STAND_OFF / 2)
    return np.asarray(way[apart[-1] if len(apart) else 0])


def _way(geodesic: Geodesic, start: Pose, goal: Point, name: str) -> FloatArray:
    ways = geodesic.to(goal)
    if math.isinf(ways.length(start[:2])):
        x, y, _ = start
        raise RouteError(f"there is no way from ({x:.2f}, {y:.2f}) to {name}")
    return _smooth(ways.way(start[:2]))


def _smooth(way: FloatArray) -> FloatArray:
    """A way along a grid, smoothed; its ends stay."""
    reach = min(SMOOTHING_POINTS // 2, (len(way) - 1) // 2)
    smooth = way.copy()
    for k in range(1, len(way) - 1):
        near = min(reach, k, len(way) - 1 - k)
        smooth[k] = way[k - near : k + near + 1].mean(axis=0)
    return smooth


def _region(floor_plan: FloorPlan, name: str) -> Region:
    try:
        return floor_plan.region(name)
    except KeyError:
        doors = [door.name for door in floor_plan.doors]
        names = dict.fromkeys([*doors, *(region.name for region in floor_plan.regions)])
        raise RouteError(
            f"{floor_plan.name} has no door, room or place {name!r:.80}; there are: "
            f"{', '.join(names)}{did_you_mean(name, names)}"
        ) from None


def _door_into(floor_plan: FloorPlan, region: Region, way: FloatArray) -> PlanDoor | None:
    """The door through which a way enters a room; None if it is none of its doors."""
    if region not in floor_plan.rooms:
        return None
    x, y = way[0].tolist()
    crossed = crossings(floor_plan, Route((x, y, 0.0), way).poses)
    if not crossed:
        return None
    door = floor_plan.door(crossed[-1][1])
    near = region.polygon.distance(shapely.Point(door.midpoint)) <= MAX_ROOM_DISTANCE
    return door if near else None
