"""The chain of Barbret's thesis (2021) as it stands there, to be measured beside this project's.

Algorithms 1 to 7 of chapter 4 with their numbers. Formula (2.3) has two parameters without a value
in the thesis: the worst angle of incidence is that of Borges and Aldon (2004), whose work it takes
up, and sigma that of the lidar. Corner types are those of formula (3.1), the probes of corridors
those of section 3.3. His published script differs from the thesis in places; the thesis counts.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import permutations, product

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray, Point, heading_between, middle_of, wrap_angle
from semnav_features.scan import Scan
from semnav_features.scene import Corner, CornerKind, CorridorProbe, Door, Scene, Wall

RUPTURE_RANGE = 6.0
"""Algorithm 1: points farther away than this are left out, metres."""

WORST_INCIDENCE, SIGMA = math.radians(10.0), 0.02
"""Formula (2.3): the angle lambda, radians (Borges and Aldon 2004), and sigma, metres."""

FEWEST_STEPS, SPLIT_DISTANCE = 3, 0.06
"""Algorithms 3 and 4: so few steps are no wall; distance of a point that splits a piece, metres."""

DOOR_WIDTH, DOOR_ANGLE = (0.8, 1.2), math.radians(2.0)
"""Algorithm 5: widths of a door, metres, and its largest angle to both walls, radians."""

CORNER_ANGLE = math.radians(50.0)
"""Algorithm 6: smallest angle between the walls of a full corner, radians."""

PROBE_LENGTH, PROBED_RANGE = 2.5, 3.0
"""Section 3.3 and algorithm 7: length of a probe; range of corners and of walls met, metres."""

LEAST_MIDPOINT_RANGE, LEAST_HALF_WIDTH = 0.5, 0.3
"""Algorithm 7: least distances of a midpoint from the robot and from its corner, metres."""


@dataclass(frozen=True, eq=False)
class FlaggedPoints:
    """The points of a scan that are near enough, in beam order.

    Attributes:
        points: lidar frame, shape (n, 2), metres.
        ruptures: a beam beside the point has no near return, shape (n,).
        breaks: the point is far from one of its neighbours, shape (n,).
    """

    points: FloatArray
    ruptures: NDArray[np.bool_]
    breaks: NDArray[np.bool_]


def barbret_scene(scan: Scan) -> Scene:
    """Walls, doors, corners and corridors of a scan as the thesis finds them, lidar frame."""
    flagged = flag_points(scan)
    walls = find_walls(flagged)
    corners = list(find_corners(walls))
    corridors = tuple(find_corridors(walls, corners))
    return Scene(walls, tuple(find_doors(walls)), tuple(c for c, _, _ in corners), corridors)


def flag_points(scan: Scan) -> FlaggedPoints:
    """Algorithms 1 and 2: the near points, with rupture and break flags."""
    ranges = scan.ranges
    near = scan.valid & (ranges > 0.0) & (ranges < RUPTURE_RANGE)
    is_lost = np.concatenate(([False], ~near, [False]))
    ruptures = (is_lost[:-2] | is_lost[2:])[near]
    r, angles = ranges[near], scan.angles[near]
    points = np.stack((r * np.cos(angles), r * np.sin(angles)), axis=1)
    step = scan.angle_increment
    most = r[:-1] * math.sin(step) / math.sin(WORST_INCIDENCE - step) + 3.0 * SIGMA
    apart = np.hypot(*np.diff(points, axis=0).T) > most
    breaks = np.concatenate(([False], apart)) | np.concatenate((apart, [False]))
    return FlaggedPoints(points, ruptures, breaks[: len(points)])


def find_walls(flagged: FlaggedPoints) -> tuple[Wall, ...]:
    """Algorithm 3: the pieces of every run of points from one flag to the next."""
    walls: list[Wall] = []
    is_end = flagged.ruptures | flagged.breaks
    start, count = 0, len(is_end)
    while start < count:
        end = start + 1
        while end < count and not is_end[end]:
            end += 1
        if end - start > FEWEST_STEPS:
            walls += _pieces(flagged, start, min(end, count - 1))
        start = end
    return tuple(walls)


def _pieces(flagged: FlaggedPoints, start: int, end: int) -> Iterator[Wall]:
    """Algorithm 4: iterative end-point fit; walls are chords between points."""
    if end - start + 1 <= FEWEST_STEPS:
        return
    first, last = flagged.points[start], flagged.points[end]
    along, away = last - first, flagged.points[start + 1 : end] - first
    chord = max(float(np.hypot(*along)), 1e-9)
    distances = np.abs(along[0] * away[:, 1] - along[1] * away[:, 0]) / chord
    farthest = int(distances.argmax())
    if distances[farthest] > SPLIT_DISTANCE:
        split = start + 1 + farthest
        yield from _pieces(flagged, start, split)
        yield from _pieces(flagged, split, end)
        return
    yield Wall(
        (float(first[0]), float(first[1])),
        (float(last[0]), float(last[1])),
        start_rupture=bool(flagged.ruptures[start]),
        end_rupture=bool(flagged.ruptures[end]),
        start_break=bool(flagged.breaks[start]),
        end_break=bool(flagged.breaks[end]),
        beams=end - start + 1,
    )


def find_doors(walls: tuple[Wall, ...]) -> Iterator[Door]:
    """Algorithm 5: gaps from the end of a wall to the start of another one in line with it."""
    low, high = DOOR_WIDTH
    for before, after in permutations(walls, 2):
        if not low <= math.dist(before.end, after.start) <= high:
            continue
        heading = heading_between(before.end, after.start)
        turns = [wrap_angle(heading_between(w.start, w.end) - heading) for w in (before, after)]
        if max(abs(turn) for turn in turns) <= DOOR_ANGLE:
            yield Door(before.end, after.start)


def find_corners(walls: tuple[Wall, ...]) -> Iterator[tuple[Corner, Wall | None, Wall | None]]:
    """Algorithm 6: full and potential corners, each with the walls that end and start there."""
    starting = {wall.start: wall for wall in walls}
    for wall in walls:
        following = starting.get(wall.end)
        if following is not None:
            turn = heading_between(following.start, following.end)
            if abs(wrap_angle(turn - heading_between(wall.start, wall.end))) > CORNER_ANGLE:
                yield Corner(wall.end, _kind(wall, following)), wall, following
        if wall.start_break or wall.start_rupture:
            yield Corner(wall.start, CornerKind.POTENTIAL), None, wall
        if wall.end_break or wall.end_rupture:
            yield Corner(wall.end, CornerKind.POTENTIAL), wall, None


def _kind(first: Wall, second: Wall) -> CornerKind:
    """Formula (3.1): by the distances of robot and corner from the missing side of the triangle."""
    robot_to_corner = math.hypot(*first.end)
    robot_to_side = _to_segment((0.0, 0.0), first.start, second.end)
    corner_to_side = _to_segment(first.end, first.start, second.end)
    is_inner = robot_to_corner < robot_to_side and not robot_to_side < corner_to_side
    return CornerKind.INNER if is_inner else CornerKind.OUTER


def _to_segment(point: Point, start: Point, end: Point) -> float:
    origin, along = np.array(start), np.subtract(end, start)
    square = max(float(along @ along), 1e-12)
    share = min(max(float((np.array(point) - origin) @ along) / square, 0.0), 1.0)
    return math.dist(point, origin + share * along)


def find_corridors(
    walls: tuple[Wall, ...], corners: list[tuple[Corner, Wall | None, Wall | None]]
) -> Iterator[CorridorProbe]:
    """Algorithm 7: from every inner and potential corner to each wall that a probe meets."""
    for corner, ending, starting in corners:
        if corner.kind is CornerKind.OUTER or math.hypot(*corner.point) >= PROBED_RANGE:
            continue
        for heading, wall in product(_probes(ending, starting), walls):
            if wall is ending or wall is starting:
                continue
            met = _meeting(corner.point, heading, wall)
            if met is None or math.hypot(*met) >= PROBED_RANGE:
                continue
            middle = middle_of(corner.point, met)
            if (
                math.hypot(*middle) > LEAST_MIDPOINT_RANGE
                and math.dist(middle, corner.point) > LEAST_HALF_WIDTH
            ):
                yield CorridorProbe(corner.point, met)


def _probes(ending: Wall | None, starting: Wall | None) -> list[float]:
    """Headings of the probes: along the walls' extensions; of a lone wall also square to it."""
    ahead = [] if ending is None else [heading_between(ending.start, ending.end)]
    back = [] if starting is None else [heading_between(starting.end, starting.start)]
    if ahead and back:
        return ahead + back
    # The free side is to the left of a wall, so to the right of its backward direction.
    return [*ahead, *back, *[h + math.pi / 2 for h in ahead], *[h - math.pi / 2 for h in back]]


def _meeting(corner: Point, heading: float, wall: Wall) -> Point | None:
    """Where a probe crosses a wall; None if it does not."""
    dx, dy = PROBE_LENGTH * math.cos(heading), PROBE_LENGTH * math.sin(heading)
    ex, ey = wall.end[0] - wall.start[0], wall.end[1] - wall.start[1]
    wx, wy = wall.start[0] - corner[0], wall.start[1] - corner[1]
    cross = dx * ey - dy * ex
    if abs(cross) < 1e-12:
        return None
    along, place = (wx * ey - wy * ex) / cross, (wx * dy - wy * dx) / cross
    if not (0.0 < along <= 1.0 and 0.0 <= place <= 1.0):
        return None
    return corner[0] + along * dx, corner[1] + along * dy
