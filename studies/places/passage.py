"""Whether a scan shows a corridor: walls that face each other for longer than they are apart.

The corridor midpoints of `Scene.corridors` (Barbret 2021, section 3.3) are places between a corner
and an opposite wall, which small rooms have too. What people call a corridor is long: here it is
as long, in view, as the walls on both sides of it run beside each other.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.scene import Scene, Wall, ends_of


@dataclass(frozen=True, slots=True)
class PassageLimits:
    """What a corridor is.

    Attributes:
        narrowest: distance between the walls, metres.
        widest: distance between the walls, metres.
        elongation: the walls run beside each other for at least so many times their distance.
        askew: how far from parallel they may be, radians.
        gap: so far apart the walls of one side may be, as doors make them, metres.
        depth: how far before or behind its side's line a wall may lie, metres, as door frames and
            pilasters do.
    """

    narrowest: float = 0.8
    widest: float = 3.0
    elongation: float = 2.0
    askew: float = math.radians(10.0)
    gap: float = 1.3
    depth: float = 0.3


@dataclass(frozen=True, slots=True)
class Passage:
    """Two sides that face each other.

    Attributes:
        width: between the sides, metres.
        length: for which both sides are seen beside each other, metres.
    """

    width: float
    length: float

    @property
    def elongation(self) -> float:
        """How many times as long as wide."""
        return self.length / self.width


def passages(walls: Sequence[Wall], limits: PassageLimits | None = None) -> tuple[Passage, ...]:
    """The most elongated passage along each wall that has one beside it.

    A passage's two sides are all the walls that lie in line with the wall and all those that lie in
    line with one that faces it, free side to free side; its length is that for which there is a
    wall on both sides.

    Args:
        walls: of a scene.
        limits: `PassageLimits()` if None.
    """
    limits = limits or PassageLimits()
    ends = ends_of(walls).reshape(-1, 2, 2)
    found = (_longest(ends, k, limits) for k in range(len(ends)))
    return tuple([passage for passage in found if passage is not None])


def is_corridor(scene: Scene, limits: PassageLimits | None = None) -> bool:
    """Whether a scene shows a corridor: a passage elongated enough."""
    limits = limits or PassageLimits()
    return any(p.elongation >= limits.elongation for p in passages(scene.walls, limits))


def _longest(ends: FloatArray, k: int, limits: PassageLimits) -> Passage | None:
    """The most elongated passage whose right side wall `k` is part of."""
    places, parallel = _along(ends, ends[k], limits)
    middles = places[:, :, 1].mean(axis=1)
    right = _intervals(places[parallel > 0], middles[parallel > 0], 0.0, limits)
    facing, offsets = places[parallel < 0], middles[parallel < 0]
    wide = (offsets >= limits.narrowest) & (offsets <= limits.widest)
    best = None
    for width in offsets[wide].tolist():
        left = _intervals(facing, offsets, width, limits)
        passage = Passage(width, _shared(left, right))
        if best is None or passage.elongation > best.elongation:
            best = passage
    return best


def _along(
    ends: FloatArray, wall: FloatArray, limits: PassageLimits
) -> tuple[FloatArray, FloatArray]:
    """The walls in the frame of one, which runs along x with its free side at positive y.

    Returns:
        Their ends, shape (n, 2, 2), and 1 for those that run the same way, -1 for the opposite
        way, 0 for others.
    """
    along = (wall[1] - wall[0]) / np.hypot(*(wall[1] - wall[0]))
    turn = np.array(((along[0], -along[1]), (along[1], along[0])))
    places = (ends - wall[0]) @ turn
    steps = places[:, 1] - places[:, 0]
    cosine = steps[:, 0] / np.hypot(*steps.T)
    return places, np.where(np.abs(cosine) >= math.cos(limits.askew), np.sign(cosine), 0.0)


def _intervals(
    places: FloatArray, offsets: FloatArray, line: float, limits: PassageLimits
) -> FloatArray:
    """Where along x a side on a line parallel to it begins and ends, shape (n, 2)."""
    on_line = np.abs(offsets - line) <= limits.depth
    walls = np.sort(places[on_line][:, :, 0], axis=1)
    walls = walls[np.argsort(walls[:, 0])]
    reach = np.maximum.accumulate(walls[:, 1])
    begins = np.flatnonzero(np.append(True, walls[1:, 0] > reach[:-1] + limits.gap))
    return np.stack((walls[begins, 0], reach[np.append(begins[1:] - 1, -1)]), axis=1)


def _shared(a: FloatArray, b: FloatArray) -> float:
    """The length that two sets of intervals have in common."""
    edges = np.unique(np.concatenate((a.ravel(), b.ravel())))
    middles = 0.5 * (edges[:-1] + edges[1:])
    covered = [((side[:, :1] < middles) & (middles < side[:, 1:])).any(axis=0) for side in (a, b)]
    return float(np.diff(edges)[covered[0] & covered[1]].sum())
