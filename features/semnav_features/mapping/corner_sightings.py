"""Corners of a scan as landmarks: each with its covariance and the walls that meet there."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from semnav_features.elements import Corner, CornerKind, Wall
from semnav_features.frames import ORIGIN, FloatArray, Point, wrap_angle
from semnav_features.mapping.gaussians import PlaceEstimate
from semnav_features.mapping.landmark_settings import LandmarkSettings
from semnav_features.mapping.lines import Line, line_of
from semnav_features.mapping.surface import range_noise
from semnav_features.scan import Scan
from semnav_features.scene import Scene, ends_of

_ON_LINE = 1e-6
"""Distance from a line within which a point lies on it, metres: a full corner is computed as the
intersection of its walls' lines."""

_BEAMS_AROUND = 3
"""The last beam of a wall is sought this many beams around its end: noise moves the end along a
grazing wall, and the extractor leaves out some points."""

_SHARED_OUT = 8
"""Points of a wall that the extractor may have given to either wall at its corners. With 8 the mean
NEES of full corners in the bundled plans is 0.9, 1.4 and 1.9 at 10, 20 and 30 mm of noise."""

_MAX_DEVIATIONS = 4.0
"""A beam ends on a wall, or before it, within or beyond this many standard deviations."""


@dataclass(frozen=True, slots=True, eq=False)
class CornerSighting:
    """A corner that a scan shows.

    Attributes:
        place: (x, y), with its covariance.
        arrives: heading of the wall that ends there, radians; None if none is seen.
        leaves: heading of the wall that starts there; None if none is seen.
    """

    place: PlaceEstimate
    arrives: float | None
    leaves: float | None

    @property
    def kind(self) -> CornerKind:
        """Inner or outer by the bend where two walls meet; potential where one is seen."""
        return kind_of(self.arrives, self.leaves)


def kind_of(arrives: float | None, leaves: float | None) -> CornerKind:
    """The kind of a corner where one wall ends and another starts (Barbret (3.1))."""
    if arrives is None or leaves is None:
        return CornerKind.POTENTIAL
    return CornerKind.OUTER if wrap_angle(leaves - arrives) > 0.0 else CornerKind.INNER


def corner_sightings(
    scene: Scene, scan: Scan, settings: LandmarkSettings = LandmarkSettings()
) -> list[CornerSighting]:
    """The corners of a scan that are landmarks, with their covariances.

    **Full corners.** The corner p lies on two fitted lines, n_i . (p - c_i) = 0, whose errors
    across themselves at p have the variances v_1 and v_2. So its covariance is
    N^-1 diag(v_1, v_2) N^-T, with the normals n_1 and n_2 as the rows of N.

    **Potential corners.** A wall that ends in view ends between its last beam and the next one,
    which passes it. The estimate is the middle of that stretch of length d along the unit vector u,
    and an error e of the line across itself moves it along the beam b by e / (n . b). So its
    covariance is d^2 / 12 u u^T + v / (n . b)^2 b b^T. Left out are the ends that move with the
    scanner: what is hidden behind something nearer, what lies at the end of the range, and what
    ends at the edge of the field of view.

    Args:
        scene: extracted from `scan`, in its frame.
        scan: the scan.
        settings: reach, roughness, and the coarsest end of a wall.
    """
    ends, walls = ends_of(scene.walls), list(scene.walls)
    noise = range_noise(scan.ranges, (scan.range_min, scan.range_max))
    found = []
    for corner in scene.corners if walls else ():
        if math.hypot(*corner.point) > settings.reach:
            continue
        if corner.kind is CornerKind.POTENTIAL:
            sighting = _loose_end(corner, walls, ends, scan, noise, settings)
        else:
            sighting = _meeting(corner, walls, ends, settings)
        if sighting is not None:
            found.append(sighting)
    return found


def _meeting(
    corner: Corner, walls: Sequence[Wall], ends: FloatArray, settings: LandmarkSettings
) -> CornerSighting | None:
    """A full corner: the intersection of the wall that ends there and the one that starts there."""
    along = ends[:, 2:] - ends[:, :2]
    off = np.array(corner.point) - ends[:, :2]
    across = np.abs(along[:, 0] * off[:, 1] - along[:, 1] * off[:, 0])
    on_line = across <= _ON_LINE * np.hypot(*along.T)
    if np.count_nonzero(on_line) < 2:
        return None
    from_start = np.where(on_line, np.hypot(*off.T), np.inf)
    from_end = np.where(on_line, np.hypot(*(np.array(corner.point) - ends[:, 2:]).T), np.inf)
    first, second = walls[int(np.argmin(from_end))], walls[int(np.argmin(from_start))]
    if first is second:
        return None
    lines = line_of(first, ORIGIN), line_of(second, ORIGIN)
    normals = np.array([(-math.sin(line.heading), math.cos(line.heading)) for line in lines])
    inverse = np.linalg.inv(normals)
    variances = [
        _chosen(wall.beams) * _variance(line, corner.point, settings)
        for line, wall in zip(lines, (first, second), strict=True)
    ]
    covariance = inverse @ np.diag(variances) @ inverse.T
    place = PlaceEstimate(np.array(corner.point), covariance)
    return CornerSighting(place, lines[0].heading, lines[1].heading)


def _loose_end(
    corner: Corner,
    walls: Sequence[Wall],
    ends: FloatArray,
    scan: Scan,
    noise: float,
    settings: LandmarkSettings,
) -> CornerSighting | None:
    """A potential corner: the end, or the start, of the wall that it was made from."""
    point = np.array(corner.point)
    starts, stops = (np.abs(ends[:, k : k + 2] - point).sum(axis=1) for k in (0, 2))
    at_end = stops.min() <= starts.min()
    wall = walls[int(np.argmin(stops if at_end else starts))]
    line = line_of(wall, ORIGIN)
    stretch = _where_it_ends(line, corner.point, at_end, scan, noise, settings.end_gap)
    if stretch is None or abs(stretch[1] - stretch[0]) > settings.end_gap:
        return None
    point = np.array(line.point(0.5 * (stretch[0] + stretch[1])))
    along = np.array((math.cos(line.heading), math.sin(line.heading)))
    beam = point / np.hypot(*point)
    sine = along[0] * beam[1] - along[1] * beam[0]
    missed = (stretch[1] - stretch[0]) ** 2 / 12.0 + settings.roughness**2
    off = _variance(line, corner.point, settings) / sine**2
    covariance = missed * np.outer(along, along) + off * np.outer(beam, beam)
    headings = (line.heading, None) if at_end else (None, line.heading)
    return CornerSighting(PlaceEstimate(point, covariance), *headings)


def _where_it_ends(
    line: Line, end: Point, at_end: bool, scan: Scan, noise: float, gap: float
) -> tuple[float, float] | None:
    """Places along a wall's line that its last beam and the next one meet, or would meet.

    None if the wall is not seen to end: the next beam ends before it, cannot reach it, or ends
    less than `gap` behind it, where the surface goes on in a bend.
    """
    step = 1 if at_end else -1
    beams = min(len(scan.ranges), round(math.tau / scan.angle_increment))
    is_ring = beams * scan.angle_increment > math.tau - 0.5 * scan.angle_increment
    bearing = (math.atan2(end[1], end[0]) - scan.angle_min) % math.tau
    beam = round(bearing / scan.angle_increment)
    last: tuple[float, float] | None = None
    for ahead in range(-_BEAMS_AROUND, _BEAMS_AROUND + 1):
        following = beam + step * ahead
        met = _met(line, scan, following) if is_ring or 0 <= following < beams else None
        if met is None or met[1] >= scan.range_max:
            return None
        measured, expected = float(scan.ranges[following % beams]), met[1]
        is_return = scan.range_min <= measured < scan.range_max
        if is_return and abs(measured - expected) <= _MAX_DEVIATIONS * noise:
            last = met
        elif is_return and measured < expected + gap:
            return None
        elif last is not None and (is_return or ahead >= 0):
            return last[0], met[0]
    return None


def _met(line: Line, scan: Scan, beam: int) -> tuple[float, float] | None:
    """Place along a line at which a beam meets it, and the range of that place; None if never."""
    angle = scan.angle_min + beam * scan.angle_increment
    c, s = math.cos(angle), math.sin(angle)
    towards = -math.sin(line.heading) * c + math.cos(line.heading) * s
    distance = -line.across((0.0, 0.0))
    if abs(towards) < 1e-9 or distance / towards <= 0.0:
        return None
    reach = distance / towards
    return line.along((reach * c, reach * s)), reach


def _chosen(beams: int) -> float:
    """Factor of the variance of a wall between corners.

    The extractor shares the points around a corner out so that the residuals become small. So
    these points tell less than they seem to, which matters for short walls.
    """
    return beams / max(beams - _SHARED_OUT, 0.25 * beams)


def _variance(line: Line, point: Point, settings: LandmarkSettings) -> float:
    """Variance of a line across itself at a point near it, m^2."""
    return line.variance(line.along(point)) + settings.roughness**2
