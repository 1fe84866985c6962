"""Redraws outlines with their runs on lines, and finds runs that must be given up."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from shapely import STRtree

from semnav_env.world.maps.importers.runs import PixelRun
from semnav_features.frames import FloatArray


@dataclass(frozen=True, eq=False)
class RedrawnOutline:
    """An outline with its runs on lines.

    Attributes:
        points: its vertices, each once, shape (n, 2), in pixels.
        makers: for each vertex, the runs on whose lines it was put.
        moved: largest distance by which each run moved the outline, pixels.
        turned: whether it was turned inside out.
    """

    points: FloatArray
    makers: Sequence[frozenset[PixelRun]]
    moved: dict[PixelRun, float]
    turned: bool


def redrawn(points: FloatArray, runs: Collection[PixelRun]) -> RedrawnOutline:
    """Redraw an outline with its runs on their lines; only the ends of runs stay vertices.

    Where two runs meet at the tip of a thin wall, it gets an end as thick as they are apart.

    Args:
        points: its vertices, each once, shape (n, 2), in pixels.
        runs: the runs of this outline.
    """
    count = len(points)
    tips = _tips(runs, count)
    new = np.stack((points, points), axis=1)  # where the outline arrives, and where it leaves
    kept = np.ones((count, 2), dtype=bool)
    kept[:, 1] = [k in tips for k in range(count)]
    makers: list[frozenset[PixelRun]] = [frozenset()] * (2 * count)
    for run in runs:
        there = run.vertices(count)
        kept[there[1:-1]] = False
        new[there[1:], 0, 1 - run.span.axis] = new[there[:-1], 1, 1 - run.span.axis] = run.level
        for end, side in ((there[0], 1), (there[-1], 0)):
            sides = (side,) if end in tips else (0, 1)
            for each in sides:
                new[end, each, 1 - run.span.axis] = run.level
                makers[2 * end + each] |= {run}
    left = np.flatnonzero(kept)
    drawn = new.reshape(-1, 2)[left]
    moved = {run: _moved(points, new, run) for run in runs}
    turned = bool(runs) and _area(points) * _area(drawn) <= 0.0
    return RedrawnOutline(drawn, [makers[k] for k in left], moved, turned)


def _tips(runs: Collection[PixelRun], count: int) -> set[int]:
    """The vertices at which a run ends and another begins along the same axis."""
    begun = {(run.span.axis, run.span.first % count) for run in runs}
    ended = {(run.span.axis, run.span.last % count) for run in runs}
    return {vertex for _, vertex in begun & ended}


def clashing(drawn: Sequence[RedrawnOutline]) -> set[PixelRun]:
    """Runs that must be given up, since on their lines two outlines, or parts of one, meet.

    Of the runs that drew two segments which meet, the shortest is, of several the first one on the
    first outline; and all runs of an outline that is turned inside out.
    """
    lost = {run for each in drawn if each.turned for run in each.moved}
    ends, following = [], []
    makers: list[frozenset[PixelRun]] = []
    for each in drawn:
        count = len(each.points)
        ends.append(np.stack((each.points, np.roll(each.points, -1, axis=0)), axis=1))
        following.append(np.roll(np.arange(count), -1) + len(makers))
        makers += [each.makers[k - 1] | each.makers[k] for k in (*range(1, count), 0)]
    after = np.concatenate(following)
    tree = STRtree(np.asarray(shapely.linestrings(np.concatenate(ends))))
    changed = np.flatnonzero([bool(runs) for runs in makers])
    found, others = tree.query(tree.geometries[changed], "intersects")
    ours = changed[found]
    apart = (ours != others) & (after[ours] != others) & (after[others] != ours)
    for a, b in zip(ours[apart].tolist(), others[apart].tolist(), strict=True):
        lost.add(min(makers[a] | makers[b], key=_rank))
    return lost


def _rank(run: PixelRun) -> tuple[float, int, int]:
    """Order in which runs are given up; the least first."""
    return run.span.length, run.ring, run.span.first


def _moved(old: FloatArray, new: FloatArray, run: PixelRun) -> float:
    """Largest shift of the ends of a run, and of its vertices from the line of the run."""
    there = run.vertices(len(old))
    ends = np.stack((new[there[0], 1], new[there[-1], 0]))
    away = shapely.distance(shapely.points(old[there]), shapely.LineString(ends))
    return float(max(away.max(), np.linalg.norm(ends - old[there[[0, -1]]], axis=1).max()))


def _area(points: FloatArray) -> float:
    """Area of a polygon, positive if it is counter-clockwise (x right, y up)."""
    (x, y), (x2, y2) = points.T, np.roll(points, -1, axis=0).T
    return float(x @ y2 - x2 @ y) / 2.0
