"""Raised plans whose every face is known, and a caster that tries all of them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from shapely import box

from semnav_env.robots import DepthCamera, DepthRig
from semnav_env.world.maps.floor_plan import FloorPlan, PlanDoor, Surface
from tests.support.small_plans import plan_of

DOOR = PlanDoor("door", (2.0, -0.45), (2.0, 0.45))
"""In the wall of `walled_door`, two metres ahead of the origin."""


def walled_door(*more: Surface, door: PlanDoor = DOOR) -> FloorPlan:
    """A wall at x = 2 with a door in it, and a room behind that ends at x = 4.5."""
    walls = (
        Surface(((2.0, -3.0), door.start)),
        Surface((door.end, (2.0, 3.0))),
        Surface(((2.0, 3.0), (4.5, 3.0), (4.5, -3.0), (2.0, -3.0))),
    )
    plan = plan_of(*walls, *more)
    return replace(plan, doors=(door,), boundary=box(-3.0, -3.0, 4.5, 3.0))


def exact_camera(columns: int = 40, rows: int = 30, **changes: object) -> DepthCamera:
    """A camera without errors, half a metre above the robot's centre, that looks ahead."""
    values = {
        "name": "exact",
        "position": (0.0, 0.0, 0.5),
        "yaw": 0.0,
        "tilt": 0.0,
        "columns": columns,
        "rows": rows,
        "across": 1.4,
        "up": 1.0,
        "range_min": 0.1,
        "range_max": 20.0,
        "missing": (0.0,) * 6,
    }
    return DepthCamera(**(values | changes))


def exact_rig(**changes: object) -> DepthRig:
    return DepthRig("exact", (exact_camera(**changes),))


def brute_force_inverse(corners: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """The largest reciprocal depth over all faces along (1, u, v), 0 where none is met.

    Each face is two triangles, each solved by Cramer's rule (Moeller and Trumbore 1997).
    """
    best = np.zeros(len(directions))
    triangles = [corners[:, (0, 1, 2)], corners[:, (0, 2, 3)]]
    for a, b, c in np.concatenate(triangles):
        edges = np.cross(directions, c - a)
        volume = edges @ (b - a)
        with np.errstate(divide="ignore", invalid="ignore"):
            first = edges @ -a / volume
            normal = np.cross(-a, b - a)
            second = directions @ normal / volume
            depth = normal @ (c - a) / volume
        meets = (first >= 0) & (second >= 0) & (first + second <= 1) & (depth > 0)
        best[meets] = np.maximum(best[meets], 1.0 / depth[meets])
    return best
