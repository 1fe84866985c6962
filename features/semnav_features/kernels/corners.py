"""Finds corners: where two walls meet, and where a wall may bend out of sight."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_features.elements import CornerKind
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.layout import END_BREAK, END_RUPTURE, START_BREAK, START_RUPTURE

OUTER, INNER, POTENTIAL = int(CornerKind.OUTER), int(CornerKind.INNER), int(CornerKind.POTENTIAL)

ENDS_APART, TOO_STRAIGHT, PLACE_TOO_FAR, WALL_GOES_ON = -1, -2, -3, -4
"""Why two walls make no corner: their ends are too far from each other, the angle between them is
too small, their lines meet too far from the ends, or one goes on behind the other's end."""

PARTNER_TRIALS = 3
"""Walls after a wall that are tried as the other side of its corner: a stub, or something in front
of the corner, may come first."""


@kernel
def find_corners(
    count: int, is_ring: bool, settings: Any, scratch: Any, corners: np.ndarray
) -> int:
    """Full corners where walls meet and potential corners at their loose ends.

    Writes to `scratch.corner_ends` which wall ends and which starts at each corner (or -1).

    Args:
        count: how many walls there are.
        is_ring: whether the first wall comes after the last one.
        settings: of the extractor.
        scratch: with the walls' pieces.
        corners: dtype `CORNER`, written.

    Returns:
        How many corners were written, in beam order.
    """
    join_ends(count, is_ring, settings, scratch)
    joints, found = scratch.joints, 0
    for k in range(count):
        wall, joint = scratch.pieces[scratch.wall_piece[k]], joints[k]
        if not joint.start_meets and wall.flags & (START_BREAK | START_RUPTURE):
            place = wall.start_x, wall.start_y
            found = write_potential(found, place, (-1, k), count, settings, scratch, corners)
        if joint.partner >= 0:
            corner = joint.x, joint.y, joint.kind
            found = write_corner(found, corner, (k, joint.partner), scratch, corners)
        elif wall.flags & (END_BREAK | END_RUPTURE):
            place = wall.end_x, wall.end_y
            found = write_potential(found, place, (k, -1), count, settings, scratch, corners)
    return found


@kernel
def join_ends(count: int, is_ring: bool, settings: Any, scratch: Any) -> None:
    """Pair the end of every wall with the start of the wall it meets, nearest in order first.

    Written to `scratch.joints`; an end or a start belongs to one corner at most, and two corners
    at one place are one.
    """
    joints = scratch.joints
    for k in range(count):
        joints[k].partner, joints[k].start_meets = -1, 0
    for step in range(1, min(PARTNER_TRIALS, count - 1) + 1):
        for k in range(count if is_ring else count - step):
            partner = k + step if k + step < count else k + step - count
            if joints[k].partner >= 0 or joints[partner].start_meets:
                continue
            a = scratch.pieces[scratch.wall_piece[k]]
            b = scratch.pieces[scratch.wall_piece[partner]]
            kind, x, y = full_corner(a, b, settings)
            if kind >= 0 and not meets_near(x, y, count, settings, joints):
                joints[k].partner, joints[partner].start_meets = partner, 1
                joints[k].kind, joints[k].x, joints[k].y = kind, x, y


@kernel
def meets_near(x: float, y: float, count: int, settings: Any, joints: np.ndarray) -> bool:
    """Whether a full corner that was found already is at this place."""
    for k in range(count):
        joint = joints[k]
        if joint.partner >= 0 and is_same_place(joint.x - x, joint.y - y, settings):
            return True
    return False


@kernel
def is_same_place(dx: float, dy: float, settings: Any) -> bool:
    """Whether two corners that far apart are one."""
    return bool(dx * dx + dy * dy < settings.corner_fuse**2)


@kernel
def full_corner(a: Any, b: Any, settings: Any) -> tuple[int, float, float]:
    """Kind and place of the corner where one wall ends and a later one starts.

    The place is the intersection of the lines (Barbret section 6.2.1), which must be near the
    end of the first and the start of the second; the ends must be near each other and the angle
    between the walls large enough (Weerakoon et al., section II D). Both walls have the scanner on
    their left. So where the second bends to the left, the corner points away from the scanner
    (outer), and where it bends to the right, at the scanner (inner): what Barbret (3.1) decides by
    distances. A wall that is seen to go on past the place, while the other ends before it, lies
    behind the other; the beams between them pass to it.

    Returns:
        The kind and the place; without a corner one of `ENDS_APART`, `TOO_STRAIGHT`,
        `PLACE_TOO_FAR` and `WALL_GOES_ON` in place of the kind.
    """
    gap_x, gap_y = b.start_x - a.end_x, b.start_y - a.end_y
    reach = settings.corner_gap
    if gap_x * gap_x + gap_y * gap_y > 4.0 * reach * reach:
        return ENDS_APART, 0.0, 0.0
    sine = a.along_x * b.along_y - a.along_y * b.along_x
    cosine = a.along_x * b.along_x + a.along_y * b.along_y
    if math.atan2(abs(sine), cosine) < settings.corner_angle or abs(sine) < 1e-3:
        return TOO_STRAIGHT, 0.0, 0.0
    past_a = (gap_x * b.along_y - gap_y * b.along_x) / sine
    past_b = (gap_x * a.along_y - gap_y * a.along_x) / sine
    if abs(past_a) > reach or abs(past_b) > reach:
        return PLACE_TOO_FAR, 0.0, 0.0
    beyond, short = settings.confidence * settings.sigma, settings.corner_fuse
    if (past_a < -beyond and past_b < -short) or (past_b > beyond and past_a > short):
        return WALL_GOES_ON, 0.0, 0.0
    kind = OUTER if sine > 0.0 else INNER
    return kind, a.end_x + past_a * a.along_x, a.end_y + past_a * a.along_y


@kernel
def write_potential(
    found: int,
    place: tuple[float, float],
    walls: tuple[int, int],
    count: int,
    settings: Any,
    scratch: Any,
    corners: np.ndarray,
) -> int:
    """Append a potential corner unless there is one at its place; returns how many there are.

    Args:
        found: how many there were before.
        place: of the corner.
        walls: those that end and start there, one of them -1.
        count: how many walls there are.
        settings: of the extractor.
        scratch: with `joints`.
        corners: written.
    """
    x, y = place
    if meets_near(x, y, count, settings, scratch.joints):
        return found
    for k in range(found):
        if is_same_place(corners[k].x - x, corners[k].y - y, settings):
            return found
    return write_corner(found, (x, y, POTENTIAL), walls, scratch, corners)


@kernel
def write_corner(
    found: int,
    corner: tuple[float, float, int],
    walls: tuple[int, int],
    scratch: Any,
    corners: np.ndarray,
) -> int:
    """Append a corner if there is room; returns how many there are now.

    Args:
        found: how many there were before.
        corner: place and kind.
        walls: those that end and start there; -1 for none.
        scratch: with `corner_ends`, written.
        corners: written.
    """
    corner_ends = scratch.corner_ends
    if found == min(len(corners), len(corner_ends)):
        return found
    corners[found].x, corners[found].y, corners[found].kind = corner
    corner_ends[found, 0], corner_ends[found, 1] = walls
    return found + 1
