"""The outline that a lidar sees, cut into straight walls and arcs."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import groupby, pairwise

import numpy as np

from semnav_features.frames import FloatArray, Point, Pose, to_local
from semnav_features.lidar_spec import LidarSpec
from semnav_features.scene import Arc, Wall
from studies.truth.shapes import PlanCircle, Shapes
from studies.truth.sweep import NO_OWNER, Outline

MAX_JOINT_GAP = 0.01
"""Stretches that end and begin this close together belong together, metres."""

MAX_BOW = 0.01
"""What stays this close to a straight line is one straight wall, metres."""


@dataclass(frozen=True)
class WallRun:
    """Walls and arcs in beam order, each beginning where the one before it ends.

    Attributes:
        pieces: at least one.
        closed: the last ends where the first begins.
    """

    pieces: tuple[Wall | Arc, ...]
    closed: bool = False


def cut_into_runs(outline: Outline, shapes: Shapes, lidar: Pose, spec: LidarSpec) -> list[WallRun]:
    """The walls and arcs of an outline in the frame of the lidar, whose pose is given."""
    groups = list(_connected(outline))
    count = len(outline.owners)
    runs = []
    for group in groups:
        pieces = [
            piece
            for surface, part in _by_shape(group, outline, shapes)
            for piece in _pieces(surface, part, outline, shapes, lidar, spec)
        ]
        closed = outline.full and len(group) == count and joined(outline, count - 1, 0)
        if not closed:
            pieces[0] = _flagged(pieces[0], "start", outline, group[0], -1)
            pieces[-1] = _flagged(pieces[-1], "end", outline, group[-1], 1)
        runs.append(WallRun(tuple(pieces), closed))
    return runs


def joined(outline: Outline, first: int, second: int) -> bool:
    """Whether two stretches that follow each other touch; nothing touches `NO_OWNER`."""
    gap = outline.starts[second] - outline.ends[first]
    return bool(gap @ gap <= MAX_JOINT_GAP**2)  # false for NaN


def seam(outline: Outline) -> float:
    """A direction in which an outline all around may be cut without cutting a wall, radians.

    A jump of the range, else the sharpest bend.
    """
    turns = []
    for k in range(len(outline.owners)):
        if not joined(outline, k - 1, k):
            return float(outline.angles[k])
        before, after = (outline.ends[i] - outline.starts[i] for i in (k - 1, k))
        turn = math.atan2(before[0] * after[1] - before[1] * after[0], before @ after)
        turns.append(abs(turn))
    return float(outline.angles[int(np.argmax(turns))])


def _connected(outline: Outline) -> Iterator[list[int]]:
    """Successive stretches that touch."""
    group: list[int] = []
    for k in np.flatnonzero(outline.owners != NO_OWNER).tolist():
        if group and not (k == group[-1] + 1 and joined(outline, group[-1], k)):
            yield group
            group = []
        group.append(k)
    if group:
        yield group


def _by_shape(
    group: list[int], outline: Outline, shapes: Shapes
) -> Iterator[tuple[PlanCircle | None, list[int]]]:
    """Successive stretches of one round surface, or of none."""

    def surface(k: int) -> int:
        number = int(shapes.surfaces[outline.owners[k]])
        return number if number in shapes.circles else NO_OWNER

    for number, part in groupby(group, key=surface):
        yield shapes.circles.get(number), list(part)


def _pieces(
    circle: PlanCircle | None,
    part: list[int],
    outline: Outline,
    shapes: Shapes,
    lidar: Pose,
    spec: LidarSpec,
) -> list[Wall | Arc]:
    if circle is not None:
        return [_arc(circle, part, outline, lidar, spec)]
    points = np.concatenate((outline.starts[part], outline.ends[part[-1:]]))
    bends = straight_parts(points)
    return [_wall(part[a:b], outline, shapes, spec) for a, b in pairwise(bends)]


def straight_parts(points: FloatArray) -> list[int]:
    """Where a polyline bends: the indices of the points that matter.

    What lies between two of them is within `MAX_BOW` of the line between them. Found as by
    Douglas and Peucker (1973), who may split a straight side that is parallel to the line from
    the first point to the last; so splits that are not needed are taken back.
    """
    last = len(points) - 1
    bends = [0]
    for candidate, following in pairwise(_split(points, 0, last)):
        if _farthest(points, bends[-1], following)[1] > MAX_BOW:
            bends.append(candidate)
    return [*bends, last]


def _split(points: FloatArray, first: int, last: int) -> list[int]:
    """Indices after `first`, up to `last`, where a polyline must be split."""
    farthest, away = _farthest(points, first, last)
    if away <= MAX_BOW:
        return [last]
    return _split(points, first, farthest) + _split(points, farthest, last)


def _farthest(points: FloatArray, first: int, last: int) -> tuple[int, float]:
    """The point farthest from the line from `first` to `last`, and how far it is."""
    along = points[last] - points[first]
    offset = points[first : last + 1] - points[first]
    length = math.hypot(*along)
    if length > 0.0:
        away = np.abs(along[0] * offset[:, 1] - along[1] * offset[:, 0]) / length
    else:
        away = np.hypot(*offset.T)
    farthest = int(away.argmax())
    return first + farthest, float(away[farthest])


def _wall(part: list[int], outline: Outline, shapes: Shapes, spec: LidarSpec) -> Wall:
    start, end = _ends(part, outline)
    whole = float(shapes.lengths[np.unique(shapes.walls[outline.owners[part]])].sum())
    beams = _beams_in(outline, part, spec)
    return Wall(start, end, beams=beams, visible=min(1.0, math.dist(start, end) / whole))


def _arc(
    circle: PlanCircle, part: list[int], outline: Outline, lidar: Pose, spec: LidarSpec
) -> Arc:
    start, end = _ends(part, outline)
    centre = to_local(lidar, circle.centre)
    middle = part[len(part) // 2]
    along, arm = outline.ends[middle] - outline.starts[middle], outline.ends[middle] - centre
    convex = bool(arm[0] * along[1] - arm[1] * along[0] < 0.0)
    arc = Arc(centre, circle.radius, start, end, convex, _beams_in(outline, part, spec))
    return replace(arc, visible=min(1.0, arc.extent / circle.extent))


def _ends(part: list[int], outline: Outline) -> tuple[Point, Point]:
    (x1, y1), (x2, y2) = outline.starts[part[0]].tolist(), outline.ends[part[-1]].tolist()
    return (x1, y1), (x2, y2)


def _beams_in(outline: Outline, part: list[int], spec: LidarSpec) -> int:
    """How many beams end on successive stretches."""
    first, last = outline.angles[part[0]], outline.angles[part[-1] + 1]
    return int(np.count_nonzero((spec.angles - first) % math.tau < last - first))


def _flagged(piece: Wall | Arc, end: str, outline: Outline, stretch: int, step: int) -> Wall | Arc:
    """The piece with the flag that says why it ends, if it is a wall."""
    beside, count = stretch + step, len(outline.owners)
    if isinstance(piece, Arc) or not (outline.full or 0 <= beside < count):
        return piece
    reason = "rupture" if outline.owners[beside % count] == NO_OWNER else "break"
    flags = {f"{end}_{reason}": True}
    return replace(piece, **flags)  # type: ignore[arg-type]
