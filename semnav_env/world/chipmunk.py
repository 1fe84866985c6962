"""Chipmunk's functions, called from compiled code without Python in between.

Pymunk calls Chipmunk through cffi, which knows the addresses of its functions. Their names are
given to LLVM, so that compiled code finds them, also when it comes out of a cache.
"""

from __future__ import annotations

import platform
import sys
from functools import cache
from typing import Any

import llvmlite.binding
import numpy as np
import pymunk
from llvmlite import ir
from numba import njit, types
from numba.core import cgutils
from numba.extending import intrinsic
from pymunk._chipmunk import ffi, lib

from semnav_env.robots import SPOT
from semnav_env.world.bodies import driving_joints, robot_body, solid_space
from semnav_env.world.drive_record import drive_record

KNOWN_MACHINES = ("x86_64", "amd64", "aarch64", "arm64")
"""Where C functions take and return a structure of two doubles like two doubles; not on Windows."""

_NUMBER, _ADDRESS = types.float64, types.uint64


def address(pointer: Any) -> int:
    """Of what a cffi pointer points to."""
    return int(ffi.cast("uintptr_t", pointer))


def _function(name: str, result: Any, *arguments: Any) -> Any:
    """A function of Chipmunk for compiled code."""
    llvmlite.binding.add_symbol(name, address(ffi.addressof(lib, name)))
    return types.ExternalFunction(name, result(*arguments))


def _getter(name: str) -> Any:
    """A function of Chipmunk from a body to a vector, for compiled code."""
    llvmlite.binding.add_symbol(name, address(ffi.addressof(lib, name)))

    @intrinsic
    def call(typing_context: Any, body: Any) -> Any:
        def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
            vector = context.get_value_type(signature.return_type)
            kind = ir.FunctionType(vector, [values[0].type])
            return builder.call(cgutils.get_or_insert_function(builder.module, kind, name), values)

        return types.UniTuple(_NUMBER, 2)(_ADDRESS), generate

    return call


_step_space = _function("cpSpaceStep", types.void, _ADDRESS, _NUMBER)
_set_velocity = _function("cpBodySetVelocity", types.void, _ADDRESS, _NUMBER, _NUMBER)
_set_turn = _function("cpBodySetAngularVelocity", types.void, _ADDRESS, _NUMBER)
_angle = _function("cpBodyGetAngle", _NUMBER, _ADDRESS)
_turn = _function("cpBodyGetAngularVelocity", _NUMBER, _ADDRESS)
_position, _velocity = _getter("cpBodyGetPosition"), _getter("cpBodyGetVelocity")


@njit(cache=True, nogil=True, error_model="numpy")
def run_substeps(record: np.ndarray) -> None:
    """Move the control body as demanded for a control period, and read the robot's motion.

    Args:
        record: dtype `DRIVE`, with the addresses of living objects.
    """
    r = record[0]
    _set_velocity(r.control, r.demand.vx, r.demand.vy)
    _set_turn(r.control, r.demand.turn)
    for _ in range(r.substeps):
        _step_space(r.space, r.dt)
    r.motion.x, r.motion.y = _position(r.body)
    r.motion.vx, r.motion.vy = _velocity(r.body)
    r.motion.angle, r.motion.turn = _angle(r.body), _turn(r.body)


def run_substeps_by_pymunk(
    record: np.ndarray, space: pymunk.Space, control: pymunk.Body, body: pymunk.Body
) -> None:
    """The same as `run_substeps`, for machines on which that cannot be called."""
    vx, vy, control.angular_velocity = record["demand"].item()
    control.velocity = vx, vy
    for _ in range(int(record["substeps"][0])):
        space.step(float(record["dt"][0]))
    read_motion(record, body)


def read_motion(record: np.ndarray, body: pymunk.Body) -> None:
    """Read the motion of a robot's body."""
    record["motion"] = (*body.position, body.angle, *body.velocity, body.angular_velocity)


@cache
def chipmunk_can_be_called() -> bool:
    """Whether compiled code can call Chipmunk here, with the same results as through Pymunk."""
    if sys.platform == "win32" or platform.machine().lower() not in KNOWN_MACHINES:
        return False
    return _meet_a_wall(compiled=True) == _meet_a_wall(compiled=False)


def _meet_a_wall(compiled: bool) -> bytes:
    """Drive a robot into a wall; returns how it moves then."""
    space = solid_space(np.array([[0.6, -1.0, 0.7, 1.0]]))
    control = pymunk.Body(body_type=pymunk.Body.KINEMATIC)
    body, shape = robot_body(SPOT, (0.0, 0.0, 0.0))
    space.add(body, shape, control, *driving_joints(SPOT, control, body))
    record = drive_record(SPOT, 1.0, 20)
    record["space"], record["control"] = address(space._space), address(control._body)
    record["body"] = address(body._body)
    record["demand"] = (1.0, 0.25, 0.5)
    if compiled:
        run_substeps(record)
    else:
        run_substeps_by_pymunk(record, space, control, body)
    return record["motion"].tobytes()
