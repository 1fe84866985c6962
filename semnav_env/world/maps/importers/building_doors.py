"""The doors of an imported building: labelled ones, others between two places or across a hall."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import numpy as np
import shapely

from semnav_env.world.maps.floor_plan import FloorPlan, Material, PlanDoor, Surface
from semnav_env.world.maps.importers.fitting import fit_door
from semnav_env.world.maps.importers.gaps import LEAST_DOORWAY_DISTANCE, apart, find_doorways
from semnav_env.world.maps.importers.labels import DoorLabel
from semnav_env.world.maps.importers.narrowings import find_narrowings
from semnav_env.world.maps.rules import FloorPlanError, check_door, check_doorway
from semnav_features.frames import FloatArray, Point, middle_of


def with_doors(
    plan: FloorPlan, labels: Sequence[DoorLabel], is_free: Callable[[Point], bool] | None
) -> tuple[FloorPlan, tuple[str, ...]]:
    """The plan with its doors, and why others were left out.

    Labelled doors come first; then the doorways between two places, and those across a hallway,
    that are no labelled doors.

    Args:
        plan: walls and places.
        labels: labels of doors, open or closed.
        is_free: whether a point is known to be free; None if there are no doors but the labelled.
    """
    doors: dict[str, PlanDoor] = {}
    lost: list[str] = []
    for label in labels:
        try:
            door = _labelled(label, plan)
            if label.name in doors:
                raise FloorPlanError(f"door {label.name!r}: there is another one of that name")
        except FloorPlanError as error:
            lost.append(str(error))
        else:
            doors[label.name] = door
    for door in _further(plan, labels, doors, is_free) if is_free else ():
        doors[door.name] = door
    return hang_doors(plan, tuple(doors.values())), tuple(lost)


def with_walls(plan: FloorPlan, straight: FloorPlan) -> FloorPlan:
    """The plan with other walls, which lie within some centimetres of its own.

    The jambs of its doors go along with the walls beside them, and the leaves with the jambs.

    Args:
        plan: a plan with doors.
        straight: the same walls without leaves, straightened.

    Raises:
        FloorPlanError: these walls leave too narrow a way through a door.
    """
    walls = without_leaves(plan)
    doors = tuple([moved_along(door, walls, straight) for door in plan.doors])
    moved = hang_doors(replace(walls, surfaces=straight.surfaces), doors)
    for door in moved.doors:
        check_doorway(door, moved)
    return moved


def hang_doors(walls: FloorPlan, doors: tuple[PlanDoor, ...]) -> FloorPlan:
    """The walls with doors, and with a leaf from jamb to jamb of those that are closed.

    Args:
        walls: a plan without doors.
        doors: those to hang.
    """
    leaves = [Surface((door.start, door.end), Material.LEAF) for door in doors if not door.open]
    return replace(walls, surfaces=(*walls.surfaces, *leaves), doors=doors)


def without_leaves(plan: FloorPlan) -> FloorPlan:
    """The walls of a plan: no doors and no leaves."""
    walls = tuple([each for each in plan.surfaces if each.material is not Material.LEAF])
    return replace(plan, surfaces=walls, doors=())


def moved_along(door: PlanDoor, before: FloorPlan, after: FloorPlan) -> PlanDoor:
    """A door moved along with the walls nearest to its jambs.

    Therefore a jamb on a wall stays on it, and a jamb that was marked beside a wall stays beside
    it.

    Args:
        door: among the walls as they were.
        before: those walls, without leaves.
        after: the same walls, somewhat moved, without leaves.
    """
    jambs = np.array((door.start, door.end))
    there = _nearest(before, jambs)
    (x1, y1), (x2, y2) = (_nearest(after, there) + (jambs - there)).tolist()
    return replace(door, start=(x1, y1), end=(x2, y2))


def _nearest(walls: FloorPlan, places: FloatArray) -> FloatArray:
    """The points of walls that are nearest to places, both of shape (n, 2)."""
    points = shapely.points(places)
    lines = walls.solids.geometries[walls.solids.nearest(points)]
    return np.asarray(shapely.get_coordinates(shapely.shortest_line(lines, points))[::2])


def _labelled(label: DoorLabel, plan: FloorPlan) -> PlanDoor:
    fit = fit_door(label, plan.solids)
    if fit is None:
        raise FloorPlanError(f"door {label.name!r}: no wall beside one of its jambs")
    door = corridor_to_the_left(PlanDoor(label.name, fit.start, fit.end, fit.open), plan)
    check_door(door)
    if door.open:
        check_doorway(door, plan)
    return door


def _further(
    plan: FloorPlan,
    labels: Sequence[DoorLabel],
    doors: dict[str, PlanDoor],
    is_free: Callable[[Point], bool],
) -> Iterator[PlanDoor]:
    """Unlabelled doorways that keep the rules, with generated names."""
    taken = [(door.start, door.end) for door in doors.values()]
    middles = [middle_of(*ends) for ends in (*taken, *((each.start, each.end) for each in labels))]
    between = find_doorways(plan.regions, plan.solids, is_free)
    across = find_narrowings(plan.corridors, plan.solids, is_free)
    for doorway in apart([*between, *across]):
        if any(math.dist(doorway.midpoint, middle) <= LEAST_DOORWAY_DISTANCE for middle in middles):
            continue
        name, number = doorway.name, 2
        while name in doors:
            name, number = f"{doorway.name} ({number})", number + 1
        door = corridor_to_the_left(replace(doorway, name=name), plan)
        try:
            check_doorway(door, plan)
        except FloorPlanError:
            continue
        yield door


def corridor_to_the_left(door: PlanDoor, plan: FloorPlan) -> PlanDoor:
    """The door directed so that its corridor, if there is one, lies to the left."""
    (x1, y1), (x2, y2) = door.start, door.end
    right = door.midpoint[0] + (y2 - y1) / door.width, door.midpoint[1] - (x2 - x1) / door.width
    if any(shapely.contains_xy(hall.polygon, *right) for hall in plan.corridors):
        return replace(door, start=door.end, end=door.start)
    return door
