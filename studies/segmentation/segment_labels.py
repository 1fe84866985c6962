"""What every beam of a simulated scan truly hits, and what an extractor puts it into."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.extraction import beam_directions, sensor_of
from semnav_features.frames import FloatArray, Point
from semnav_features.kernels.chain import begin_sweep, copy_sweep, extract_arrays
from semnav_features.kernels.layout import WALLS
from semnav_features.kernels.scratch import allocate_features, allocate_scratch
from semnav_features.kernels.segmentation import group_points
from semnav_features.scan import Scan
from semnav_features.scene import Arc, Scene, Wall
from semnav_features.settings import ExtractorSettings
from studies.features.cases import draw_cases

Labels = NDArray[np.int64]
"""Which segment each beam belongs to, shape (n,); `NO_SEGMENT` for none."""

NO_SEGMENT = -1
"""Label of a beam that belongs to no segment."""

MAX_TOUCH_GAP = 0.011
"""Pieces that end and begin this close together are one surface, metres."""

CLOSED = 0.3
"""A gap in a wall that nothing could pass, metres: what lies on both sides is one wall."""

ALIGNED_ANGLE, ALIGNED_OFFSET = math.radians(1.0), 0.01
"""Two stretches in view are of one wall if they differ by less in direction and in place, m."""


@dataclass(frozen=True, eq=False)
class LabelledScan:
    """A measured scan and what every beam of it truly hit.

    Attributes:
        scan: with noise.
        noise: standard deviation of its ranges, metres.
        points: where the beams end without noise, lidar frame, shape (n, 2).
        lines: the straight wall in view that each beam hits.
        walls: for each of these, the number of the wall it is a stretch of.
        surfaces: the connected surface that each beam hits: walls that touch are one.
    """

    scan: Scan
    noise: float
    points: FloatArray
    lines: Labels
    walls: Labels
    surfaces: Labels


def labelled_scans(
    plan: FloorPlan,
    poses: int,
    noises: tuple[float, ...],
    rng: np.random.Generator,
    settings: ExtractorSettings,
) -> Iterator[LabelledScan]:
    """Scans from random poses, one for each noise, with what every beam hit.

    A stretch of wall counts if the settings would let it be a wall: enough beams, long enough.
    """
    for case in draw_cases(plan, poses, noises, clutter=False, rng=rng):
        for noise, scan in case.scans:
            yield label(scan, noise, case.truth, settings)


def label(scan: Scan, noise: float, truth: Scene, settings: ExtractorSettings) -> LabelledScan:
    """A scan with the walls and surfaces that its beams hit.

    Args:
        scan: of at most one turn.
        noise: standard deviation of its ranges, metres.
        truth: what is in view, lidar frame.
        settings: how many beams and metres make a wall.
    """
    pieces = _in_beam_order(scan, truth)
    points = np.full((len(scan.ranges), 2), np.nan)
    lines, surfaces = (np.full(len(scan.ranges), NO_SEGMENT) for _ in range(2))
    kept: list[Wall] = []
    surface = 0
    for k, piece in enumerate(pieces):
        beams = _beams(scan, piece)
        if k and math.dist(pieces[k - 1].end, piece.start) > MAX_TOUCH_GAP:
            surface += 1
        surfaces[beams] = surface
        points[beams] = _hits(scan, piece, beams)
        if (
            isinstance(piece, Wall)
            and len(beams) >= settings.wall_beams
            and piece.length >= settings.wall_length
        ):
            lines[beams] = len(kept)
            kept.append(piece)
    return LabelledScan(scan, noise, points, lines, _owners(kept), surfaces)


def _in_beam_order(scan: Scan, truth: Scene) -> list[Wall | Arc]:
    def place(piece: Wall | Arc) -> float:
        return _turn(scan, math.atan2(piece.start[1], piece.start[0]))

    return sorted((*truth.walls, *truth.arcs), key=place)


def _turn(scan: Scan, bearing: float) -> float:
    """How far a bearing lies after the first beam, radians in [0, 2 pi); the first itself is 0."""
    return (bearing - scan.angle_min + 1e-9) % math.tau


def _beams(scan: Scan, piece: Wall | Arc) -> NDArray[np.intp]:
    """The beams that end on a piece."""
    start, end = (math.atan2(y, x) for x, y in (piece.start, piece.end))
    turned = (scan.angles - start + 1e-9) % math.tau
    return np.flatnonzero(turned <= (end - start) % math.tau + 2e-9)


def _hits(scan: Scan, piece: Wall | Arc, beams: NDArray[np.intp]) -> FloatArray:
    """Where beams meet a wall; along an arc they are taken to be evenly spread."""
    if isinstance(piece, Arc):
        return _spread(piece, len(beams))
    (ax, ay), (bx, by) = piece.start, piece.end
    directions = np.stack((np.cos(scan.angles[beams]), np.sin(scan.angles[beams])), axis=1)
    facing = directions[:, 0] * (by - ay) - directions[:, 1] * (bx - ax)
    return np.asarray(directions * ((ax * by - ay * bx) / facing)[:, None])


def _spread(arc: Arc, count: int) -> FloatArray:
    begin = math.atan2(arc.start[1] - arc.centre[1], arc.start[0] - arc.centre[0])
    angles = begin + np.linspace(0.0, -arc.extent if arc.convex else arc.extent, count)
    return np.asarray(arc.centre + arc.radius * np.stack((np.cos(angles), np.sin(angles)), axis=1))


def _owners(stretches: list[Wall]) -> Labels:
    """The number of the first stretch of the wall that each stretch is a part of."""
    owners = np.arange(len(stretches))
    for k, stretch in enumerate(stretches):
        for j in range(k):
            if _continues(stretches[j], stretch):
                owners[k] = owners[j]
    return owners


def _continues(before: Wall, after: Wall) -> bool:
    """Whether two stretches are of one wall, with nothing between that one could pass."""
    if abs(math.remainder(after.heading - before.heading, math.tau)) > ALIGNED_ANGLE:
        return False
    if math.dist(before.end, after.start) > CLOSED:
        return False
    return abs(_offset(before, after.start)) <= ALIGNED_OFFSET


def _offset(wall: Wall, point: Point) -> float:
    dx, dy = point[0] - wall.start[0], point[1] - wall.start[1]
    return math.cos(wall.heading) * dy - math.sin(wall.heading) * dx


def found_lines(scan: Scan, settings: ExtractorSettings) -> Labels:
    """The wall that the whole chain puts each beam into."""
    directions = beam_directions(len(scan.ranges), scan.angle_min, scan.angle_increment)
    features, scratch = allocate_features(), allocate_scratch(len(directions))
    record, sensor = settings.as_record()[0], sensor_of(scan)
    extract_arrays(scan.ranges.copy(), directions, sensor, record, scratch, features, True)
    walls = features.walls[: features.counts[WALLS]]
    return _filled(len(directions), walls["first"].tolist(), walls["last"].tolist())


def found_surfaces(scan: Scan, settings: ExtractorSettings) -> Labels:
    """The connected group that the breakpoint rule puts each beam into."""
    directions = beam_directions(len(scan.ranges), scan.angle_min, scan.angle_increment)
    scratch = allocate_scratch(len(directions))
    record, beams = settings.as_record()[0], len(directions)
    begin_sweep(beams, sensor_of(scan), record, scratch)
    copy_sweep(scan.ranges.copy(), directions, beams, scratch)
    _, groups = group_points(beams, record, scratch)
    first = scratch.group_first[: groups + 1]
    ends = scratch.beams[first[:-1]].tolist(), scratch.beams[first[1:] - 1].tolist()
    return _filled(len(directions), *ends)


def _filled(beams: int, first: list[int], last: list[int]) -> Labels:
    """Labels of beams in spans; what is between its ends belongs to a span, dropouts included."""
    labels = np.full(beams, NO_SEGMENT)
    for number, (a, b) in enumerate(zip(first, last, strict=True)):
        labels[a : b + 1] = number
    return labels
