"""Victims: people who lie or sit on the floor of rooms, among the furniture."""

from __future__ import annotations

import numpy as np
import shapely
from shapely import Polygon
from shapely.affinity import rotate, translate
from shapely.geometry.base import BaseGeometry

from semnav_env.robots import RobotSpec
from semnav_env.world.dynamics.furniture import FurnitureMover, free_ways
from semnav_env.world.dynamics.victim_sight import in_sight
from semnav_env.world.maps.floor_plan import FloorPlan, Material
from semnav_features.frames import Point

POSTURES = ((1.7, 0.5), (0.7, 0.5))
"""Length and width of a lying person, and of a sitting person, metres."""

VICTIM_SPACING = 1.5
"""Least distance between two victims, metres: a detector takes two that are nearer for one."""

VICTIM_DISTANCE = 1.0
"""Largest distance of a victim's middle from a place that the robot can reach, metres."""

MAX_TRIES = 5
"""Largest number of attempts to place all victims: random draws may miss a small free place, or
find one that is hidden."""


def with_victims(
    plan: FloorPlan,
    count: int,
    robot: RobotSpec,
    rng: np.random.Generator,
    keep: Point | None,
    room: str | None = None,
) -> FloorPlan:
    """The plan with people on the floor of rooms and open areas, and no way blocked.

    Each can be seen from where it may be reported. If one cannot, all are laid down again, so that
    the draws of other plans stay as they are.

    Args:
        plan: the plan without victims.
        count: number of victims.
        robot: the body for which everything stays reachable, and which can come near each victim.
        rng: source of randomness.
        keep: start of the robot; no victim lies near it. None if it is not known.
        room: name of the only room in which they lie; None for all.

    Raises:
        ValueError: there is no room for so many.
    """
    if count == 0:
        return plan
    for _ in range(MAX_TRIES):
        mover = FurnitureMover(plan, robot, keep)
        laid = _with_all(plan, count, mover, rng, room)
        if laid is not None and in_sight(laid, victims_of(laid), _main_way(laid, mover)):
            return laid
    raise ValueError(f"{plan.name} has no free place in sight for {count} people on the floor")


def _with_all(
    plan: FloorPlan, count: int, mover: FurnitureMover, rng: np.random.Generator, room: str | None
) -> FloorPlan | None:
    """The plan with all victims; None if the first ones left no place for the others."""
    regions = (*plan.rooms, *plan.areas)
    rooms = [region.polygon for region in regions if room in (None, region.name)]
    ways = _main_way(plan, mover)
    places = [room.intersection(ways.buffer(VICTIM_DISTANCE)) for room in rooms]
    for _ in range(count):
        if not any(_lay(mover, places[k], rng) for k in rng.permutation(len(places)).tolist()):
            return None
        apart = victims_of(mover.plan)[-1].buffer(VICTIM_SPACING)
        places = [place.difference(apart) for place in places]
    return mover.plan


def _main_way(plan: FloorPlan, mover: FurnitureMover) -> Polygon:
    """The largest region in which the middle of the robot may be."""
    return max(free_ways(plan, mover.half_lane), key=lambda way: way.area)


def victims_of(plan: FloorPlan) -> list[Polygon]:
    """The outlines of the people on the floor of a plan, world frame."""
    return [Polygon(s.points) for s in plan.surfaces if s.material is Material.PERSON]


def _lay(mover: FurnitureMover, place: BaseGeometry, rng: np.random.Generator) -> bool:
    """Place a victim with the middle in an area; returns whether this was possible."""
    if place.is_empty:
        return False
    x, y = np.array(POSTURES[int(rng.integers(len(POSTURES)))]) / 2
    body = shapely.box(-x, -y, x, y)

    def draw() -> Polygon:
        middle = _point_in(place, rng)
        return translate(rotate(body, rng.uniform(0.0, 180.0)), *middle)

    return mover.put(draw, Material.PERSON)


def _point_in(place: BaseGeometry, rng: np.random.Generator) -> Point:
    """A point of an area, all equally likely."""
    west, south, east, north = place.bounds
    while True:
        x, y = rng.uniform(west, east), rng.uniform(south, north)
        if shapely.contains_xy(place, x, y):
            return x, y
