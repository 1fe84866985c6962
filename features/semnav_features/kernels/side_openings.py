"""Tells where the side of a corridor opens into another one, and not into a room.

In the frame of the axis x runs along the corridor and y to its left.
"""

from __future__ import annotations

import math

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.corridor_rays import PROBE_SPACING, PROBED_BEHIND
from semnav_features.kernels.narrowings import leads_into_arm

MIN_OPENING_WIDTH = 1.35
"""Least length for which a side steps back at an opening, metres; a doorway is shorter."""

MIN_EDGED_OPENING_WIDTH = 1.25
"""Least length of an opening from both of whose edges walls lead out, metres."""

MIN_BEND_WIDTH = 0.85
"""Least length of an opening at the end of the corridor from which the wall across leads out, the
mouth of the narrowest corridor, metres: elsewhere it would be a doorway."""

MIN_ARM_WIDTH = 0.75
"""Least length of an opening that leads into an arm, between both of whose sides it lies, metres:
that of the narrowest corridor, 0.9 m, of which one probe may miss the opening."""

MAX_LEAF_LENGTH = 1.2
"""A wall must lead out this far at an edge of an opening, metres: farther than any door leaf."""

EDGE_START, EDGE_TOLERANCE = 0.6, 0.25
"""A wall that leads out of an opening begins at most this far behind the side, and lies at most
that far from the edge along the axis, metres."""

OPENING = np.dtype([("left", "?"), ("near", "f8"), ("far", "f8"), ("offset", "f8")])
"""An opening: whether on the left side, its near and far edge along the axis, and the distance of
its side from the axis, metres."""

MAX_OPENINGS = 32
"""More openings along a corridor are left out."""


@kernel
def note_opening(
    solid: FloatArray,
    sign: float,
    first: int,
    last: int,
    offset: float,
    openings: np.ndarray,
    count: int,
    is_at_end: bool,
    slack: float,
) -> int:
    """Note the probes [first, last) as an opening, if wide and walls lead out of its edges.

    Args:
        solid: walls and doors in the frame of the axis.
        sign: 1 for the left side, -1 for the right.
        first: probe at which the side stepped back.
        last: probe at which it is there again.
        offset: distance of the side from the axis before, metres.
        openings: written, in row `count`.
        count: of openings so far.
        is_at_end: whether the corridor ends where the opening does.
        slack: added to the least lengths of openings, metres.

    Returns:
        How many openings there are now.
    """
    near = (first - 0.5) * PROBE_SPACING - PROBED_BEHIND
    far = (last - 0.5) * PROBE_SPACING - PROBED_BEHIND
    if far - near < MIN_ARM_WIDTH + slack or count == len(openings):
        return count
    nearer, farther = _leads_out(solid, sign, near, offset), _leads_out(solid, sign, far, offset)
    least = MIN_OPENING_WIDTH if nearer or farther else math.inf
    if nearer and farther:
        least = MIN_EDGED_OPENING_WIDTH
    if farther and is_at_end:
        least = MIN_BEND_WIDTH
    if far - near < min(least, MIN_OPENING_WIDTH) + slack:
        if not _leads_into_arm(solid, near, far, sign * offset):
            return count
    elif far - near < least + slack:
        return count
    opening = openings[count]
    opening.left, opening.near, opening.far, opening.offset = sign > 0.0, near, far, offset
    return count + 1


@kernel
def _leads_into_arm(solid: FloatArray, near: float, far: float, side: float) -> bool:
    """Whether an arm leads outwards from the stretch [near, far] of the side at y = `side`."""
    mouth = np.empty(4)
    mouth[0], mouth[1], mouth[2], mouth[3] = near, side, far, side
    return leads_into_arm(mouth, solid, 0.5 * (near + far), 0.0)


@kernel
def _leads_out(solid: FloatArray, sign: float, edge: float, offset: float) -> bool:
    """Whether a wall or a door leads away from the axis at x = `edge`, from y = `offset` on.

    For the right side the frame is mirrored (`sign` is -1), so that y always grows outwards.
    """
    for i in range(len(solid)):
        x1, y1, x2, y2 = solid[i, 0], sign * solid[i, 1], solid[i, 2], sign * solid[i, 3]
        if y2 < y1:
            x1, y1, x2, y2 = x2, y2, x1, y1
        is_along = y2 - y1 <= abs(x2 - x1)
        if is_along or not (y1 < offset + EDGE_START and y2 > offset + MAX_LEAF_LENGTH):
            continue
        beside = x1 + (x2 - x1) * max(0.0, offset - y1) / (y2 - y1)
        if abs(beside - edge) < EDGE_TOLERANCE:
            return True
    return False
