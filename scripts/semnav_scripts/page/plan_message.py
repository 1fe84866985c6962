"""A floor plan and a body as the page draws them: plain numbers, metres, world frame."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from shapely import Polygon

from semnav_env.robots import RobotSpec
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.floor_plan import Region
from semnav_features.frames import Point

DIGITS = 3
"""Decimals of a coordinate: millimetres."""


def plan_message(plan: FloorPlan, swinging: tuple[str, ...] = ()) -> dict[str, Any]:
    """The plan by parts.

    Args:
        plan: the plan without leaves that can swing.
        swinging: names of the doors that can be shut by hand.
    """
    return {
        "name": plan.name,
        "bounds": [round(value, DIGITS) for value in plan.boundary.bounds],
        "boundary": _outline(plan.boundary),
        "surfaces": [
            {"material": str(surface.material), "points": _rounded(surface.points)}
            for surface in plan.surfaces
        ],
        "doors": [
            {
                "name": door.name,
                "ends": _rounded((door.start, door.end)),
                "open": door.open,
                "swings": door.name in swinging,
            }
            for door in plan.doors
        ],
        "rooms": [_region(region) for region in plan.rooms],
        "corridors": [_region(region) for region in (*plan.corridors, *plan.intersections)],
    }


def body_message(robot: RobotSpec) -> dict[str, Any]:
    """The footprint of a body, metres."""
    return {
        "name": robot.name,
        "length": robot.length,
        "width": robot.width,
        "axle": robot.axle,
        "legs": robot.holonomic,
    }


def _region(region: Region) -> dict[str, Any]:
    x, y = region.polygon.representative_point().coords[0]
    return {"name": region.name, "points": _outline(region.polygon), "at": _rounded([(x, y)])[0]}


def _outline(polygon: Polygon) -> list[list[float]]:
    return _rounded((float(x), float(y)) for x, y in polygon.exterior.coords)


def _rounded(points: Iterable[Point]) -> list[list[float]]:
    return [[round(x, DIGITS), round(y, DIGITS)] for x, y in points]
