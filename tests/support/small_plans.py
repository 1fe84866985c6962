"""Floor plans small enough to know every answer."""

from __future__ import annotations

from shapely import box

from semnav_env.world.maps.floor_plan import FloorPlan, Material, Surface
from semnav_features.frames import Point


def closed(*points: Point, material: Material = Material.WALL) -> Surface:
    return Surface((*points, points[0]), material)


def plan_of(*surfaces: Surface, name: str = "small") -> FloorPlan:
    xs = [x for surface in surfaces for x, _ in surface.points] or [-50.0, 50.0]
    ys = [y for surface in surfaces for _, y in surface.points] or [-50.0, 50.0]
    outline = box(min(xs), min(ys), max(xs), max(ys))
    return FloorPlan(name, surfaces, (), (), (), (), outline)


def empty_hall(width: float = 10.0, depth: float = 6.0) -> FloorPlan:
    """A rectangle with its lower left corner at the origin."""
    return plan_of(closed((0, 0), (width, 0), (width, depth), (0, depth)))


def furnished_hall() -> FloorPlan:
    """12 x 8 m: slanted wall of three segments, pillar, door leaf, a glass pane at x = 9."""
    return plan_of(
        closed((0, 0), (12, 0), (12, 8), (0, 8)),
        Surface(((0, 5), (2.1, 5.3), (4.0, 6.7), (4.2, 8))),
        closed((5.0, 2.0), (5.5, 2.1), (5.4, 2.6), (4.9, 2.5)),
        Surface(((7.0, 8.0), (6.4, 7.2)), Material.LEAF),
        Surface(((9.0, 0.0), (9.0, 8.0)), Material.GLASS),
    )
