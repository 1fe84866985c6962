"""Removes walls of a map that lie on longer ones."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from semnav_features.elements import Wall
from semnav_features.frames import FloatArray
from semnav_features.scene import ends_of

_MAX_OFFSET = 0.08
"""Distance from a longer wall within which a point lies on it, metres."""

_MIN_FACING_COSINE = math.cos(math.radians(35.0))
"""Cosine of the largest angle between two walls that may be one: both must face the same way."""

_MIN_COVERED_SHARE = 0.7
"""A wall is a duplicate if this share of it lies on longer ones."""

_SAMPLE_SPACING = 0.1
"""Distance between the tested points of a wall, metres."""


def without_duplicates(walls: Sequence[Wall]) -> tuple[Wall, ...]:
    """The walls that do not lie on longer ones, in their order.

    Errors of poses of a few centimetres, and corners cut by a single scan, leave short lines along
    the long ones.
    """
    order = sorted(range(len(walls)), key=lambda k: -walls[k].length)
    ends = ends_of(walls)
    kept: list[int] = []
    for k in order:
        if not _covered(ends[k], ends[kept]):
            kept.append(k)
    return tuple(walls[k] for k in sorted(kept))


def _covered(wall: FloatArray, longer: FloatArray) -> bool:
    """Whether most of a wall lies on longer ones that face the same way."""
    if not len(longer):
        return False
    start, along = wall[:2], wall[2:] - wall[:2]
    length = math.hypot(along[0], along[1])
    direction = longer[:, 2:] - longer[:, :2]
    squared = np.sum(direction**2, axis=1)
    facing = direction @ along > _MIN_FACING_COSINE * length * np.sqrt(squared)
    direction, squared, origin = direction[facing], squared[facing], longer[facing, :2]
    count = max(2, math.ceil(length / _SAMPLE_SPACING))
    shares = (np.arange(count) + 0.5) / count
    offset = (start + shares[:, None] * along)[:, None] - origin
    place = np.clip(np.sum(offset * direction, axis=2) / squared, 0.0, 1.0)
    apart = np.linalg.norm(offset - place[..., None] * direction, axis=2)
    return bool(np.mean(np.any(apart < _MAX_OFFSET, axis=1)) >= _MIN_COVERED_SHARE)
