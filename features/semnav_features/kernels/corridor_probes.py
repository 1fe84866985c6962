"""Finds corridor probes: chords from corners that end square on another wall (Barbret 3.3)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.corners import INNER, OUTER
from semnav_features.kernels.lanes import WIDTH, bits, first_lanes, load
from semnav_features.kernels.remembered import lowest_bit
from semnav_features.kernels.segmentation import is_return

NO_WALL_MET, NOT_SQUARE, TOO_NARROW, TOO_NEAR, TOO_FAR, HIDDEN, REPEATED = range(1, 8)
"""Why a probe finds no corridor; 0 stands for no fault."""

MIN_FACING_SINE = 0.1
"""Sine of the angle between probe and wall below which the probe passes along it."""

ROUNDING_MARGIN = 1e-6
"""More than rounding can add to a distance, metres."""


@kernel
def find_corridors(
    walls: int,
    corner_count: int,
    settings: Any,
    scratch: Any,
    corners: np.ndarray,
    corridors: np.ndarray,
) -> int:
    """Probe from inner and potential corners (Barbret sections 3.3, 4.8).

    An inner corner is probed along the extensions of its two walls; a potential corner
    straight on from its wall (180 degrees) and across from it (90 degrees). The nearest wall
    that the probe meets counts and no other. Of repeated probes the first stays. Where the walls
    are a ring (a full circle), the nearest corner comes first, whatever the first beam.

    Returns:
        How many corridors were written.
    """
    found = nearest = 0
    for c in range(corner_count if scratch.beams_per_turn > 0 else 0):
        a, b = corners[c], corners[nearest]
        nearest = c if a.x**2 + a.y**2 < b.x**2 + b.y**2 else nearest
    square = math.cos(settings.corridor_angle_tolerance)
    note_middles(walls, scratch)
    for k in range(corner_count):
        c = (nearest + k) % corner_count
        corner = corners[c]
        if corner.kind == OUTER or is_remote(corner, settings):
            continue
        ending, starting = scratch.corner_ends[c, 0], scratch.corner_ends[c, 1]
        near = find_near_walls(corner, ending, starting, walls, settings, scratch)
        for probe in range(2):
            along_x, along_y = probe_direction(corner.kind, ending, starting, probe, scratch)
            reach = nearest_wall(
                corner.x, corner.y, along_x, along_y, near, square, settings, scratch
            )
            if reach < 0.0 or found == len(corridors):
                continue
            entry = corridors[found]
            entry.start_x, entry.start_y = corner.x, corner.y
            entry.end_x, entry.end_y = corner.x + reach * along_x, corner.y + reach * along_y
            fault = corridor_fault(entry, settings)
            fault = fault or view_fault(entry, scratch)
            fault = fault or repeat_fault(entry, found, corridors, settings)
            found += not fault
    return found


@kernel
def is_remote(corner: Any, settings: Any) -> bool:
    """Whether no probe of a corner can have its midpoint near enough."""
    farthest = settings.corridor_distance_max + 0.5 * settings.corridor_probe
    return bool(corner.x**2 + corner.y**2 > farthest**2)


@kernel
def probe_direction(
    kind: int, ending: int, starting: int, probe: int, scratch: Any
) -> tuple[float, float]:
    """Unit direction of a corner's first or second probe."""
    if kind == INNER:
        wall = scratch.pieces[scratch.wall_piece[ending if probe == 0 else starting]]
        sense = 1.0 if probe == 0 else -1.0
        return sense * wall.along_x, sense * wall.along_y
    wall = scratch.pieces[scratch.wall_piece[max(ending, starting)]]
    if probe == 1:
        return -wall.along_y, wall.along_x
    sense = 1.0 if ending >= 0 else -1.0
    return sense * wall.along_x, sense * wall.along_y


@kernel
def note_middles(walls: int, scratch: Any) -> None:
    """Write the middle and half the length of each wall, so that many are read at once."""
    for k in range(walls):
        wall = scratch.pieces[scratch.wall_piece[k]]
        scratch.middle_xs[k] = 0.5 * (wall.start_x + wall.end_x)
        scratch.middle_ys[k] = 0.5 * (wall.start_y + wall.end_y)
        scratch.half_lengths[k] = 0.5 * wall.length


@kernel
def find_near_walls(
    corner: Any, ending: int, starting: int, walls: int, settings: Any, scratch: Any
) -> int:
    """Note in `scratch.near_pieces` the walls that a probe could reach; returns how many.

    The two walls at the corner are not among them.
    """
    reach = settings.corridor_probe + settings.corridor_wall_slack + ROUNDING_MARGIN
    near = 0
    for start in range(0, walls, WIDTH):
        dx = load(scratch.middle_xs, start) - corner.x
        dy = load(scratch.middle_ys, start) - corner.y
        farthest = reach + load(scratch.half_lengths, start)
        is_near = (dx * dx + dy * dy <= farthest * farthest) & first_lanes(walls - start)
        candidates = bits(is_near)
        while candidates != 0:
            k = start + int(np.int64(lowest_bit(candidates)))
            candidates &= candidates - np.uint64(1)
            scratch.near_pieces[near] = scratch.wall_piece[k]
            near += (k != ending) & (k != starting)
    return near


@kernel
def nearest_wall(
    x: float,
    y: float,
    along_x: float,
    along_y: float,
    near: int,
    square: float,
    settings: Any,
    scratch: Any,
) -> float:
    """Distance along a probe to the first of the `near` walls that it meets, metres.

    The negative of `NO_WALL_MET` if it meets none, and that of `NOT_SQUARE` if it meets that wall
    from behind or too far from square.
    """
    nearest = settings.corridor_probe
    is_any = met = False
    for k in range(near):
        wall = scratch.pieces[scratch.near_pieces[k]]
        dx, dy = wall.start_x - x, wall.start_y - y
        facing = along_y * wall.along_x - along_x * wall.along_y
        place = along_x * dy - along_y * dx
        tilt = abs(facing)
        place = place if facing > 0.0 else -place
        slack = settings.corridor_wall_slack if tilt >= square else 0.0
        reach = (dy * wall.along_x - dx * wall.along_y) / facing
        hit = (
            (tilt >= MIN_FACING_SINE)
            & (place >= -slack * tilt)
            & (place <= (wall.length + slack) * tilt)
        )
        if hit & (reach > 0.0) & (reach <= nearest):  # one branch: they are hard to predict
            nearest = reach
            is_any, met = True, facing <= -square
    if met:
        return float(nearest)
    return float(-NOT_SQUARE if is_any else -NO_WALL_MET)


@kernel
def corridor_fault(entry: Any, settings: Any) -> int:
    """`TOO_NARROW`, or `TOO_NEAR` or `TOO_FAR` for where its midpoint is; 0 if nothing is wrong."""
    width = math.hypot(entry.end_x - entry.start_x, entry.end_y - entry.start_y)
    away = 0.5 * math.hypot(entry.start_x + entry.end_x, entry.start_y + entry.end_y)
    if width < 2.0 * settings.corridor_half_width:
        return TOO_NARROW
    if away < settings.corridor_distance_min:
        return TOO_NEAR
    return TOO_FAR if away > settings.corridor_distance_max else 0


@kernel
def view_fault(entry: Any, scratch: Any) -> int:
    """`HIDDEN` unless a beam passes over the midpoint, so that it lies in free space; else 0."""
    x, y = 0.5 * (entry.start_x + entry.end_x), 0.5 * (entry.start_y + entry.end_y)
    directions, increment = scratch.directions, scratch.increment
    angle = math.atan2(
        directions[0, 0] * y - directions[0, 1] * x, directions[0, 0] * x + directions[0, 1] * y
    )
    if angle < -0.5 * increment:
        angle += 2.0 * math.pi
    place = angle / increment + 0.5
    if place >= scratch.beam_count:
        return HIDDEN
    distance = scratch.ranges[int(place)]
    is_seen = is_return(distance, scratch.range_min, scratch.limit)
    is_free = not is_seen or distance > math.hypot(x, y)
    return 0 if is_free else HIDDEN


@kernel
def repeat_fault(entry: Any, found: int, corridors: np.ndarray, settings: Any) -> int:
    """`REPEATED` if one found before has its midpoint within half the least width; else 0."""
    least = settings.corridor_half_width
    for k in range(found):
        other = corridors[k]
        dx = other.start_x + other.end_x - entry.start_x - entry.end_x
        dy = other.start_y + other.end_y - entry.start_y - entry.end_y
        if dx * dx + dy * dy < (2.0 * least) ** 2:
            return REPEATED
    return 0
