"""The contacts of a robot during a control period, noted by callbacks of the physics."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pymunk
from numba import types
from numba.np.numpy_support import carray
from pymunk._chipmunk import ffi, lib

from semnav_env.world.physics.chipmunk_functions import (
    ADDRESS,
    INDEX,
    address,
    pair_of,
    simple_function,
    vector_at,
    vector_of,
)
from semnav_env.world.physics.drive_record import DRIVE
from semnav_features.frames import MOST_CONTACTS
from semnav_features.kernels.compiling import callback_address

_STATIC, _MOST_POINTS = pymunk.Body.STATIC, 2  # of contact between two shapes

_bodies = pair_of("cpArbiterGetBodies")
_kind = simple_function("cpBodyGetType", INDEX, ADDRESS)
_points = simple_function("cpArbiterGetCount", INDEX, ADDRESS)
_impulse, _normal = vector_of("cpArbiterTotalImpulse"), vector_of("cpArbiterGetNormal")
_point = vector_at("cpArbiterGetPointB")


@dataclass(frozen=True)
class Contacts:
    """The contacts of the robot during one step.

    Attributes:
        count: solid segments touched, summed over the substeps.
        impulse: sum of the magnitudes of the impulses it received, N s.
    """

    count: int = 0
    impulse: float = 0.0


def note_contacts(space: pymunk.Space, record: np.ndarray, compiled: bool) -> None:
    """Let a space write the contacts of the robot into its record, dtype `DRIVE`.

    Args:
        space: the space with the robot's body.
        record: the record; it must live as long as the space is stepped.
        compiled: whether compiled code does it, for each pair of shapes in each substep; else
            Python, for machines on which compiled code cannot call Chipmunk.
    """
    if not compiled:
        space.on_collision(post_solve=_note_by_pymunk, data=record)
        return
    any_kind = int(ffi.cast("uintptr_t", ~0))
    handler = lib.cpSpaceAddCollisionHandler(space._space, any_kind, any_kind)
    handler.postSolveFunc = ffi.cast("cpCollisionPostSolveFunc", _compiled_callback())
    handler.userData = ffi.from_buffer(record)


@cache
def _compiled_callback() -> int:
    """Address of `_note`, which is compiled only where it can call Chipmunk."""
    return callback_address(_note, (ADDRESS, ADDRESS, types.voidptr), types.void)


def _note(arbiter: int, space: int, record: Any) -> None:
    """Called by Chipmunk for each pair of shapes that touch."""
    r = carray(record, 1, DRIVE)[0]
    r.touches += 1
    x, y = _impulse(arbiter)
    r.impulse += math.sqrt(x * x + y * y)
    first, second = _bodies(arbiter)
    is_first = first == r.body
    solid = _kind(second if is_first else first) == _STATIC
    if not solid or r.contact_count > MOST_CONTACTS - _MOST_POINTS:
        return
    x, y = _normal(arbiter)
    inward = math.atan2(y, x) if is_first else math.atan2(-y, -x)
    for k in range(_points(arbiter)):
        contact = r.contacts[r.contact_count]
        contact[0], contact[1] = _point(arbiter, k)
        contact[2] = inward
        r.contact_count += 1


def _note_by_pymunk(arbiter: pymunk.Arbiter, space: pymunk.Space, record: np.ndarray) -> None:
    """The callback of Pymunk that calls `_note`."""
    r = record[0]
    r["touches"] += 1
    x, y = arbiter.total_impulse
    r["impulse"] += math.sqrt(x * x + y * y)
    first, second = arbiter.bodies
    is_first = address(first._body) == r["body"]
    solid = (second if is_first else first).body_type == _STATIC
    if not solid or r["contact_count"] > MOST_CONTACTS - _MOST_POINTS:
        return
    met = arbiter.contact_point_set
    inward = met.normal.angle if is_first else (-met.normal).angle
    for point in met.points:
        r["contacts"][r["contact_count"]] = (*point.point_b, inward)
        r["contact_count"] += 1
