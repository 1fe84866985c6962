"""Random cases: a room, one of its doors, a start, and clutter; frozen by their seed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import shapely
from shapely import LineString, Polygon
from shapely.affinity import rotate

from semnav_env.approach import DoorSide
from semnav_env.robots import ROBOTS, WHEELCHAIR
from semnav_env.world.maps import FloorPlan, Material, PlanDoor, Region, Surface, load_floor_plan
from semnav_env.world.maps.placement import is_clear, placement_error, sample_pose
from semnav_env.world.maps.reach import reach
from semnav_features.frames import Point, Pose
from semnav_features.rules import DoorRules

SEED = 16
"""Seed of the frozen cases; it was chosen before anything was measured."""

VILLA_SHARE = 0.25
"""Share of the cases in the villa."""

OFFICES = tuple(
    f"office:{kind}:{9000 + k}" for kind in ("small", "medium", "hard") for k in range(20)
)
"""The generated plans; no frozen episode is in them."""

BOXES = (2, 5)
"""Least and largest number of boxes put down for a case."""

BOX_SIDES = (0.3, 0.6)
"""Shortest and longest side of a box, metres."""

NEAR_DOOR = 2.0
"""Half the boxes stand within this distance of the door along x and y, metres."""

DOORWAY_RADIUS = 0.5
"""Distance from the middle of the door in which no box is put, metres."""

GAP = 0.05
"""Least distance from a box to anything solid, metres."""

MARGIN = 0.05
"""Room around the body at the start, metres."""

WINDOW = 3.0
"""Margin around room and door in which a way is looked for, metres."""

BEHIND, BEHIND_RADIUS = 0.8, 0.25
"""Distance behind the door, and radius, of the place that must be reachable, metres."""


@dataclass(frozen=True, eq=False)
class ExitCase:
    """A robot is to leave a room through a door.

    Attributes:
        number: its place among the cases.
        plan: with the clutter.
        room: name of the room or corridor in which the robot is.
        door: through which it is to leave.
        start: pose of its centre.
    """

    number: int
    plan: FloorPlan
    room: str
    door: PlanDoor
    start: Pose

    @property
    def side(self) -> DoorSide:
        """The door from the side of the room."""
        return side_of(self.plan, self.door, self.plan.region(self.room))


def exit_cases(seed: int = SEED) -> Iterator[ExitCase]:
    """Cases without end, each of them possible.

    A flood fill over the poses of the wider body (`maps.reach`) leads from the start to behind the
    door, with all other doors closed.
    """
    rng, number = np.random.default_rng(seed), 0
    while True:
        name = "villa_hall" if rng.random() < VILLA_SHARE else OFFICES[rng.integers(len(OFFICES))]
        case = _drawn(number, load_floor_plan(name), rng)
        if case is not None and _is_possible(case):
            yield case
            number += 1


def side_of(plan: FloorPlan, door: PlanDoor, room: Region) -> DoorSide:
    """The side of a door on which a room lies."""
    side = DoorSide(door.start, door.end)
    before, behind = side.before(np.array([(0.1, 0.0), (-0.1, 0.0)])).tolist()
    is_before = room.polygon.distance(shapely.Point(before)) <= room.polygon.distance(
        shapely.Point(behind)
    )
    return side if is_before else side.opposite


def _drawn(number: int, plan: FloorPlan, rng: np.random.Generator) -> ExitCase | None:
    regions = plan.rooms + plan.corridors
    room = regions[rng.integers(len(regions))]
    doors = [door for door in plan.doors if door.counts(DoorRules()) and _touches(door, room)]
    if not doors:
        return None
    door = doors[rng.integers(len(doors))]
    for _ in range(rng.integers(*BOXES, endpoint=True)):
        plan = _with_box(plan, room, door.midpoint, rng)
    try:
        start = sample_pose(plan, WHEELCHAIR, rng, room, MARGIN)
    except ValueError:
        return None
    free = all(placement_error(plan, robot, start, MARGIN) is None for robot in ROBOTS.values())
    return ExitCase(number, plan, room.name, door, start) if free else None


def _touches(door: PlanDoor, room: Region) -> bool:
    return bool(room.polygon.dwithin(shapely.Point(door.midpoint), 0.05))


def _with_box(plan: FloorPlan, room: Region, door: Point, rng: np.random.Generator) -> FloorPlan:
    """The plan with one more box: near the door, on either side of it, or anywhere in the room."""
    west, south, east, north = room.polygon.bounds
    if rng.random() < 0.5:
        west, east = door[0] - NEAR_DOOR, door[0] + NEAR_DOOR
        south, north = door[1] - NEAR_DOOR, door[1] + NEAR_DOOR
    x, y = rng.uniform((west, south), (east, north))
    half_x, half_y = rng.uniform(*BOX_SIDES, 2) / 2
    upright = shapely.box(x - half_x, y - half_y, x + half_x, y + half_y)
    box: Polygon = rotate(upright, rng.uniform(0.0, 90.0))
    far = math.hypot(half_x, half_y) + GAP
    stands = box.distance(shapely.Point(door)) > DOORWAY_RADIUS and is_clear(plan, (x, y), far)
    if not stands or not plan.boundary.contains(box):
        return plan
    points = tuple((float(px), float(py)) for px, py in box.exterior.coords)
    return replace(plan, surfaces=(*plan.surfaces, Surface(points, Material.FURNITURE)))


def _is_possible(case: ExitCase) -> bool:
    """Whether the wider body gets through, its middle moving any way, with other doors closed."""
    x, y = case.door.midpoint
    area = case.plan.region(case.room).polygon.union(shapely.Point(x, y).buffer(1.0))
    window = shapely.box(*area.bounds).buffer(WINDOW, join_style="mitre")
    others = tuple(
        Surface((door.start, door.end)) for door in case.plan.doors if door.name != case.door.name
    )
    near = tuple(s for s in case.plan.surfaces if LineString(s.points).intersects(window))
    local = replace(case.plan, surfaces=near + others, corridors=(), boundary=window)
    found = reach(local, WHEELCHAIR.length, WHEELCHAIR.width, start=case.start[:2])
    [behind] = case.side.before(np.array([(-BEHIND, 0.0)])).tolist()
    return found.near(shapely.Point(behind), BEHIND_RADIUS)
