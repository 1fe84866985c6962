"""Published ways to draw a scan as lines, in plain NumPy, to measure others against."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semnav_features import ExtractorSettings, extract
from semnav_features.frames import FloatArray
from semnav_features.kernels.polyline_refinement import refine_vertices
from semnav_features.scan import Scan

Lines = tuple[FloatArray, ...]
"""Polylines, each of shape (m, 2), metres, lidar frame."""

MAX_LINK_GAP = 1.0
"""Longest gap that is joined in the published experiments, metres."""

MISSED_ERROR = 0.5
"""What a beam that meets no line counts in the published experiments, metres."""


@dataclass(frozen=True, eq=False)
class Hits:
    """The returns of a scan.

    Attributes:
        ranges: metres, shape (n,).
        directions: cosine and sine of their beams, shape (n, 2).
        linked: whether a return is the neighbour of the one before it, shape (n,).
    """

    ranges: FloatArray
    directions: FloatArray
    linked: NDArray[np.bool_]

    @classmethod
    def of(cls, scan: Scan) -> Hits:
        """The returns of a scan, linked where neighbouring beams end close to each other."""
        beams = np.flatnonzero(scan.valid)
        ranges, angles = scan.ranges[beams], scan.angles[beams]
        directions = np.stack((np.cos(angles), np.sin(angles)), axis=1)
        steps = np.hypot(*np.diff(ranges[:, None] * directions, axis=0).T)
        linked = (np.diff(beams) == 1) & (steps <= MAX_LINK_GAP)
        return cls(ranges, directions, np.concatenate(([False], linked))[: len(ranges)])

    @property
    def points(self) -> FloatArray:
        """Where the beams end, shape (n, 2), metres."""
        return self.ranges[:, None] * self.directions

    def chord_cost(self, first: int, last: int) -> float:
        """Squared range residuals of the hits between two hits against their chord."""
        (ax, ay), (bx, by) = self.end_of(first), self.end_of(last)
        x, y = self.directions[first + 1 : last].T
        with np.errstate(divide="ignore", invalid="ignore"):
            there = (ax * by - ay * bx) / (x * (by - ay) - y * (bx - ax))
        cost = float(((there - self.ranges[first + 1 : last]) ** 2).sum())
        return cost if math.isfinite(cost) and (there > 0).all() else 1e9

    def end_of(self, hit: int) -> tuple[float, float]:
        """Where one beam ends, metres."""
        x, y = (self.ranges[hit] * self.directions[hit]).tolist()
        return x, y


def end_point_fit(scan: Scan, vertices: int) -> Lines:
    """One polyline through all returns, cut where it is farthest from its chord, so often."""
    points = Hits.of(scan).points
    chosen = [0, len(points) - 1]
    worst = [_farthest(points, *chosen)]
    while len(chosen) < min(vertices, len(points)):
        k = int(np.argmax([distance for distance, _ in worst]))
        cut = worst[k][1]
        before, after = chosen[k], chosen[k + 1]
        chosen.insert(k + 1, cut)
        worst[k : k + 1] = [_farthest(points, before, cut), _farthest(points, cut, after)]
    return (points[chosen],) if len(points) > 1 else ()


def _farthest(points: FloatArray, first: int, last: int) -> tuple[float, int]:
    inner = points[first + 1 : last] - points[first]
    chord = points[last] - points[first]
    if not len(inner):
        return -1.0, first
    across = np.abs(inner @ (-chord[1], chord[0])) / max(float(np.hypot(*chord)), 1e-12)
    return float(across.max()), first + 1 + int(np.argmax(across))


def greedy_polylines(scan: Scan, vertices: int, refine: bool = False) -> Lines:
    """Linked returns, less those whose removal costs the least likelihood, one after another.

    The method PLE of Schaefer et al. (IROS 2018), written from its description; with `refine` its
    vertices are then moved to the best places, as in PLE+, by the optimiser of `polylines` in
    place of the paper's simplex search.
    """
    chain = _Chain(Hits.of(scan))
    while chain.count > vertices:
        chain.remove(min(chain.costs, key=chain.costs.__getitem__))
    chosen = np.array(sorted(chain.costs), np.int64)
    if not len(chosen):
        return ()
    starts = np.array([chain.before[k] < 0 for k in chosen.tolist()])
    hits = chain.hits
    corners = hits.points[chosen]
    if refine:
        corners = refine_vertices(hits.directions, hits.ranges, chosen, starts)
    return tuple(np.split(corners, np.flatnonzero(starts)[1:]))


class _Chain:
    """Polylines that are thinned: of every vertex its neighbours (-1: none) and its cost."""

    def __init__(self, hits: Hits) -> None:
        self.hits = hits
        count = len(hits.ranges)
        after = np.append(hits.linked[1:], False)
        self.before = [k - 1 if hits.linked[k] else -1 for k in range(count)]
        self.after = [k + 1 if after[k] else -1 for k in range(count)]
        used = [k for k in range(count) if self.before[k] >= 0 or self.after[k] >= 0]
        self.costs = {k: self._cost(k) for k in used}

    @property
    def count(self) -> int:
        return len(self.costs)

    def remove(self, at: int) -> None:
        """Take a vertex out, and with it a neighbour that is left alone."""
        before, after = self.before[at], self.after[at]
        del self.costs[at]
        for side, other, link in ((before, after, self.after), (after, before, self.before)):
            if side >= 0:
                link[side] = other
        changed = {k for side in (before, after) if side >= 0 for k in self._around(side)}
        for k in changed:
            if self.before[k] < 0 and self.after[k] < 0:
                del self.costs[k]
            else:
                self.costs[k] = self._cost(k)

    def _around(self, at: int) -> tuple[int, ...]:
        return tuple(k for k in (self.before[at], at, self.after[at]) if k >= 0)

    def _cost(self, at: int) -> float:
        """By how much the objective grows if a vertex goes."""
        before, after, chord = self.before[at], self.after[at], self.hits.chord_cost
        if before >= 0 and after >= 0:
            return chord(before, after) - chord(before, at) - chord(at, after)
        other = max(before, after)
        alone = self.before[other] < 0 or self.after[other] < 0
        unexplained = abs(at - other) + alone
        return unexplained * MISSED_ERROR**2 - chord(min(at, other), max(at, other))


def walls(scan: Scan, settings: ExtractorSettings | None = None) -> Lines:
    """The walls that `extract` finds, each a line of its own."""
    scene = extract(scan, settings or ExtractorSettings(rupture_range=scan.range_max))
    return tuple(np.array((wall.start, wall.end)) for wall in scene.walls)
