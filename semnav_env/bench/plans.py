"""Floor plans of any size that are the same around the robot."""

from __future__ import annotations

from dataclasses import replace

from shapely import box
from shapely.affinity import translate

from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor, Region, Surface
from semnav_features.frames import Point

GAP = 1.0
"""Between two copies, metres."""


def repeated(plan: FloorPlan, copies: int) -> FloorPlan:
    """A plan and copies of it to its east; doors and rooms of each copy have their own names.

    Args:
        plan: to repeat.
        copies: number of copies with the plan itself, at least 1.
    """
    west, south, east, north = plan.boundary.bounds
    shift = east - west + GAP
    moved = [_moved(plan, k * shift, f"_{k}" if k else "") for k in range(copies)]
    whole: dict[str, tuple[object, ...]] = {
        part: tuple(each for copy in moved for each in getattr(copy, part))
        for part in ("surfaces", "doors", "rooms", "corridors", "intersections", "areas")
    }
    outline = box(west, south, east + (copies - 1) * shift, north)
    return replace(plan, name=f"{plan.name}_{copies}", boundary=outline, **whole)  # type: ignore[arg-type]


def _moved(plan: FloorPlan, x: float, suffix: str) -> FloorPlan:
    def there(point: Point) -> Point:
        return point[0] + x, point[1]

    def regions(them: tuple[Region, ...]) -> tuple[Region, ...]:
        return tuple(
            Region(each.name + suffix, translate(each.polygon, x), each.assumed) for each in them
        )

    return replace(
        plan,
        surfaces=tuple(
            Surface(tuple(map(there, each.points)), each.material, each.assumed)
            for each in plan.surfaces
        ),
        doors=tuple(
            PlanDoor(each.name + suffix, there(each.start), there(each.end), each.open)
            for each in plan.doors
        ),
        rooms=regions(plan.rooms),
        corridors=regions(plan.corridors),
        intersections=regions(plan.intersections),
        areas=regions(plan.areas),
    )
