"""Houses with people on the floor, and the places in their rooms where a robot can turn."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
import shapely
from shapely import Polygon
from shapely.geometry.base import BaseGeometry

from semnav_env.robots import SPOT
from semnav_env.world.dynamics.victims import victims_of, with_victims
from semnav_env.world.maps import FloorPlan, load_floor_plan
from semnav_env.world.maps.geodesic import Geodesic
from semnav_features.frames import Point

TURNING_ROOM = 0.5 * math.hypot(SPOT.length, SPOT.width)
"""Distance from everything solid at which the body can turn on the spot, metres."""

SPACING = 0.4
"""Distance between the places that are tried, metres."""

APART = 1.2
"""Least distance between two places of one room, metres."""

VICTIMS = 2
"""People on the floor of each house."""


@dataclass(frozen=True, eq=False)
class House:
    """A house to search.

    Attributes:
        plan: with its furniture, and with people on its floor.
    """

    plan: FloorPlan

    @staticmethod
    def of(seed: int) -> House:
        """The house of a seed, which also lays the people."""
        rng = np.random.default_rng(seed)
        plan = load_floor_plan(f"office:house:{seed}")
        return House(with_victims(plan, VICTIMS, SPOT, rng, None))

    @cached_property
    def people(self) -> list[Point]:
        """Middles of the people, world frame."""
        return [(each.centroid.x, each.centroid.y) for each in victims_of(self.plan)]

    @cached_property
    def start(self) -> Point:
        """Middle of the largest corridor."""
        place = max((hall.polygon for hall in self.plan.corridors), key=lambda hall: hall.area)
        return place.centroid.x, place.centroid.y

    @cached_property
    def geodesic(self) -> Geodesic:
        """Shortest ways through the house."""
        return Geodesic(self.plan)

    @cached_property
    def free(self) -> BaseGeometry:
        """Where the middle of the body can be while it turns."""
        lines = [shapely.LineString(surface.points) for surface in self.plan.surfaces]
        solid = shapely.union_all([*lines, *self.plan.furniture.geometries])
        return self.plan.boundary.difference(solid.buffer(TURNING_ROOM))

    def places(self, room: Polygon, most: int) -> list[Point]:
        """Places of a room where the body can turn: one near its middle, then others far apart.

        Args:
            room: its outline.
            most: largest number of places.
        """
        west, south, east, north = room.bounds
        x, y = np.meshgrid(np.arange(west, east, SPACING), np.arange(south, north, SPACING))
        inside = shapely.contains_xy(self.free.intersection(room), x, y)
        there = np.column_stack((x[inside], y[inside]))
        far = np.hypot(*(there - (room.centroid.x, room.centroid.y)).T)
        chosen: list[Point] = []
        while len(there) and len(chosen) < most:
            k = int(np.argmax(far) if chosen else np.argmin(far))
            if chosen and far[k] < APART:
                break
            away = np.hypot(*(there - there[k]).T)
            far = np.minimum(far, away) if chosen else away
            chosen.append((float(there[k, 0]), float(there[k, 1])))
        return chosen

    def tour(self, places: list[Point]) -> list[Point]:
        """The places that can be reached, each the nearest to the one before, from the start on."""
        left, here, order = list(places), self.start, list[Point]()
        while left:
            ways = [self.geodesic.to(place).length(here) for place in left]
            k = int(np.argmin(ways))
            if not math.isfinite(ways[k]):
                break
            here = left.pop(k)
            order.append(here)
        return order

    def metres(self, places: list[Point]) -> float:
        """Length of the way from the start through places, metres."""
        return sum(self.geodesic.to(b).length(a) for a, b in pairwise([self.start, *places]))
