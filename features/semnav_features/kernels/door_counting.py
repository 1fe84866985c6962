"""Tells which doors a corridor counts, and on which side of it."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.frames import FloatArray, to_local, wrap_angle
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.corridor_rays import PROBE_SPACING, PROBED_BEHIND
from semnav_features.kernels.corridor_survey import Frame

SIDE_SAMPLES = (0.15, 0.5, 0.85)
"""Places in an opening that are tested for lying on the side of a corridor, as shares of its width;
one of them is enough, for a wall may end in the opening."""

LEFT, RIGHT, AHEAD = range(3)
"""Where a door may count."""

COUNTED = np.dtype([("along", "f8"), ("door", "i8"), ("side", "i8"), ("outward", "f8")])
"""A counted door: where its middle lies along the axis, metres; its number; `LEFT`, `RIGHT` or
`AHEAD`; and the heading that leads through it, away from the corridor, radians."""


@kernel
def count_doors(
    doors: FloatArray,
    frame: Frame,
    half_width: float,
    end: float,
    left: FloatArray,
    right: FloatArray,
    side_offset: float,
    end_offset: float,
    counted: np.ndarray,
) -> int:
    """Find the doors that open onto a corridor, in the order in which they are given.

    Args:
        doors: x and y of the jambs, metres, shape (n, 4).
        frame: of the corridor's axis, in the frame of the doors.
        half_width: of the corridor, metres.
        end: where it ends along the axis, metres.
        left: distance of its left side at each probe, metres, shape (k,).
        right: the same of its right side.
        side_offset: how far a door may lie from the side that it is on, metres.
        end_offset: how far one across the corridor may lie from its end, metres.
        counted: written: those that count, dtype `COUNTED`, shape (n,).

    Returns:
        How many count.
    """
    count = 0
    for k in range(len(doors)):
        door = doors[k]
        x1, y1 = to_local(frame, (door[0], door[1]))
        x2, y2 = to_local(frame, (door[2], door[3]))
        along, offset = (x1 + x2) / 2, (y1 + y2) / 2
        if along < 0.0:
            continue
        if abs(x2 - x1) < abs(y2 - y1):
            if abs(along - end) > end_offset or abs(offset) > half_width:
                continue
            side, towards = AHEAD, 0.0
        else:
            side, distances = (LEFT, left) if offset > 0.0 else (RIGHT, right)
            if not _is_on_the_side(distances, (x1, y1, x2, y2), side_offset):
                continue
            towards = math.copysign(math.pi / 2, offset)
        normal = math.atan2(x2 - x1, -(y2 - y1))
        if math.cos(normal - towards) < 0.0:
            normal += math.pi
        row = counted[count]
        row.along, row.door, row.side = along, k, side
        row.outward = wrap_angle(frame[2] + normal)
        count += 1
    return count


@kernel
def _is_on_the_side(side: FloatArray, door: tuple[float, float, float, float], most: float) -> bool:
    """Whether a ray from the axis to the side meets the door first, somewhere along it.

    Args:
        side: its distance at each probe, metres.
        door: its jambs in the frame of the axis, metres.
        most: how far the door may lie from the side, metres.
    """
    x1, y1, x2, y2 = door
    for share in SIDE_SAMPLES:
        along, offset = x1 + share * (x2 - x1), y1 + share * (y2 - y1)
        probe = round((along + PROBED_BEHIND) / PROBE_SPACING)
        if 0 <= probe < len(side) and abs(side[probe] - abs(offset)) < most:
            return True
    return False
