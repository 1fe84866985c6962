"""Puts outlines of pixels on straight, square walls."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace

from semnav_env.world.maps.importers.directions import dominant_direction
from semnav_env.world.maps.importers.outlines import closed_ring
from semnav_env.world.maps.importers.redrawing import clashing, redrawn
from semnav_env.world.maps.importers.runs import PixelRun, runs_of
from semnav_features.frames import FloatArray, points_to_local, points_to_parent

ALIGNMENT_TOLERANCE = 1.0
"""Largest distance between the lines of two runs of one wall, pixels."""


@dataclass(frozen=True, eq=False)
class Straightened:
    """Outlines with straight, square walls.

    Attributes:
        rings: closed, shape (k, 2) each, in pixels.
        direction: of the walls in the image, x right and y down, radians from -45 to 45 degrees;
            the others are square to it.
        segments: number of segments that were put on lines.
        lines: number of these lines.
        moved: largest distance by which a point moved, pixels.
    """

    rings: list[FloatArray]
    direction: float
    segments: int
    lines: int
    moved: float


def straighten(rings: Sequence[FloatArray], bound: float) -> Straightened:
    """The outlines with their runs along the building's two directions on exact lines.

    Every `PixelRun` of an outline is put on a line along one of the two directions
    (`dominant_direction`); runs that continue each other, as beside a door, get the same line.
    Oblique and round walls stay as they are. No point moves by more than the bound, and a run stays
    as it was if its line met another part of an outline, so that nothing opens or closes.

    Args:
        rings: closed outlines (column, row), shape (k, 2) each, the last point like the first.
        bound: pixels.
    """
    frame = 0.0, 0.0, dominant_direction(rings)
    outlines = [points_to_local(frame, ring[:-1]) for ring in rings]
    limit = 0.7 * bound  # a corner moves along both axes
    runs = _aligned([run for k, ring in enumerate(outlines) for run in runs_of(k, ring, limit)])
    drawn = [redrawn(ring, ()) for ring in outlines]
    changed = {run.ring for run in runs}
    while changed:
        kept: dict[int, list[PixelRun]] = {ring: [] for ring in changed}
        for run in runs:
            if run.ring in kept:
                kept[run.ring].append(run)
        for ring, own in kept.items():
            drawn[ring] = redrawn(outlines[ring], own)
        lost = {run for ring in changed for run, by in drawn[ring].moved.items() if by > bound}
        lost = lost or clashing(drawn)
        runs = [run for run in runs if run not in lost]
        changed = {run.ring for run in lost}
    segments = sum(run.span.last - run.span.first for run in runs)
    moved = max((by for each in drawn for by in each.moved.values()), default=0.0)
    back = [closed_ring(points_to_parent(frame, each.points)) for each in drawn]
    return Straightened(back, frame[2], segments, len(runs), moved)


def _aligned(runs: Sequence[PixelRun]) -> list[PixelRun]:
    """The runs, the longest first; those that continue each other share a line.

    A run takes over the line of a longer one that looks the same way, if its vertices allow, the
    two lie within `ALIGNMENT_TOLERANCE` and the gap between them along the line is no longer than
    the longer one.
    """
    leaders: defaultdict[tuple[int, bool, int], list[PixelRun]] = defaultdict(list)
    placed = []
    for run in sorted(runs, key=lambda run: -run.span.length):
        near = [
            leader
            for cell in (-1, 0, 1)
            for leader in leaders[
                run.span.axis, run.forward, int(run.level // ALIGNMENT_TOLERANCE) + cell
            ]
            if abs(leader.level - run.level) <= ALIGNMENT_TOLERANCE
            and run.least <= leader.level <= run.most
            and max(run.begin - leader.end, leader.begin - run.end) <= leader.span.length
        ]
        if near:
            level = min(near, key=lambda leader: abs(leader.level - run.level)).level
            run = replace(run, level=level)
        leaders[run.span.axis, run.forward, int(run.level // ALIGNMENT_TOLERANCE)].append(run)
        placed.append(run)
    return placed
