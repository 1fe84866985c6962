"""Corridors of walls that are known: probes from corners that end square on another wall."""

from __future__ import annotations

import math

from semnav_features.frames import Point
from semnav_features.scan import Scan
from semnav_features.scene import CornerKind, CorridorProbe, Wall
from semnav_features.settings import ExtractorSettings
from studies.truth.corners import Joint

END_ON = 0.1
"""Sine of the angle below which a probe passes along a wall instead of meeting it."""


def true_corridors(
    scan: Scan, walls: list[Wall], joints: list[Joint], settings: ExtractorSettings
) -> tuple[CorridorProbe, ...]:
    """The corridors of the walls that the extractor would take for walls, as it finds them.

    Args:
        scan: without errors.
        walls: in view.
        joints: of these walls.
        settings: which walls are long and dense enough, and what a corridor is.
    """
    known = [
        wall
        for wall in walls
        if wall.length >= settings.wall_length and wall.beams >= settings.wall_beams
    ]
    found: list[CorridorProbe] = []
    for joint in joints:
        own = [wall for wall in (joint.ending, joint.starting) if wall]
        if joint.kind == CornerKind.OUTER or any(wall not in known for wall in own):
            continue
        others = [wall for wall in known if wall not in own]
        for along in _probes(joint):
            end = _nearest_wall(joint.point, along, others, settings)
            if end is None:
                continue
            probe = CorridorProbe(joint.point, end)
            if _in_reach(probe, found, settings) and _is_seen(probe, scan, settings):
                found.append(probe)
    return tuple(found)


def _probes(joint: Joint) -> list[Point]:
    """Both walls' extensions at an inner corner; straight on and across at a potential one."""
    ahead = [_direction(joint.ending)] if joint.ending else []
    if joint.starting:
        x, y = _direction(joint.starting)
        ahead.append((-x, -y))
    if joint.kind == CornerKind.INNER:
        return ahead
    wall = joint.ending or joint.starting
    assert wall is not None
    x, y = _direction(wall)
    return [*ahead, (-y, x)]


def _direction(wall: Wall) -> Point:
    """Unit vector from the start to the end."""
    (x1, y1), (x2, y2) = wall.start, wall.end
    return (x2 - x1) / wall.length, (y2 - y1) / wall.length


def _nearest_wall(
    corner: Point, along: Point, walls: list[Wall], settings: ExtractorSettings
) -> Point | None:
    """Where the probe meets the first wall in its way, if that faces it squarely."""
    nearest, squareness = settings.corridor_probe, -1.0
    square = math.cos(settings.corridor_angle_tolerance)
    for wall in walls:
        side = _direction(wall)
        facing = side[0] * along[1] - side[1] * along[0]
        if abs(facing) < END_ON:
            continue
        dx, dy = wall.start[0] - corner[0], wall.start[1] - corner[1]
        reach = (dy * side[0] - dx * side[1]) / facing
        place = (dy * along[0] - dx * along[1]) / facing
        slack = settings.corridor_wall_slack if abs(facing) >= square else 0.0
        if 0.0 < reach <= nearest and -slack <= place <= wall.length + slack:
            nearest, squareness = reach, -facing
    if squareness < square:
        return None
    return corner[0] + nearest * along[0], corner[1] + nearest * along[1]


def _in_reach(
    probe: CorridorProbe, found: list[CorridorProbe], settings: ExtractorSettings
) -> bool:
    """Whether it is wide enough, neither too near nor too far, and not one of those found."""
    away = math.hypot(*probe.midpoint)
    return (
        math.dist(probe.start, probe.end) >= 2.0 * settings.corridor_half_width
        and settings.corridor_distance_min <= away <= settings.corridor_distance_max
        and all(
            math.dist(probe.midpoint, other.midpoint) >= settings.corridor_half_width
            for other in found
        )
    )


def _is_seen(probe: CorridorProbe, scan: Scan, settings: ExtractorSettings) -> bool:
    """Whether a beam passes over the midpoint."""
    x, y = probe.midpoint
    angle = math.remainder(math.atan2(y, x) - scan.angle_min, math.tau)
    if angle < -0.5 * scan.angle_increment:
        angle += math.tau
    beam = math.floor(angle / scan.angle_increment + 0.5)
    if beam >= len(scan.ranges):
        return False
    reach = float(scan.ranges[beam])
    returned = scan.valid[beam] and 0.0 < reach < settings.rupture_range
    return bool(not returned or reach > math.hypot(x, y))
