"""Corners: where two walls meet, and where a wall may turn out of sight."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from semnav_features.frames import FloatArray, Point
from semnav_features.scene import CornerKind
from semnav_features.settings import ExtractorSettings
from tests.numpy_oracle.constants import NEXT_WALLS
from tests.numpy_oracle.walls import Piece


@dataclass(frozen=True, eq=False)
class FoundCorner:
    """A corner, the wall that ends there and the wall that starts there."""

    point: Point
    kind: CornerKind
    ending: Piece | None
    starting: Piece | None


def find_corners(
    walls: list[Piece], is_ring: bool, settings: ExtractorSettings
) -> list[FoundCorner]:
    """Full corners where walls meet and potential corners at loose ends, in beam order."""
    joints = _joints(walls, is_ring, settings)
    met = {id(joint.starting) for joint in joints.values()}
    taken = [joint.point for joint in joints.values()]
    corners: list[FoundCorner] = []
    for k, wall in enumerate(walls):
        if id(wall) not in met and (wall.start_break or wall.start_rupture):
            _add_potential(wall.start, None, wall, taken, corners, settings)
        if k in joints:
            corners.append(joints[k])
        elif wall.end_break or wall.end_rupture:
            _add_potential(wall.end, wall, None, taken, corners, settings)
    return corners


def _joints(
    walls: list[Piece], is_ring: bool, settings: ExtractorSettings
) -> dict[int, FoundCorner]:
    """The full corner at the end of each wall that has one."""
    joints: dict[int, FoundCorner] = {}
    for step in range(1, min(NEXT_WALLS, len(walls) - 1) + 1):
        for k in range(len(walls) if is_ring else len(walls) - step):
            other = walls[(k + step) % len(walls)]
            if k in joints or any(joint.starting is other for joint in joints.values()):
                continue
            corner = _full_corner(walls[k], other, settings)
            if corner and _is_free(corner.point, [j.point for j in joints.values()], settings):
                joints[k] = corner
    return joints


def _add_potential(
    place: FloatArray,
    ending: Piece | None,
    starting: Piece | None,
    taken: list[Point],
    corners: list[FoundCorner],
    settings: ExtractorSettings,
) -> None:
    x, y = place.tolist()
    if _is_free((x, y), [*taken, *(corner.point for corner in corners)], settings):
        corners.append(FoundCorner((x, y), CornerKind.POTENTIAL, ending, starting))


def _is_free(point: Point, taken: list[Point], settings: ExtractorSettings) -> bool:
    return all(math.dist(point, other) >= settings.corner_fuse for other in taken)


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
    if _goes_on_behind(-past_a, -past_b, settings) or _goes_on_behind(past_b, past_a, settings):
        return None
    x, y = (a.end + past_a * a.along).tolist()
    return FoundCorner((x, y), CornerKind.OUTER if sine > 0 else CornerKind.INNER, a, b)


def _goes_on_behind(beyond: float, short: float, settings: ExtractorSettings) -> bool:
    """Whether a wall is seen beyond the corner, and the other one ends short of it, metres."""
    return beyond > settings.confidence * settings.sigma and short > settings.corner_fuse
