"""Finds the open leaf of a door: a straight piece of about its width that ends at a jamb."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.layout import AT_END, AT_START, NO_LEAF

MAX_HINGE_GAP = 0.12
"""Largest distance from an end of a leaf to the jamb that it hangs on, metres."""

MIN_LENGTH_RATIO, MAX_LENGTH_RATIO = 0.5, 1.15
"""Length of a leaf, in widths of the opening: a part of it may be hidden."""

MIN_LEAF_ANGLE = math.radians(20.0)
"""Least angle of a leaf to the wall and to the closed door, radians: what is flatter is wall."""


@kernel
def find_leaf(gap: Any, pieces: np.ndarray) -> tuple[int, float]:
    """Which jamb the leaf hangs on, and its angle to the closed door; see `elements.SceneLeaf`.

    Both ends of every piece are compared with both jambs; the nearest pair wins.

    Returns:
        `AT_START` or `AT_END` and radians, positive away from the scanner; `NO_LEAF` and 0 if
        no leaf is seen.
    """
    hinge, angle, nearest = NO_LEAF, 0.0, MAX_HINGE_GAP
    for k in range(len(pieces)):
        piece = pieces[k]
        if not MIN_LENGTH_RATIO * gap.width <= piece.length <= MAX_LENGTH_RATIO * gap.width:
            continue
        for end in range(4):
            first, at_start = end % 2 == 0, end < 2
            x, y = (piece.start_x, piece.start_y) if first else (piece.end_x, piece.end_y)
            jamb_x = gap.start_x if at_start else gap.end_x
            jamb_y = gap.start_y if at_start else gap.end_y
            dx, dy = x - jamb_x, y - jamb_y
            if dx * dx + dy * dy > 1.01 * MAX_HINGE_GAP**2:
                continue
            distance = math.hypot(dx, dy)
            leaf_to_door = leaf_angle(gap, piece, first, at_start)
            if (
                distance < nearest
                and MIN_LEAF_ANGLE <= abs(leaf_to_door) <= math.pi - MIN_LEAF_ANGLE
            ):
                hinge, angle, nearest = AT_START if at_start else AT_END, leaf_to_door, distance
    return hinge, angle


@kernel
def leaf_angle(gap: Any, piece: Any, first: bool, at_start: bool) -> float:
    """Angle from the closed door to a piece, both seen from a jamb; positive away from the scanner.

    Args:
        gap: the opening, the scanner on its left.
        piece: the leaf.
        first: whether its start is at the jamb, or its end.
        at_start: whether the jamb is the start of the opening.
    """
    sense = (1.0 if first else -1.0) * (1.0 if at_start else -1.0)
    along = sense * (piece.along_x * gap.along_x + piece.along_y * gap.along_y)
    away = piece.along_x * gap.along_y - piece.along_y * gap.along_x
    return math.atan2(away if first else -away, along)
