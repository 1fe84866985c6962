"""A short name for the geometry of a floor plan, by which a change of it is noticed."""

from __future__ import annotations

from hashlib import sha256

import numpy as np

from semnav_env.maps import FloorPlan

DIGITS = 16
"""Hexadecimal ones."""

PER_METRE = 1000
"""Coordinates count in whole millimetres."""


def fingerprint(plan: FloorPlan) -> str:
    """The first `DIGITS` of a SHA-256 over all that is solid, the doors and the named rooms.

    Coordinates are rounded to millimetres, so that it is the same on every platform.
    """
    doors = "".join(f"{d.name}|{_whole((*d.start, *d.end))}|{d.open}\n" for d in plan.doors)
    rooms = "".join(f"{r.name}|{_whole(r.polygon.bounds)}\n" for r in plan.rooms)
    solid = "".join(_whole(row) for row in plan.segments.tolist())
    return sha256(f"{solid}\n{doors}{rooms}".encode()).hexdigest()[:DIGITS]


def _whole(values: tuple[float, ...] | list[float]) -> str:
    return f"{np.rint(np.array(values) * PER_METRE).astype(np.int64).tolist()}"
