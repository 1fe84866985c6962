"""One robot's drive for one control period: limits, physics, motion."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_env.world.physics.chipmunk import run_substeps
from semnav_env.world.physics.free_motion import Solids, move_freely
from semnav_features.frames import relative, wrap_angle
from semnav_features.kernels.compiling import kernel


@kernel
def drive(record: np.ndarray, solids: Solids) -> None:
    """Drive a robot for one control period.

    Args:
        record: dtype `DRIVE`; where its `space` is 0, the robot has been moved on already.
        solids: of `culling_around`.
    """
    if record[0].space != 0 and not demand_velocity(record, solids):
        run_substeps(record)
    settle(record)


@kernel
def demand_velocity(record: np.ndarray, solids: Solids) -> bool:
    """Demand one velocity of the control body for a control period.

    Returns:
        Whether the robot has been moved with it, for it can touch nothing: `move_freely`.

    A substep of Chipmunk moves the body with the velocity it has and then finds the next one,
    so what is demanded now holds from the second substep to the first of the next period. It
    is demanded in the heading that the robot will have in the middle of that time; this makes
    arcs exact to second order.
    """
    r = record[0]
    r.touches, r.impulse, r.contact_count = 0, 0.0, 0
    forward, left, turn = _approach(r)
    middle = r.motion.angle + r.axle_velocity.turn * r.dt + 0.5 * turn * r.period
    c, s = math.cos(middle), math.sin(middle)
    r.demand.vx, r.demand.vy = c * forward - s * left, s * forward + c * left
    r.demand.turn = turn
    return move_freely(record, solids)


@kernel
def _approach(r: Any) -> tuple[float, float, float]:
    """The velocity nearest to the commanded one that the limits allow in one period."""
    forward, turn = r.axle_velocity.forward, r.axle_velocity.turn
    left = r.axle_velocity.left if r.max_sideways_speed > 0.0 else 0.0
    return (
        forward + _cut(_cut(r.command.forward, r.max_speed) - forward, r.max_change),
        left + _cut(_cut(r.command.left, r.max_sideways_speed) - left, r.max_change),
        turn + _cut(_cut(r.command.turn, r.max_turn_rate) - turn, r.max_turn_change),
    )


@kernel
def _cut(value: float, limit: float) -> float:
    return limit if value > limit else -limit if value < -limit else value


@kernel
def settle(record: np.ndarray) -> None:
    """Find pose and velocity of the footprint's centre, and what it touches in the robot frame.

    The velocity is in the heading for which it was demanded, see `demand_velocity`.
    """
    r = record[0]
    heading, turn = r.motion.angle, r.motion.turn
    c, s = math.cos(heading), math.sin(heading)
    r.pose.x, r.pose.y = r.motion.x - r.axle * c, r.motion.y - r.axle * s
    r.pose.heading = wrap_angle(heading)
    middle = heading + turn * (r.dt - 0.5 * r.period)
    c, s = math.cos(middle), math.sin(middle)
    forward, left = c * r.motion.vx + s * r.motion.vy, c * r.motion.vy - s * r.motion.vx
    r.axle_velocity.forward, r.axle_velocity.left, r.axle_velocity.turn = forward, left, turn
    r.velocity.forward, r.velocity.left, r.velocity.turn = forward, left - r.axle * turn, turn
    _take_contacts_into_robot_frame(r)


@kernel
def _take_contacts_into_robot_frame(r: Any) -> None:
    pose = r.pose.x, r.pose.y, r.pose.heading
    for k in range(r.contact_count):
        contact = r.contacts[k]
        x, y, heading = relative(pose, (contact[0], contact[1], contact[2]))
        contact[0], contact[1], contact[2] = x, y, heading


@kernel
def lost_motion(record: np.ndarray) -> tuple[float, float, float]:
    """Motion of the footprint's centre that the drive demanded and contacts prevented.

    Metres forward, metres to the left, radians; zeros where the robot touches nothing.
    """
    r = record[0]
    if r.touches == 0:
        return 0.0, 0.0, 0.0
    c, s = math.cos(r.motion.angle), math.sin(r.motion.angle)
    forward = c * r.demand.vx + s * r.demand.vy - r.axle_velocity.forward
    left = c * r.demand.vy - s * r.demand.vx - r.axle_velocity.left
    turn = r.demand.turn - r.axle_velocity.turn
    return forward * r.period, (left - r.axle * turn) * r.period, turn * r.period
