"""Straight pieces of a scan, and which of them are walls."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.settings import ExtractorSettings
from tests.numpy_oracle.constants import PIECE_PRICE, ROBUST
from tests.numpy_oracle.curvature import curvature_peaks
from tests.numpy_oracle.partition import best_cuts
from tests.numpy_oracle.sweep import Sweep


@dataclass(frozen=True, eq=False)
class Piece:
    """Points on one line and their total least squares fit; flags as in `Wall`.

    One that `is_round` is part of an arc and so no wall. With `weights` the points count by these.
    """

    beams: list[int]
    points: FloatArray
    start_rupture: bool = False
    end_rupture: bool = False
    start_break: bool = False
    end_break: bool = False
    is_round: bool = False
    weights: FloatArray | None = None

    @cached_property
    def _shares(self) -> FloatArray:
        """How much each point counts; the sum is how many do."""
        if self.weights is None:
            return np.ones(len(self.points))
        return np.asarray(self.weights * (self.weights > 0.0).sum() / self.weights.sum())

    @cached_property
    def count(self) -> int:
        """How many points count."""
        return int((self._shares > 0.0).sum())

    @cached_property
    def mean(self) -> FloatArray:
        """Mean of the points, shape (2,)."""
        return np.asarray(self._shares @ self.points / self.count)

    @cached_property
    def _moments(self) -> tuple[FloatArray, FloatArray]:
        centred = self.points - self.mean
        return np.linalg.eigh((self._shares * centred.T) @ centred)

    @property
    def spread(self) -> float:
        """Sum of squared distances from the mean along the line."""
        return float(self._moments[0][1])

    @property
    def scatter(self) -> float:
        """Sum of squared distances to the line."""
        return max(float(self._moments[0][0]), 0.0) * (1.0 if self.weights is None else ROBUST.loss)

    @cached_property
    def along(self) -> FloatArray:
        """Unit direction from the first point to the last, the scanner on its left."""
        axis = self._moments[1][:, 1]
        return axis if axis @ (self.points[-1] - self.points[0]) >= 0 else -axis

    @property
    def start(self) -> FloatArray:
        """Projection of the first point on the line."""
        return self._projected(self.points[0])

    @property
    def end(self) -> FloatArray:
        """Projection of the last point on the line."""
        return self._projected(self.points[-1])

    @property
    def length(self) -> float:
        """Metres."""
        return float(np.linalg.norm(self.end - self.start))

    def _projected(self, point: FloatArray) -> FloatArray:
        return self.mean + ((point - self.mean) @ self.along) * self.along

    def offset(self, point: FloatArray) -> float:
        """Signed distance of a point from the line, positive on the left."""
        dx, dy = point - self.mean
        return float(self.along[0] * dy - self.along[1] * dx)

    def deviation(self, point: FloatArray, sigma: float) -> float:
        """Standard deviation of the line beside a point, as in a straight-line regression."""
        along = (point - self.mean) @ self.along
        return float(sigma * np.sqrt(1.0 / self.count + along**2 / self.spread))


def find_pieces(sweep: Sweep, settings: ExtractorSettings) -> list[Piece]:
    """Every straight piece of two points or more, in beam order."""
    groups = sweep.connected_groups(settings)
    return [
        _flagged(sweep, group, beams)
        for group in groups
        for beams in _straight_runs(sweep, group, settings)
    ]


def is_wall(piece: Piece, settings: ExtractorSettings) -> bool:
    """Whether a piece is straight, long and dense enough."""
    enough = piece.count >= settings.wall_beams and piece.length >= settings.wall_length
    return enough and not piece.is_round


def _cut(points: FloatArray, settings: ExtractorSettings) -> list[int]:
    """Where a group is cut, by the strategy that is set."""
    if settings.segmentation == "dynamic":
        return best_cuts(points, settings.sigma**2, PIECE_PRICE)
    peaks = curvature_peaks(points, settings) if settings.segmentation == "curvature" else []
    cuts = list(peaks)
    for a, b in itertools.pairwise([0, *peaks, len(points) - 1]):
        cuts += _cuts(points, a, b, settings.split_distance)
    return sorted(cuts)


def _cuts(points: FloatArray, first: int, last: int, limit: float) -> list[int]:
    """Iterative end-point fit: where points first to last are cut (Barbret section 2.4.4)."""
    dx, dy = points[last] - points[first]
    inner = points[first + 1 : last] - points[first]
    distances = np.abs(dx * inner[:, 1] - dy * inner[:, 0])
    if len(inner) == 0 or distances.max() <= limit * np.hypot(dx, dy):
        return []
    cut = first + 1 + int(distances.argmax())
    return [*_cuts(points, first, cut, limit), cut, *_cuts(points, cut, last, limit)]


def _straight_runs(sweep: Sweep, group: list[int], settings: ExtractorSettings) -> list[list[int]]:
    """Beams of each straight run, after settling the borders between them."""
    points = sweep.points(group)
    cuts = [-1, *_cut(points, settings), len(group)]
    runs = [range(a + 1, b) for a, b in itertools.pairwise(cuts) if b - a > 2]
    lines = [Piece(list(run), points[run.start : run.stop]) for run in runs]
    for k in range(len(runs) - 1):
        pair = _settled(points, lines[k : k + 2], runs[k], runs[k + 1], 3.0 * settings.sigma)
        runs[k : k + 2] = pair
    if runs:
        runs[0] = range(_last_near(lines[0], points, runs[0].start, -1, settings), runs[0].stop)
        last = _last_near(lines[-1], points, runs[-1].stop - 1, 1, settings)
        runs[-1] = range(runs[-1].start, last + 1)
    return [[group[i] for i in run] for run in runs]


def _last_near(
    line: Piece, points: FloatArray, i: int, step: int, settings: ExtractorSettings
) -> int:
    """The last point from i on, in steps, before the first that is far from a line."""
    while 0 <= i + step < len(points) and abs(line.offset(points[i + step])) <= 3 * settings.sigma:
        i += step
    return i


def _settled(
    points: FloatArray, lines: list[Piece], before: range, after: range, near: float
) -> tuple[range, range]:
    """Move the border between two runs until every point is with the line it is nearer to."""

    def distance(line: int, i: int) -> float:
        return abs(lines[line].offset(points[i]))

    stop, start = before.stop, after.start
    while stop < start and distance(0, stop) <= min(near, distance(1, stop)):
        stop += 1
    while stop < start and distance(1, start - 1) <= near:
        start -= 1
    if stop == start:
        while stop > before.start + 2 and distance(0, stop - 1) > distance(1, stop - 1):
            stop -= 1
        while stop < after.stop - 2 and distance(1, stop) > distance(0, stop):
            stop += 1
        start = stop
    return range(before.start, stop), range(start, after.stop)


def _flagged(sweep: Sweep, group: list[int], beams: list[int]) -> Piece:
    before, after = beams[0] - 1, beams[-1] + 1
    before = before + sweep.turn if before < 0 else before
    starts = beams[0] == group[0] and before >= 0
    ends = beams[-1] == group[-1] and after < len(sweep.ranges)
    return Piece(
        beams,
        sweep.points(beams),
        start_rupture=bool(starts and not sweep.returned[before]),
        end_rupture=bool(ends and not sweep.returned[after]),
        start_break=bool(starts and sweep.returned[before]),
        end_break=bool(ends and sweep.returned[after]),
    )
