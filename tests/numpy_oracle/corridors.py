"""Corridors: probes from corners that end square on another wall."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.scene import CornerKind, CorridorProbe
from semnav_features.settings import ExtractorSettings
from tests.numpy_oracle.constants import END_ON
from tests.numpy_oracle.corners import FoundCorner
from tests.numpy_oracle.sweep import Sweep
from tests.numpy_oracle.walls import Piece


def find_corridors(
    sweep: Sweep, walls: list[Piece], corners: list[FoundCorner], settings: ExtractorSettings
) -> list[CorridorProbe]:
    """Probe from inner and potential corners (Barbret 3.3, 4.8); in a ring the nearest first."""
    found: list[CorridorProbe] = []
    if sweep.is_ring:
        nearest = min(range(len(corners)), key=lambda c: math.hypot(*corners[c].point), default=0)
        corners = corners[nearest:] + corners[:nearest]
    for corner in corners:
        if corner.kind == CornerKind.OUTER:
            continue
        others = [w for w in walls if w is not corner.ending and w is not corner.starting]
        for along in _probes(corner):
            reach = _nearest_wall(np.array(corner.point), along, others, settings)
            if reach is None:
                continue
            x, y = (np.array(corner.point) + reach * along).tolist()
            corridor = CorridorProbe(corner.point, (x, y))
            if (
                _in_reach(corridor, settings)
                and _is_seen(corridor, sweep)
                and all(
                    math.dist(corridor.midpoint, other.midpoint) >= settings.corridor_half_width
                    for other in found
                )
            ):
                found.append(corridor)
    return found


def _probes(corner: FoundCorner) -> list[FloatArray]:
    """Both walls' extensions at an inner corner; straight on and across at a potential one."""
    onward = [corner.ending.along] if corner.ending else []
    onward += [-corner.starting.along] if corner.starting else []
    if corner.kind == CornerKind.INNER:
        return onward
    wall = corner.ending or corner.starting
    assert wall is not None
    return [*onward, np.array((-wall.along[1], wall.along[0]))]


def _nearest_wall(
    corner: FloatArray, along: FloatArray, walls: list[Piece], settings: ExtractorSettings
) -> float | None:
    """Distance to the first wall that the probe meets, if that faces it squarely."""
    nearest, squareness = settings.corridor_probe, -1.0
    square = math.cos(settings.corridor_angle_tolerance)
    for wall in walls:
        matrix = np.stack((along, -wall.along), axis=1)
        facing = float(np.linalg.det(matrix))
        if abs(facing) < END_ON:
            continue
        reach, place = np.linalg.solve(matrix, wall.start - corner)
        slack = settings.corridor_wall_slack if abs(facing) >= square else 0.0
        if 0.0 < reach <= nearest and -slack <= place <= wall.length + slack:
            nearest, squareness = float(reach), -facing
    return nearest if squareness >= square else None


def _in_reach(corridor: CorridorProbe, settings: ExtractorSettings) -> bool:
    width = math.dist(corridor.start, corridor.end)
    away = math.hypot(*corridor.midpoint)
    near, far = settings.corridor_distance_min, settings.corridor_distance_max
    return width >= 2.0 * settings.corridor_half_width and near <= away <= far


def _is_seen(corridor: CorridorProbe, sweep: Sweep) -> bool:
    """Whether a beam passes over the midpoint."""
    x, y = corridor.midpoint
    angle = math.remainder(math.atan2(y, x) - sweep.angle_min, 2.0 * math.pi)
    if angle < -0.5 * sweep.increment:
        angle += 2.0 * math.pi
    place = angle / sweep.increment + 0.5
    if place >= len(sweep.ranges):
        return False
    beam = math.floor(place)
    return bool(not sweep.returned[beam] or sweep.ranges[beam] > math.hypot(x, y))
