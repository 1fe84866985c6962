"""Guesses a scan's pose from corners alone, for scans that are far from each other."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from semnav_features.elements import CornerKind
from semnav_features.frames import ORIGIN, FloatArray, Pose, points_to_parent, wrap_angle
from semnav_features.mapping.corner_sightings import CornerSighting

_SAME_PLACE, _SAME_HEADING = 0.2, math.radians(8.0)
"""Two corners are one if they lie, and run, no farther apart, metres and radians."""

_NEW_GUESS = 0.5
"""Guesses nearer to a better one are left out, metres, and radians."""


def guesses_by_corners(
    reference: Sequence[CornerSighting],
    scan: Sequence[CornerSighting],
    guess: Pose = ORIGIN,
    reach: float = 3.0,
    turn: float = math.pi,
    most: int = 8,
) -> list[Pose]:
    """Poses at which corners of a scan lie on those of a reference, the likeliest first.

    A full corner is a frame: a place, and the headings of two walls. So one that both scans show
    gives the whole pose. Every pair of one kind is tried, and counted is how many corners of the
    scan then lie on corners of the reference and run as they do. A pose that one corner alone
    supports is no guess.

    Args:
        reference: corners of a scan, in its frame.
        scan: corners of another one, in its own frame.
        guess: of the pose of the second in the frame of the first.
        reach: largest distance of an answer from the guess, metres.
        turn: largest angle between them, radians.
        most: how many are returned at most.
    """
    full = [
        (a, b)
        for a in reference
        for b in scan
        if a.kind is b.kind and a.kind is not CornerKind.POTENTIAL
    ]
    tried = [pose for a, b in full if (pose := _pose_between(a, b)) is not None]
    near = [
        pose
        for pose in tried
        if math.dist(pose[:2], guess[:2]) <= reach and abs(wrap_angle(pose[2] - guess[2])) <= turn
    ]
    known, seen = _table(reference), _table(scan)
    supported = sorted([(-_support(known, seen, pose), k) for k, pose in enumerate(near)])
    found: list[Pose] = []
    for support, k in supported:
        pose = near[k]
        if -support < 2 or len(found) == most:
            break
        if all(_apart(pose, other) > _NEW_GUESS for other in found):
            found.append(pose)
    return found


def _pose_between(a: CornerSighting, b: CornerSighting) -> Pose | None:
    """The pose at which `b` is `a`; None if their walls meet at different angles."""
    if a.arrives is None or a.leaves is None or b.arrives is None or b.leaves is None:
        return None
    first, second = wrap_angle(a.arrives - b.arrives), wrap_angle(a.leaves - b.leaves)
    if abs(wrap_angle(second - first)) > 2.0 * _SAME_HEADING:
        return None
    heading = wrap_angle(first + 0.5 * wrap_angle(second - first))
    c, s = math.cos(heading), math.sin(heading)
    x, y = b.place.mean.tolist()
    return (
        float(a.place.mean[0]) - c * x + s * y,
        float(a.place.mean[1]) - s * x - c * y,
        heading,
    )


def _table(corners: Sequence[CornerSighting]) -> FloatArray:
    """Place and both headings of each corner, NaN for no wall, shape (n, 4)."""
    rows = [(*corner.place.mean, corner.arrives, corner.leaves) for corner in corners]
    return np.array(rows, dtype=np.float64).reshape(-1, 4)


def _support(known: FloatArray, seen: FloatArray, pose: Pose) -> int:
    """How many corners of a scan at that pose lie on known ones, and share a wall's heading."""
    off = points_to_parent(pose, seen[:, None, :2]) - known[None, :, :2]
    near = np.hypot(off[..., 0], off[..., 1]) <= _SAME_PLACE
    turns = seen[:, None, 2:] + pose[2] - known[None, :, 2:]
    alike = np.abs(turns - math.tau * np.round(turns / math.tau)) <= _SAME_HEADING
    return int(np.count_nonzero((near & alike.any(axis=2)).any(axis=1)))


def _apart(a: Pose, b: Pose) -> float:
    return max(math.dist(a[:2], b[:2]), abs(wrap_angle(a[2] - b[2])))
