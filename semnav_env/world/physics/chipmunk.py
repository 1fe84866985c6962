"""A control period of Chipmunk's substeps, in compiled code or by way of Pymunk."""

from __future__ import annotations

import os
import platform
import sys
from functools import cache

import numpy as np
import pymunk
from numba import types

from semnav_env.robots import SPOT
from semnav_env.world.physics.bodies import driving_joints, robot_body, solid_space
from semnav_env.world.physics.chipmunk_functions import (
    ADDRESS,
    NUMBER,
    address,
    simple_function,
    vector_of,
)
from semnav_env.world.physics.contacts import note_contacts
from semnav_env.world.physics.drive_record import drive_record
from semnav_features.kernels.compiling import kernel

KNOWN_MACHINES = ("x86_64", "amd64", "aarch64", "arm64")
"""Where C functions take and return a structure of two doubles like two doubles; not on Windows."""

_step_space = simple_function("cpSpaceStep", types.void, ADDRESS, NUMBER)
_set_position = simple_function("cpBodySetPosition", types.void, ADDRESS, NUMBER, NUMBER)
_set_angle = simple_function("cpBodySetAngle", types.void, ADDRESS, NUMBER)
_set_velocity = simple_function("cpBodySetVelocity", types.void, ADDRESS, NUMBER, NUMBER)
_set_turn = simple_function("cpBodySetAngularVelocity", types.void, ADDRESS, NUMBER)
_angle = simple_function("cpBodyGetAngle", NUMBER, ADDRESS)
_turn = simple_function("cpBodyGetAngularVelocity", NUMBER, ADDRESS)
_position, _velocity = vector_of("cpBodyGetPosition"), vector_of("cpBodyGetVelocity")


@kernel
def run_substeps(record: np.ndarray) -> None:
    """Move the control body as demanded for a control period, and read the robot's motion.

    Args:
        record: dtype `DRIVE`, with the addresses of living objects.
    """
    r = record[0]
    if r.is_ahead:
        _set_position(r.body, r.motion.x, r.motion.y)
        _set_angle(r.body, r.motion.angle)
        _set_velocity(r.body, r.motion.vx, r.motion.vy)
        _set_turn(r.body, r.motion.turn)
    _set_velocity(r.control, r.demand.vx, r.demand.vy)
    _set_turn(r.control, r.demand.turn)
    for _ in range(r.substeps):
        _step_space(r.space, r.dt)
    r.motion.x, r.motion.y = _position(r.body)
    r.motion.vx, r.motion.vy = _velocity(r.body)
    r.motion.angle, r.motion.turn = _angle(r.body), _turn(r.body)
    note_following(record)


def run_substeps_by_pymunk(
    record: np.ndarray, space: pymunk.Space, control: pymunk.Body, body: pymunk.Body
) -> None:
    """The same as `run_substeps`, for machines on which that cannot be called."""
    if record["is_ahead"]:
        x, y, body.angle, *velocity, body.angular_velocity = record["motion"].item()
        body.position, body.velocity = (x, y), tuple(velocity)
    vx, vy, control.angular_velocity = record["demand"].item()
    control.velocity = vx, vy
    for _ in range(int(record["substeps"][0])):
        space.step(float(record["dt"][0]))
    read_motion(record, body)
    note_following(record)


@kernel
def note_following(record: np.ndarray) -> None:
    """Note whether the body, whose motion has been read, moves as demanded and touches nothing."""
    r = record[0]
    v, w = r.motion, r.demand
    r.follows = r.touches == 0 and v.vx == w.vx and v.vy == w.vy and v.turn == w.turn
    r.is_ahead = 0


def read_motion(record: np.ndarray, body: pymunk.Body) -> None:
    """Read the motion of a robot's body."""
    record["motion"] = (*body.position, body.angle, *body.velocity, body.angular_velocity)


@cache
def chipmunk_can_be_called() -> bool:
    """Whether compiled code can call Chipmunk here, with the same results as through Pymunk.

    `SEMNAV_PLAIN_PYMUNK=1` in the environment says that it shall not.
    """
    if os.environ.get("SEMNAV_PLAIN_PYMUNK") == "1":
        return False
    if sys.platform == "win32" or platform.machine().lower() not in KNOWN_MACHINES:
        return False
    return _meet_a_wall(compiled=True) == _meet_a_wall(compiled=False)


def _meet_a_wall(compiled: bool) -> bytes:
    """Drive a robot into a wall; returns how it moves then, and what it touched."""
    space = solid_space(np.array([[0.6, -1.0, 0.7, 1.0]]))
    control = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
    body, shape = robot_body(SPOT, (0.0, 0.0, 0.0))
    space.add(body, shape, control, *driving_joints(SPOT, control, body))
    record = drive_record(SPOT, 1.0, 20)
    record["space"], record["control"] = address(space._space), address(control._body)
    record["body"] = address(body._body)
    record["demand"] = (1.0, 0.25, 0.5)
    note_contacts(space, record, compiled)
    if compiled:
        run_substeps(record)
    else:
        run_substeps_by_pymunk(record, space, control, body)
    told = ("motion", "touches", "impulse", "contact_count", "contacts")
    return b"".join(record[name].tobytes() for name in told)
