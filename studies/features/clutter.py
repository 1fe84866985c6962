"""Furniture, columns and people's legs, put at random into a floor plan."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import shapely
from shapely import LineString, Point, Polygon
from shapely.affinity import rotate, translate
from shapely.geometry.base import BaseGeometry

from semnav_env.world.maps.floor_plan import FloorPlan, Material, Surface

MAX_PLACE_TRIES = 50
"""Places that are drawn for one thing before it is left out."""

QUARTER_EDGES = 9
"""Edges of a quarter of a round thing: enough that the truth takes it for round."""


@dataclass(frozen=True)
class ClutterSpec:
    """How much clutter there is, and how big it is.

    Attributes:
        boxes: cabinets, desks and cartons for every 100 square metres.
        box_side: shortest and longest side of a box, metres.
        columns: round ones, for every 100 square metres.
        column_radius: thinnest and thickest, metres.
        people: for every 100 square metres; two legs each.
        leg_radius: thinnest and thickest, metres.
        door_margin: boxes and columns stay this far from every doorway, metres; people stand
            anywhere.
    """

    boxes: float = 5.0
    box_side: tuple[float, float] = (0.3, 1.6)
    columns: float = 1.5
    column_radius: tuple[float, float] = (0.15, 0.5)
    people: float = 1.5
    leg_radius: tuple[float, float] = (0.04, 0.08)
    door_margin: float = 0.4


def cluttered(
    plan: FloorPlan, rng: np.random.Generator, spec: ClutterSpec | None = None
) -> FloorPlan:
    """The floor plan with things in it that touch neither its walls nor one another."""
    spec = spec or ClutterSpec()
    floor = free_floor(plan)
    ways = shapely.union_all([LineString((d.start, d.end)) for d in plan.doors])
    taken = shapely.union_all(plan.solids.geometries)
    added: list[Polygon] = []
    for density, make, forbidden in (
        (spec.boxes, _box, ways.buffer(spec.door_margin)),
        (spec.columns, _column, ways.buffer(spec.door_margin)),
        (spec.people, _person, Polygon()),
    ):
        for _ in range(rng.poisson(density * floor.area / 100.0)):
            things = _placed(partial(make, rng, spec), floor, taken, forbidden, rng)
            added += things
            taken = shapely.union_all([taken, *things])
    return replace(plan, surfaces=(*plan.surfaces, *map(_surface, added)))


def free_floor(plan: FloorPlan) -> BaseGeometry:
    """Rooms and corridors, or all of a plan that names none, without what stands in them."""
    closed = [s.points for s in plan.surfaces if len(s.points) > 3 and s.points[0] == s.points[-1]]
    blocks = [block for points in closed if _is_thing(block := Polygon(points), plan)]
    rooms = [region.polygon for region in plan.regions] or [plan.boundary]
    inside = shapely.union_all(rooms).intersection(plan.boundary)
    return inside.difference(shapely.union_all(blocks))


def _is_thing(block: Polygon, plan: FloorPlan) -> bool:
    """Whether a closed surface is something that stands in the plan, not the outline of rooms."""
    return bool(block.area < 0.1 * plan.boundary.area)


def _box(rng: np.random.Generator, spec: ClutterSpec) -> list[Polygon]:
    x, y = rng.uniform(*spec.box_side, 2) / 2.0
    return [rotate(shapely.box(-x, -y, x, y), rng.uniform(0.0, 90.0))]


def _column(rng: np.random.Generator, spec: ClutterSpec) -> list[Polygon]:
    return [Point(0.0, 0.0).buffer(rng.uniform(*spec.column_radius), quad_segs=QUARTER_EDGES)]


def _person(rng: np.random.Generator, spec: ClutterSpec) -> list[Polygon]:
    radius, apart = rng.uniform(*spec.leg_radius), rng.uniform(0.2, 0.45)
    turn = rng.uniform(0.0, math.tau)
    x, y = 0.5 * apart * math.cos(turn), 0.5 * apart * math.sin(turn)
    return [Point(s * x, s * y).buffer(radius, quad_segs=QUARTER_EDGES) for s in (-1.0, 1.0)]


def _placed(
    make: Callable[[], list[Polygon]],
    floor: BaseGeometry,
    taken: BaseGeometry,
    forbidden: BaseGeometry,
    rng: np.random.Generator,
) -> list[Polygon]:
    """What `make` gives, moved to where it is free; nothing if no such place was found."""
    west, south, east, north = floor.bounds
    for _ in range(MAX_PLACE_TRIES):
        x, y = rng.uniform((west, south), (east, north)).tolist()
        things = [translate(thing, x, y) for thing in make()]
        whole = shapely.union_all(things)
        if (
            floor.contains(whole)
            and not taken.intersects(whole)
            and not forbidden.intersects(whole)
        ):
            return things
    return []


def _surface(thing: Polygon) -> Surface:
    return Surface(tuple(thing.exterior.coords), Material.FURNITURE)
