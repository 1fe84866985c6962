"""Doors: gaps of door width in line with a wall, with nothing close behind."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import combinations

import numpy as np

from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.doors import LONGEST_SPACING, SUPPORT_PIECES
from semnav_env.features.reference.sweep import Sweep
from semnav_env.features.reference.walls import Piece, is_wall
from semnav_env.features.scene import Door
from semnav_env.features.settings import ExtractorSettings


def find_doors(sweep: Sweep, pieces: list[Piece], settings: ExtractorSettings) -> list[Door]:
    """The best of every set of overlapping candidates, in beam order."""
    candidates = list(_candidates(sweep, pieces, settings))
    kept: list[int] = []
    for i in sorted(range(len(candidates)), key=lambda i: -candidates[i][0]):
        place = candidates[i][1]
        others = (candidates[k][1] for k in kept)
        if all(math.dist(place.midpoint, o.midpoint) >= settings.door_width_min for o in others):
            kept.append(i)
    return [candidates[i][1] for i in sorted(kept)]


def _candidates(
    sweep: Sweep, pieces: list[Piece], settings: ExtractorSettings
) -> Iterator[tuple[float, Door]]:
    jambs = [k for k, piece in enumerate(pieces) if len(piece.beams) >= settings.jamb_beams]
    for a, b in combinations(jambs, 2):
        start, end = pieces[a].end, pieces[b].start
        beams = range(pieces[a].beams[-1] + 1, pieces[b].beams[0])
        spacing = [_beam_spacing(jamb, end - start, sweep.increment) for jamb in (start, end)]
        if len(beams) < settings.door_beams or not _has_width(start, end, spacing, settings):
            continue
        misfit = _misfit(pieces, a, b, settings)
        if misfit is None:
            continue
        clear = _clear_fraction(sweep, beams, start, end, settings)
        if clear >= settings.door_clear_fraction:
            along = (end - start) / np.linalg.norm(end - start)
            first, last = start + 0.5 * spacing[0] * along, end - 0.5 * spacing[1] * along
            yield clear - misfit, Door(tuple(first.tolist()), tuple(last.tolist()))


def _has_width(
    start: FloatArray, end: FloatArray, spacing: list[float], settings: ExtractorSettings
) -> bool:
    width = float(np.linalg.norm(end - start))
    tolerance = settings.door_width_tolerance
    widest = settings.door_width_max + tolerance
    return width >= settings.door_width_min - tolerance and width - sum(spacing) <= widest


def _beam_spacing(point: FloatArray, gap: FloatArray, increment: float) -> float:
    """R dphi / sin(incidence) on a line through a point, at most `LONGEST_SPACING`."""
    size = float(np.linalg.norm(gap))
    across = abs(gap[0] * point[1] - gap[1] * point[0]) / size if size > 0.0 else 0.0
    along = float(point @ point) * increment
    return along / across if along < across * LONGEST_SPACING else LONGEST_SPACING


def _misfit(pieces: list[Piece], a: int, b: int, settings: ExtractorSettings) -> float | None:
    """0 to 1 with a wall on both sides of the gap, 1 to 2 with one, None with no wall."""
    start, end = pieces[a].end, pieces[b].start
    walls_before = [p for p in pieces[max(a - SUPPORT_PIECES + 1, 0) : a + 1][::-1]]
    walls_after = pieces[b : b + SUPPORT_PIECES]
    before = [_support(p, p.end, start, end, 1.0, settings) for p in walls_before]
    after = [_support(p, p.start, end, start, -1.0, settings) for p in walls_after]
    best = [next((s for s in side if s is not None), None) for side in (before, after)]
    found = [s for s in best if s is not None]
    if len(found) == 2:
        return max(found)
    return 1.0 + found[0] if found and settings.one_sided_doors else None


def _support(
    wall: Piece,
    wall_end: FloatArray,
    near: FloatArray,
    far: FloatArray,
    sense: float,
    settings: ExtractorSettings,
) -> float | None:
    """How far the far jamb is from the wall's line as a share of what is allowed, or None."""
    gap = far - near
    if not is_wall(wall, settings) or np.linalg.norm(near - wall_end) > settings.door_wall_gap:
        return None
    if sense * (gap @ wall.along) <= 0.0:
        return None
    near_error, far_error = (
        settings.confidence * wall.deviation(jamb, settings.sigma) for jamb in (near, far)
    )
    if abs(wall.offset(near)) > settings.door_offset_tolerance + near_error:
        return None
    if far_error > settings.door_line_error:
        return None
    allowed = settings.door_point_tolerance + far_error
    allowed += math.tan(settings.door_angle_tolerance) * float(np.linalg.norm(gap))
    return abs(wall.offset(far)) / allowed if 0.0 < allowed >= abs(wall.offset(far)) else None


def _clear_fraction(
    sweep: Sweep, beams: range, start: FloatArray, end: FloatArray, settings: ExtractorSettings
) -> float:
    """Share of the beams that reach well beyond the chord, or 0 where it is no opening."""
    gap = end - start
    width, chord = float(np.linalg.norm(gap)), start[0] * gap[1] - start[1] * gap[0]
    if chord <= 0.0:
        return 0.0
    chosen = np.array(beams)
    missing = ~sweep.returned[chosen]
    slant = sweep.directions[chosen, 0] * gap[1] - sweep.directions[chosen, 1] * gap[0]
    with np.errstate(invalid="ignore"):
        beyond = np.where(missing, np.inf, sweep.ranges[chosen] * slant - chord)
    if (beyond[[0, -1]] < -settings.door_depth * slant[[0, -1]]).any():
        return 0.0
    deep = np.count_nonzero(beyond >= settings.door_recess * width)
    if deep < settings.door_deep_fraction * len(chosen):
        return 0.0
    return float(np.count_nonzero(beyond >= settings.door_depth * slant) / len(chosen))
