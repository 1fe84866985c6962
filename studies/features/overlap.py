"""How much of one set of walls another set covers."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.scene import Wall, ends_of

MAX_WALL_DISTANCE = 0.1
"""Two walls cover each other where they are less than this apart, metres."""

MAX_WALL_ANGLE = math.radians(10.0)
"""Walls whose directions differ by more than this never cover each other, radians."""


class Overlap:
    """Where detected walls run along true ones.

    Args:
        walls: n walls.
        others: m walls in the same frame.

    Attributes:
        spans: where each of `others` begins and ends along each wall, metres from its start,
            shape (n, m, 2); an empty span (end before start) where they are not the same.
        lengths: of `walls`, metres, shape (n,).
    """

    def __init__(self, walls: Sequence[Wall], others: Sequence[Wall]) -> None:
        a, b = ends_of(walls).reshape(-1, 1, 2, 2), ends_of(others).reshape(1, -1, 2, 2)
        along, other = a[:, :, 1] - a[:, :, 0], b[:, :, 1] - b[:, :, 0]
        self.lengths = np.hypot(along[..., 0], along[..., 1])[:, 0]
        along = along / self.lengths[:, None, None]
        offset = b - a[:, :, :1]
        places = (offset * along[:, :, None]).sum(axis=-1)
        asides = along[:, :, None, 0] * offset[..., 1] - along[:, :, None, 1] * offset[..., 0]
        cosines = (other * along).sum(axis=-1)
        straight = cosines > math.cos(MAX_WALL_ANGLE) * np.hypot(other[..., 0], other[..., 1])
        spans = np.clip(places, 0.0, self.lengths[:, None, None])
        with np.errstate(divide="ignore", invalid="ignore"):
            slope = (asides[..., 1] - asides[..., 0]) / (places[..., 1] - places[..., 0])
            gaps = asides[..., :1] + slope[..., None] * (spans - places[..., :1])
            same = straight & (np.abs(gaps) < MAX_WALL_DISTANCE).all(axis=-1)
        self.spans = np.where(same[..., None], spans, (1.0, 0.0))

    @property
    def longest(self) -> FloatArray:
        """How much of each wall the one of `others` covers that covers most, metres, (n,)."""
        return np.asarray((self.spans[..., 1] - self.spans[..., 0]).max(axis=1, initial=0.0))

    @property
    def covered(self) -> FloatArray:
        """How much of each wall all of `others` cover together, metres, shape (n,)."""
        return np.array([_union(spans) for spans in self.spans])

    def best(self, wall: int) -> int:
        """Which of `others` covers most of a wall."""
        return int((self.spans[wall, :, 1] - self.spans[wall, :, 0]).argmax())


def segmentation_rate(expected: FloatArray, detected: FloatArray) -> float:
    """The share of the walls' length that was detected (Weerakoon et al. (11)).

    Args:
        expected: length of every wall in view, metres.
        detected: how much of each was found, metres: by all detections together
            (`Overlap.covered`), or by the longest (`Overlap.longest`), which counts a wall that
            came back in pieces as found only in part.

    Returns:
        0 to 1; NaN if nothing is in view.
    """
    total = float(expected.sum())
    return float(detected.sum()) / total if total else math.nan


def _union(spans: FloatArray) -> float:
    """Length of the union of intervals, shape (m, 2); empty ones end before they start."""
    total, reached = 0.0, 0.0
    for start, end in sorted(spans.tolist()):
        total += max(0.0, end - max(start, reached))
        reached = max(reached, end)
    return total
