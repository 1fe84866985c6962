"""Chooses the side from which a door of a floor plan is approached."""

from __future__ import annotations

import numpy as np
import shapely

from semnav_env.approach.door_side import DoorSide
from semnav_env.approach.surroundings import SEED_DISTANCE
from semnav_env.world.maps import FloorPlan, PlanDoor, Region
from semnav_features.frames import Point


def side_towards(plan: FloorPlan, door: PlanDoor, start: Point | None = None) -> DoorSide:
    """The side of a door on which the robot is, or else the side in the corridor.

    It is the side that shares a region of the plan with the start, or else the side in a corridor,
    through which one comes from elsewhere. If that says nothing, it is the side of the door's line
    on which the start lies; without a start the left one, as one looks from the door's start to its
    end.

    Args:
        plan: with the door.
        door: one of its doors.
        start: where the robot is, (x, y) in metres.
    """
    side, place = DoorSide(door.end, door.start), start and shapely.Point(start)
    own = tuple(each for each in plan.regions if place and each.polygon.covers(place))
    for regions in (own, plan.corridors + plan.intersections + plan.areas):
        here, there = (_lies_in(regions, each) for each in (side, side.opposite))
        if here != there:
            return side if here else side.opposite
    return side if start is None else DoorSide.seen_from(door.as_door(), start)


def _lies_in(regions: tuple[Region, ...], side: DoorSide) -> bool:
    """Whether the place directly before a door is in one of the regions."""
    x, y = side.before(np.array([(SEED_DISTANCE, 0.0)]))[0]
    return any(region.polygon.covers(shapely.Point(x, y)) for region in regions)
