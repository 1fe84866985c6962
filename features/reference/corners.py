"""Corners: where neighbouring walls meet, and where a wall may turn out of sight."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np

from semnav_env.features.frames import Point
from semnav_env.features.reference.walls import Piece
from semnav_env.features.scene import CornerKind
from semnav_env.features.settings import ExtractorSettings


@dataclass(frozen=True, eq=False)
class FoundCorner:
    """A corner, the wall that ends there and the wall that starts there."""

    point: Point
    kind: CornerKind
    ending: Piece | None
    starting: Piece | None


def find_corners(walls: list[Piece], settings: ExtractorSettings) -> list[FoundCorner]:
    """Full corners between neighbours and potential corners at loose ends, in beam order."""
    joints = [_full_corner(a, b, settings) for a, b in itertools.pairwise(walls)]
    corners: list[FoundCorner] = []
    for wall, before, after in zip(walls, [None, *joints], [*joints, None], strict=False):
        if before is None and (wall.start_break or wall.start_rupture):
            x, y = wall.start.tolist()
            corners.append(FoundCorner((x, y), CornerKind.POTENTIAL, None, wall))
        if after is not None:
            corners.append(after)
        elif wall.end_break or wall.end_rupture:
            x, y = wall.end.tolist()
            corners.append(FoundCorner((x, y), CornerKind.POTENTIAL, wall, None))
    return corners


def corner_kind(before: Point, corner: Point, after: Point) -> CornerKind:
    """Barbret (3.1), the scanner at the origin: inner if rc < rh and not rh < ch.

    rc, rh and ch are the distances from scanner to corner, from scanner to the segment
    between the walls' far ends, and from corner to that segment.
    """
    rc = math.hypot(*corner)
    rh = _distance_to_segment((0.0, 0.0), before, after)
    ch = _distance_to_segment(corner, before, after)
    return CornerKind.INNER if rc < rh and not rh < ch else CornerKind.OUTER


def _distance_to_segment(point: Point, start: Point, end: Point) -> float:
    p, a, b = np.array(point), np.array(start), np.array(end)
    share = np.clip((p - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
    return float(np.linalg.norm(a + share * (b - a) - p))


def _full_corner(a: Piece, b: Piece, settings: ExtractorSettings) -> FoundCorner | None:
    sine = float(a.along[0] * b.along[1] - a.along[1] * b.along[0])
    gap = b.start - a.end
    turn = math.atan2(abs(sine), float(a.along @ b.along))
    if np.linalg.norm(gap) > 2.0 * settings.corner_gap or abs(sine) < 1e-3:
        return None
    past_a, past_b = np.linalg.solve(np.stack((a.along, -b.along), axis=1), gap)
    if turn < settings.corner_angle or max(abs(past_a), abs(past_b)) > settings.corner_gap:
        return None
    x, y = (a.end + past_a * a.along).tolist()
    return FoundCorner((x, y), CornerKind.OUTER if sine > 0 else CornerKind.INNER, a, b)
