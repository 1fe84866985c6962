"""Which doors of a floor plan are in view, and how much of them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from semnav_env.world.maps.doorways import DRAWING_TOLERANCE
from semnav_env.world.maps.floor_plan import FloorPlan, Material, PlanDoor
from semnav_features.frames import FloatArray, Point, Pose, to_local
from semnav_features.scene import Door, SceneLeaf
from studies.truth.sweep import Outline, distances_along, points_at

MIN_VISIBLE_SHARE = 1e-6
"""A smaller share of an opening in view is a matter of rounding."""


@dataclass(frozen=True)
class OpenDoor:
    """An open door of a floor plan and the leaf that hangs in it, world frame.

    Attributes:
        door: the door.
        hinge: the jamb that the leaf hangs at, if there is one.
        tip: the other end of the leaf.
        surface: number of the leaf among the plan's surfaces.
    """

    door: PlanDoor
    hinge: Point | None = None
    tip: Point | None = None
    surface: int = -1


def open_doors(floor_plan: FloorPlan) -> list[OpenDoor]:
    """The open doors of a floor plan."""
    leaves = [
        (number, ends)
        for number, surface in enumerate(floor_plan.surfaces)
        if surface.material is Material.LEAF
        for ends in (surface.points, surface.points[::-1])
    ]
    return [_with_leaf(door, leaves) for door in floor_plan.doors if door.open]


def _with_leaf(door: PlanDoor, leaves: list[tuple[int, tuple[Point, ...]]]) -> OpenDoor:
    for jamb in (door.start, door.end):
        for number, points in leaves:
            if math.dist(points[0], jamb) <= DRAWING_TOLERANCE:
                return OpenDoor(door, jamb, points[-1], number)
    return OpenDoor(door)


def see_door(
    door: OpenDoor,
    lidar: Pose,
    outline: Outline,
    marks: FloatArray,
    surfaces: set[int],
    range_max: float,
) -> Door | None:
    """The door in the lidar frame, directed with the lidar on its left, if any of it is seen.

    Args:
        door: world frame.
        lidar: its pose in the world.
        outline: what it sees.
        marks: directions in which the view of an opening may begin or end, radians.
        surfaces: numbers of those that are in view, for the leaf.
        range_max: nothing is seen beyond it, metres.
    """
    start, end = to_local(lidar, door.door.start), to_local(lidar, door.door.end)
    if start[0] * end[1] - start[1] * end[0] < 0.0:
        start, end = end, start
    share = visible_share(start, end, outline, marks, range_max)
    if share < MIN_VISIBLE_SHARE:
        return None
    leaf = _leaf(door, lidar, start, end) if door.surface in surfaces else None
    return Door(start, end, door.door.name, leaf=leaf, visible=share)


def visible_share(
    start: Point, end: Point, outline: Outline, marks: FloatArray, range_max: float
) -> float:
    """Share of the opening from `start` to `end`, counter-clockwise, that is in view."""
    first = math.atan2(start[1], start[0])
    span = (math.atan2(end[1], end[0]) - first) % math.tau
    chord = np.array([(*start, *end)])
    inside = np.sort((marks - first) % math.tau)
    edges = first + np.concatenate(([0.0], inside[inside < span], [span]))
    middles = 0.5 * (edges[:-1] + edges[1:])
    seen = distances_along(chord, middles)[:, 0] < np.minimum(outline.ranges(middles), range_max)
    rows = np.zeros(len(edges), dtype=np.intp)
    steps = np.hypot(*np.diff(points_at(chord, rows, edges), axis=0).T)
    return float(min(1.0, steps[seen].sum() / math.dist(start, end)))


def _leaf(door: OpenDoor, lidar: Pose, start: Point, end: Point) -> SceneLeaf:
    assert door.hinge is not None
    assert door.tip is not None
    hinge, tip = to_local(lidar, door.hinge), to_local(lidar, door.tip)
    at_start = math.dist(hinge, start) < math.dist(hinge, end)
    other = end if at_start else start
    closed = math.atan2(other[1] - hinge[1], other[0] - hinge[0])
    turned = math.remainder(math.atan2(tip[1] - hinge[1], tip[0] - hinge[0]) - closed, math.tau)
    return SceneLeaf(at_start, -turned if at_start else turned)
