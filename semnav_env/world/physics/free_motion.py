"""Moves a robot that can touch nothing, by its joints and without the physics engine.

Chipmunk spends most of a substep on finding that nothing is touched. Where no wall is near, one
check of the walls of the robot's cell decides this for a whole control period. Then the joints
reach the demanded velocity within one substep, unless this needs more than their force, and the
robot moves as Chipmunk would have moved it, to the last bit. Chipmunk's body is updated when
Chipmunk is called again.
"""

from __future__ import annotations

import math
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from semnav_env.robots import RobotSpec
from semnav_env.world.lidar.culling import Culling, cell_of, shared_culling
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_env.world.physics.drive_record import ROUNDING, longest_way
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

Solids: TypeAlias = tuple[np.ndarray, NDArray[np.int64], FloatArray]
"""The solid segments near each place: `Culling` as (grid, starts, ends)."""


def culling_around(floor_plan: FloorPlan, robot: RobotSpec, period: float) -> Culling:
    """For each place of a plan, the segments that a robot may touch within a control period."""
    reach = math.hypot(robot.length / 2, robot.width / 2)
    reach += math.sqrt(2.0) * longest_way(robot, period)
    return shared_culling(floor_plan, reach, glass=True)


@kernel
def move_freely(record: np.ndarray, solids: Solids) -> bool:
    """Move a robot for one control period if it can touch nothing; returns whether it was moved.

    Args:
        record: dtype `DRIVE`, with a demanded velocity.
        solids: of `culling_around`.
    """
    r = record[0]
    if not (r.follows and _joints_suffice(r)) or _is_something_near(r, solids):
        return False
    motion, demand = r.motion, r.demand
    for _ in range(r.substeps):
        motion.x += motion.vx * r.dt
        motion.y += motion.vy * r.dt
        motion.angle += motion.turn * r.dt
        motion.vx, motion.vy, motion.turn = demand.vx, demand.vy, demand.turn
    r.is_ahead = 1
    return True


@kernel
def _joints_suffice(r: Any) -> bool:
    """Whether the joints have the force for the demanded velocity within one substep."""
    x, y = r.demand.vx - r.motion.vx, r.demand.vy - r.motion.vy
    turn = abs(r.demand.turn - r.motion.turn)
    return bool(x * x + y * y < r.joint_change * r.joint_change and turn < r.joint_turn_change)


@kernel
def _is_something_near(r: Any, solids: Solids) -> bool:
    """Whether the footprint, grown by the motion of its corners, meets a solid segment.

    The separating axes of a segment and a rectangle are those of the rectangle and the segment's
    normal. Segments are moved into the frame of the rectangle.
    """
    grid, starts, ends = solids
    x, y = r.pose.x, r.pose.y
    c, s = math.cos(r.motion.angle), math.sin(r.motion.angle)
    way = _way(r)
    length, width = r.half_length + way, r.half_width + way
    cell: int = cell_of(grid, x, y)
    near = way > r.longest_way
    for k in range(np.uint64(starts[cell]), np.uint64(starts[cell + 1])):
        half_x, half_y = 0.5 * (ends[2, k] - ends[0, k]), 0.5 * (ends[3, k] - ends[1, k])
        off_x, off_y = ends[0, k] + half_x - x, ends[1, k] + half_y - y
        along, across = c * half_x + s * half_y, c * half_y - s * half_x
        ahead, beside = c * off_x + s * off_y, c * off_y - s * off_x
        near |= (
            (abs(ahead) <= length + abs(along))
            & (abs(beside) <= width + abs(across))
            & (abs(along * beside - across * ahead) <= length * abs(across) + width * abs(along))
        )
    return bool(near)


@kernel
def _way(r: Any) -> float:
    """Largest motion of a corner in this control period, metres."""
    before = math.sqrt(r.motion.vx * r.motion.vx + r.motion.vy * r.motion.vy)
    demanded = math.sqrt(r.demand.vx * r.demand.vx + r.demand.vy * r.demand.vy)
    turn = max(abs(r.motion.turn), abs(r.demand.turn))
    return float(ROUNDING + r.period * (max(before, demanded) + turn * r.radius))
