"""How contacts become pieces of walls, in compiled code."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray

from semnav_env.mind.belief.bump_limits import LIMITS, MOST_PIECES
from semnav_env.mind.grounding.crossing import first_crossed
from semnav_features.frames import (
    MOST_CONTACTS,
    Contact,
    FloatArray,
    Point,
    Pose,
    compose,
    to_local,
    to_parent,
)
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.rows import put_row

Ends = tuple[float, float, float, float]
"""X and y of the ends of a piece, metres."""

Bumps = tuple[FloatArray, NDArray[np.int64]]
"""Pieces, odometry frame, shape (`BUMP_ROOM`, 4), and how many of them are known, shape (1,)."""

BUMP_ROOM = MOST_PIECES + MOST_CONTACTS

_HALF, _GROWTH, _GAP = LIMITS.piece_length / 2, LIMITS.least_growth, LIMITS.piece_gap
_LINE_OFFSET, _LINE_SLOPE = LIMITS.line_offset, LIMITS.line_slope
_LOOK_DEPTH, _SEEN_DEPTH, _SEEN_BEAMS = LIMITS.look_depth, LIMITS.seen_depth, LIMITS.seen_beams


@kernel
def note_contacts(
    bumps: Bumps,
    contacts: FloatArray,
    ranges: FloatArray,
    limits: np.ndarray,
    mount: Pose,
    pose: Pose,
) -> bool:
    """Take in the contacts of one step; returns whether something new is known.

    Args:
        bumps: what is known, and is added to.
        contacts: of the robot, robot frame, shape (n, 3), at most `MOST_CONTACTS`.
        ranges: of the scan from the same place, metres.
        limits: `LidarSpec.sensor`.
        mount: pose of the lidar in the robot frame.
        pose: of the robot, odometry frame.
    """
    known, used = bumps
    unseen, count = np.empty((len(contacts), 4)), 0
    for k in range(len(contacts)):
        contact = contacts[k, 0], contacts[k, 1], contacts[k, 2]
        if not _is_seen(contact, ranges, limits[0], mount):
            count = _unite(unseen, count, _piece(compose(pose, contact)), math.inf)
    fresh = 0
    for k in range(count):
        if not _is_covered(_row(unseen, k), known, used[0]):
            put_row(unseen, fresh, unseen[k])
            fresh += 1
    if fresh:
        _learn(bumps, unseen[:fresh])
    return fresh > 0


@kernel
def forget_passed(bumps: Bumps, before: Pose, after: Pose) -> None:
    """Forget what the robot's centre goes through from one pose to the next, odometry frame."""
    known, used = bumps
    k = 0
    while used[0] and k >= 0:
        k = first_crossed(known[: used[0]], before[0], before[1], after[0], after[1])
        if k >= 0:
            _drop(bumps, k, 1)


@kernel
def _learn(bumps: Bumps, fresh: FloatArray) -> None:
    """Unite all pieces anew, and forget the oldest if there are too many."""
    known, used = bumps
    before, count = used[0], 0
    for k in range(len(fresh)):
        put_row(known, before + k, fresh[k])
    for k in range(before + len(fresh)):
        count = _unite(known, count, _row(known, k), _GAP)
    used[0] = count
    if count > MOST_PIECES:
        _drop(bumps, 0, count - MOST_PIECES)


@kernel
def _drop(bumps: Bumps, first: int, count: int) -> None:
    """Forget some pieces that follow each other."""
    known, used = bumps
    used[0] -= count
    for k in range(first, used[0]):
        put_row(known, k, known[k + count])


@kernel
def _is_seen(contact: Contact, ranges: FloatArray, limits: Any, mount: Pose) -> bool:
    """Whether the beams that look at a contact, robot frame, end there; NaN ends nowhere."""
    angle_min, increment = limits.angle_min, limits.angle_increment
    x, y = to_local(mount, to_parent(contact, (_LOOK_DEPTH, 0.0)))
    bearing = (math.atan2(y, x) - angle_min) % math.tau
    beam, beams = int(np.rint(bearing / increment)), len(ranges)
    around = beams * increment > math.tau - 1e-6
    if not around and (beam - _SEEN_BEAMS < 0 or beam + _SEEN_BEAMS >= beams):
        return False
    nearest = math.inf
    for k in range(beam - _SEEN_BEAMS, beam + _SEEN_BEAMS + 1):
        measured = ranges[k % beams]
        if math.isnan(measured):
            return False
        nearest = min(nearest, measured)
    return nearest < math.hypot(x, y) + _SEEN_DEPTH


@kernel
def _is_covered(piece: Ends, known: FloatArray, count: int) -> bool:
    """Whether a piece adds hardly anything to one that is known."""
    for k in range(count):
        other = _row(known, k)
        one, whole = _joined(other, piece, _GAP)
        if one and along(whole)[1] < along(other)[1] + _GROWTH:
            return True
    return False


@kernel
def _unite(pieces: FloatArray, count: int, piece: Ends, gap: float) -> int:
    """Add a piece to the first `count`, made one with those that are on its line and near.

    Returns how many there are then. They are kept in their order, the new one last.
    """
    kept = 0
    for k in range(count):
        other = _row(pieces, k)
        one, whole = _joined(other, piece, gap)
        if one:
            piece = whole
        else:
            _write(pieces, kept, other)
            kept += 1
    _write(pieces, kept, piece)
    return kept + 1


@kernel
def _joined(one: Ends, other: Ends, gap: float) -> tuple[bool, Ends]:
    """Whether two pieces are on one line and near, and both as one, along the first."""
    frame, length = along(one)
    (first, offset), (last, last_offset) = seen_from(frame, other)
    level = max(abs(offset), abs(last_offset)) < _LINE_OFFSET
    parallel = abs(last_offset - offset) <= _LINE_SLOPE * (last - first)
    if not (level and parallel and first < length + gap and last > -gap):
        return False, other
    x1, y1 = to_parent(frame, (min(first, 0.0), 0.0))
    x2, y2 = to_parent(frame, (max(last, length), 0.0))
    return True, (x1, y1, x2, y2)


@register_jitable
def along(ends: Ends) -> tuple[Pose, float]:
    """The frame whose x runs along a line from its start, and the line's length."""
    x1, y1, x2, y2 = ends
    return (x1, y1, math.atan2(y2 - y1, x2 - x1)), math.hypot(x2 - x1, y2 - y1)


@register_jitable
def seen_from(frame: Pose, ends: Ends) -> tuple[Point, Point]:
    """Both ends of a line in a frame, that with the smaller x first."""
    one, other = to_local(frame, (ends[0], ends[1])), to_local(frame, (ends[2], ends[3]))
    return (one, other) if one <= other else (other, one)


@kernel
def _piece(contact: Pose) -> Ends:
    """The piece of wall across a contact."""
    x1, y1 = to_parent(contact, (0.0, -_HALF))
    x2, y2 = to_parent(contact, (0.0, _HALF))
    return x1, y1, x2, y2


@kernel(inline=True)
def _row(pieces: FloatArray, k: int) -> Ends:
    return pieces[k, 0], pieces[k, 1], pieces[k, 2], pieces[k, 3]


@kernel(inline=True)
def _write(pieces: FloatArray, k: int, piece: Ends) -> None:
    pieces[k, 0], pieces[k, 1], pieces[k, 2], pieces[k, 3] = piece
