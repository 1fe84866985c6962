"""Straight stretches of an outline along the axes: walls that a raster has made rough."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_env.world.maps.importers.directions import LEAST_PIECE_LENGTH, spread_out
from semnav_features.frames import FloatArray

LEAST_RUN_LENGTH = LEAST_PIECE_LENGTH
"""Length of the shortest run, pixels."""

LEAST_CAP_LENGTH = 1.0
"""Length of the shortest run between the ends of two others, pixels: the end of a thin wall or a
step in one."""

MAX_BACKTRACK = 0.5
"""Distance by which an outline may go back on its way along a run, pixels."""

TREND_THRESHOLD = 0.7
"""Offset from the middle of a run to its ends from which on it slopes or bends by more than noise,
pixels."""

LEAST_TREND_LENGTH = 15.0
"""Length below which a run may have no trend at all, pixels."""

EXTENSION_FACTOR = 1.2
"""Ratio by which an outline must stay longer within twice the limit of a line to go on."""


class Span(NamedTuple):
    """A stretch of a closed outline.

    Attributes:
        first: index of its first vertex.
        last: its last one, counted on past the end of the outline where it goes around.
        axis: along which it runs: 0 or 1.
        length: along this axis, pixels.
    """

    first: int
    last: int
    axis: int
    length: float


@dataclass(frozen=True)
class PixelRun:
    """A stretch of an outline to be put on a line along an axis.

    Attributes:
        ring: the number of the outline.
        span: the stretch of the outline.
        least: least coordinate across the axis that its line may have.
        most: the greatest.
        level: coordinate across the axis that its line has.
        forward: whether the outline runs towards greater coordinates.
        begin: coordinate of its start along the axis.
        end: coordinate of its end; greater than `begin`.
    """

    ring: int
    span: Span
    least: float
    most: float
    level: float
    forward: bool
    begin: float
    end: float

    def vertices(self, count: int) -> NDArray[np.intp]:
        """Indices of the vertices of the outline that lie on the run."""
        return np.arange(self.span.first, self.span.last + 1) % count


def runs_of(ring: int, points: FloatArray, limit: float) -> list[PixelRun]:
    """The runs of an outline, the longest first; they share no segment.

    A run is as long as it may be while its vertices lie within `limit` of a line along an axis. If
    it then slopes or bends by more than `TREND_THRESHOLD` and the outline goes on so, it is part of
    an oblique or round wall, and no shorter piece of that is a run either.

    Args:
        ring: the outline's number.
        points: its vertices, each once, shape (n, 2), in pixels.
        limit: pixels.
    """
    if np.ptp(points, axis=0).max() < LEAST_RUN_LENGTH:
        return []
    wide = list(_spans(points, 2.0 * limit))
    spans = [span for span in _spans(points, limit) if not _is_oblique(points, span, wide, limit)]
    taken: list[PixelRun | None] = [None] * len(points)
    runs = []
    for span in sorted(spans, key=lambda span: -span.length):
        free = _free_part(span, taken, points)
        beside = taken[(free.first - 1) % len(points)], taken[free.last % len(points)]
        between_two = all(run is not None and run.span.axis != free.axis for run in beside)
        if free.length < (LEAST_CAP_LENGTH if between_two else LEAST_RUN_LENGTH):
            continue
        run = _run(ring, points, free, limit)
        for k in range(free.first, free.last):
            taken[k % len(points)] = run
        runs.append(run)
    return runs


def _spans(points: FloatArray, limit: float) -> Iterator[Span]:
    """The stretches along either axis that cannot be extended."""
    count = len(points)
    for axis in (0, 1):
        across = points[:, 1 - axis].tolist()
        for sense in (1.0, -1.0):
            along = (sense * points[:, axis]).tolist()
            before = _reach(along, across, count - 1, limit) - count
            for first in range(count):
                last = _reach(along, across, first, limit)
                length = along[last % count] - along[first]
                if last > before and length >= LEAST_CAP_LENGTH:
                    yield Span(first, last, axis, length)
                before = last


def _reach(along: list[float], across: list[float], first: int, limit: float) -> int:
    """The last vertex up to which an outline keeps to a line along an axis."""
    count = len(along)
    low = high = across[first]
    far = along[first]
    for last in range(first + 1, first + count):
        here = across[last % count]
        low, high, far = min(low, here), max(high, here), max(far, along[last % count])
        if high - low > 2.0 * limit or far - along[last % count] > MAX_BACKTRACK:
            return last - 1
    return first + count - 1


def _is_oblique(points: FloatArray, span: Span, wide: Sequence[Span], limit: float) -> bool:
    """Whether a stretch is part of an oblique or round wall."""
    whole = _prolonged(points, span, limit)
    if not _trends(whole, span.axis):
        return False
    length = abs(float(whole[-1, span.axis] - whole[0, span.axis]))
    if length < LEAST_TREND_LENGTH:
        return True
    wider = (_prolonged(points, each, 2.0 * limit) for each in wide if _holds(each, span, points))
    return any(
        abs(each[-1, span.axis] - each[0, span.axis]) > EXTENSION_FACTOR * length for each in wider
    )


def _holds(wide: Span, span: Span, points: FloatArray) -> bool:
    """Whether one stretch is part of another."""
    start = (span.first - wide.first) % len(points)
    return wide.axis == span.axis and start + span.last - span.first <= wide.last - wide.first


def _trends(stretch: FloatArray, axis: int) -> bool:
    """Whether a stretch slopes or bends: its first two Legendre coefficients, least squares."""
    spread, weights = spread_out(stretch)
    begin, end = stretch[[0, -1], axis]
    t = np.clip(2.0 * (spread[:, axis] - begin) / (end - begin) - 1.0, -1.0, 1.0)
    basis = np.stack((np.ones_like(t), t, 1.5 * t**2 - 0.5), axis=1)
    root = np.sqrt(weights)
    _, *trends = np.linalg.lstsq(root[:, None] * basis, root * spread[:, 1 - axis])[0]
    return bool(np.abs(trends).max() > TREND_THRESHOLD)


def _prolonged(points: FloatArray, span: Span, limit: float) -> FloatArray:
    """A stretch extended into the segments at its ends as far as they lie within the limit."""
    stretch = _stretch(points, span)
    across = stretch[:, 1 - span.axis]
    band = float(across.max()) - 2.0 * limit, float(across.min()) + 2.0 * limit
    before, behind = points[(span.first - 1) % len(points)], points[(span.last + 1) % len(points)]
    ends = []
    for inner, outer, towards in (
        (stretch[0], before, stretch[0] - stretch[-1]),
        (stretch[-1], behind, stretch[-1] - stretch[0]),
    ):
        step = outer - inner
        rise = float(step[1 - span.axis])
        left = (band[int(rise > 0.0)] - float(inner[1 - span.axis])) / rise if rise else 1.0
        onwards = step[span.axis] * towards[span.axis] > 0.0
        ends.append(inner + min(1.0, left) * step if onwards else inner)
    return np.concatenate((ends[:1], stretch, ends[1:]))


def _stretch(points: FloatArray, span: Span) -> FloatArray:
    """The vertices of a stretch, the last one too."""
    return points[np.arange(span.first, span.last + 1) % len(points)]


def _free_part(span: Span, taken: Sequence[PixelRun | None], points: FloatArray) -> Span:
    """The longest part of a stretch that no run has and that continues none the same way.

    It may meet a run that comes back along the same axis, at the tip of a thin wall.
    """
    count = len(points)
    first, last = points[[span.first % count, span.last % count], span.axis]
    same = span.axis, bool(last > first)
    best = part = Span(span.first, span.first, span.axis, 0.0)
    begin = span.first
    for k in range(span.first, span.last + 1):
        if k < span.last and taken[k % count] is None:
            continue
        ends = [begin, k]
        for i, edge in ((0, begin - 1), (1, k)):
            run = taken[edge % count]
            if run is not None and (run.span.axis, run.forward) == same:
                ends[i] += 1 - 2 * i
        if ends[0] < ends[1]:
            a, b = (points[end % count, span.axis] for end in ends)
            part = Span(ends[0], ends[1], span.axis, abs(float(b - a)))
        best, begin = max(best, part, key=lambda each: each.length), k + 1
    return best


def _run(ring: int, points: FloatArray, span: Span, limit: float) -> PixelRun:
    stretch = _stretch(points, span)
    spread, weights = spread_out(stretch)
    across, along = spread[:, 1 - span.axis], stretch[:, span.axis]
    least, most = float(across.max()) - limit, float(across.min()) + limit
    level = min(max(float(weights @ across / weights.sum()), least), most)
    begin, end = sorted((float(along[0]), float(along[-1])))
    return PixelRun(ring, span, least, most, level, bool(along[-1] > along[0]), begin, end)
