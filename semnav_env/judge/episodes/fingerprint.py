"""A fingerprint of the geometry of a floor plan, which shows whether the plan has changed."""

from __future__ import annotations

from hashlib import sha256

import numpy as np
from numpy.typing import NDArray

from semnav_env.world.maps import FloorPlan
from semnav_features.frames import FloatArray

FINGERPRINT_DIGITS = 16
"""Length of a fingerprint in hexadecimal digits: 64 bits, so that no two plans of a split share one
by chance."""

STEPS_PER_METRE = 1000
"""Steps to which coordinates are rounded, per metre: whole millimetres."""


def fingerprint(plan: FloorPlan) -> str:
    """The first `FINGERPRINT_DIGITS` of a SHA-256 of solid parts, doors and rooms.

    Coordinates are rounded to millimetres, so that every platform gives the same.
    """
    doors = "".join(f"{d.name}|{_whole((*d.start, *d.end))}|{d.open}\n" for d in plan.doors)
    rooms = "".join(f"{r.name}|{_whole(r.polygon.bounds)}\n" for r in plan.rooms)
    solid = "".join(map(str, _millimetres(plan.segments).tolist()))
    return sha256(f"{solid}\n{doors}{rooms}".encode()).hexdigest()[:FINGERPRINT_DIGITS]


def _whole(values: tuple[float, ...]) -> str:
    return f"{_millimetres(np.array(values)).tolist()}"


def _millimetres(metres: FloatArray) -> NDArray[np.int64]:
    return np.rint(metres * STEPS_PER_METRE).astype(np.int64)
