"""Drawn floors of real buildings for the training of the scorer, with leaves and furniture put in.

Their walls are as thick as those of the building, so that doors have reveals, and their rooms have
the shapes that architects draw. Only floors of the tuning half of the benchmark of real buildings
are used (`semnav_env.judge.episodes.buildings`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import shapely
from numpy.random import Generator

from semnav_env.judge.episodes.buildings import TUNE, floors_in, listed_floors
from semnav_env.world.maps.floor_plan import FloorPlan, Surface
from semnav_features.frames import Pose, to_local
from semnav_features.scene import Door
from studies.door_scorer.random_furniture import DOORWAY_CLEARANCE, TrainingFurniture
from studies.door_scorer.random_offices import SCANNER_CLEARANCE

CLOSED_SHARE, LEAF_SHARE = 0.35, 0.8
"""Shares of the doors that are closed, and of the others that have a leaf."""

THINGS_IN_ROOM, THINGS_IN_HALL = 0.3, 0.12
"""Pieces of furniture for each square metre of a room, and of one larger than `HALL_AREA`."""

HALL_AREA = 60.0
"""Area of the rectangle about a room from which on it is furnished like a hall, square metres."""

VIEW_DISTANCE = 12.0
"""A door farther from the scanner than this is not in view, metres."""


@dataclass(frozen=True)
class FurnishedFloor:
    """A drawn floor with leaves and furniture, world frame.

    Attributes:
        floor_plan: with everything that stops a beam.
        doors: the openings one may pass, in the middle of the wall's thickness.
    """

    floor_plan: FloorPlan
    doors: tuple[Door, ...]

    def doors_from(self, pose: Pose) -> tuple[Door, ...]:
        """The doors near `pose`, in its frame."""
        near = [d for d in self.doors if math.dist(d.midpoint, pose[:2]) < VIEW_DISTANCE]
        return tuple([Door(to_local(pose, d.start), to_local(pose, d.end)) for d in near])

    def corridor_pose(self, rng: Generator) -> Pose:
        """A free pose in a corridor, or anywhere if the floor has none."""
        plan = self.floor_plan
        ways = [region.polygon for region in (*plan.corridors, *plan.intersections)]
        return self._free_pose(ways, rng) if ways else self.any_pose(rng)

    def any_pose(self, rng: Generator) -> Pose:
        """A free pose in a corridor or in a room."""
        return self._free_pose([region.polygon for region in self.floor_plan.regions], rng)

    def _free_pose(self, regions: Sequence[shapely.Polygon], rng: Generator) -> Pose:
        areas = np.array([region.area for region in regions])
        solids = self.floor_plan.solids
        while True:
            region = regions[rng.choice(len(regions), p=areas / areas.sum())]
            x, y = _place(region, rng)
            if not shapely.contains_xy(region, x, y):
                continue
            if not len(solids.query(shapely.Point(x, y), "dwithin", SCANNER_CLEARANCE)):
                return x, y, rng.uniform(-math.pi, math.pi)


def drawn_floors(folder: Path) -> list[FloorPlan]:
    """The floors of the benchmark's tuning half in a folder of the KTH data set, by name.

    Raises:
        FloorPlanError: the folder holds no floors.
        ValueError: a floor of that half is missing.
    """
    floors = {floor.name: floor for floor in floors_in([folder])}
    listed = listed_floors()[TUNE]
    if missing := sorted(set(listed) - set(floors)):
        raise ValueError(f"{folder} lacks {missing[0]}; give a folder with BUILDING/FLOOR.xml")
    return [floors[name].plan() for name in sorted(listed)]


def furnished_floor(plan: FloorPlan, rng: Generator) -> FurnishedFloor:
    """The plan with some doors closed, leaves in most others, and furniture in its rooms.

    Args:
        plan: a drawn floor.
        rng: where all the chance comes from.
    """
    things = TrainingFurniture(rng)
    doors = []
    for door in plan.doors:
        if not door.open:
            continue
        if things.chance(CLOSED_SHARE):
            things.line([door.start, door.end])
            continue
        doors.append(Door(door.start, door.end))
        if things.chance(LEAF_SHARE):
            _leaf(door.as_door(), things)
    ways = shapely.MultiLineString([(door.start, door.end) for door in doors])
    for region in plan.regions:
        _furnish(region.polygon, ways, things)
    surfaces = tuple([Surface(((a, b), (c, d))) for a, b, c, d in things.segments])
    return FurnishedFloor(replace(plan, surfaces=plan.surfaces + surfaces), tuple(doors))


def _leaf(door: Door, things: TrainingFurniture) -> None:
    """A leaf 4 cm thick at 35 to 175 degrees to its closed place, to either side."""
    rng = things.rng
    square, wide = rng.uniform(75.0, 110.0), rng.uniform(35.0, 175.0)
    angle = math.radians(square if things.chance(0.6) else wide) * rng.choice((-1.0, 1.0))
    hinge, other = (door.start, door.end) if things.chance(0.5) else (door.end, door.start)
    heading = angle + math.atan2(other[1] - hinge[1], other[0] - hinge[0])
    along, thick = np.array((math.cos(heading), math.sin(heading))), 0.04
    across = thick * np.array((-along[1], along[0]))
    tip = np.array(hinge) + door.width * along
    corners = (np.array(hinge), tip, tip + across, np.array(hinge) + across)
    things.loop([(float(x), float(y)) for x, y in corners])


def _furnish(
    room: shapely.Polygon, ways: shapely.MultiLineString, things: TrainingFurniture
) -> None:
    """Tables, chairs and clutter anywhere in a room but before its doors."""
    rng = things.rng
    density = THINGS_IN_ROOM if shapely.box(*room.bounds).area < HALL_AREA else THINGS_IN_HALL
    for _ in range(rng.poisson(density * room.area)):
        x, y = _place(room, rng)
        spot = shapely.Point(x, y)
        if not room.contains(spot) or spot.distance(ways) < DOORWAY_CLEARANCE:
            continue
        kinds = things.table, things.chair, things.clutter
        kinds[rng.choice(len(kinds), p=(0.35, 0.1, 0.55))](x, y)


def _place(region: shapely.Polygon, rng: Generator) -> tuple[float, float]:
    west, south, east, north = region.bounds
    return rng.uniform(west, east), rng.uniform(south, north)
