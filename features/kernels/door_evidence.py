"""What speaks for and against a gap being a door, measured in the scan."""

from __future__ import annotations

import math
from typing import Any

from numba import njit

from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.lines import offset
from semnav_env.features.kernels.segmentation import is_return

EVIDENCE = (
    "past_more",  # wall that is missing beside the jambs, metres
    "past_less",
    "misfit_more",  # of the supporting walls, as a share of what is allowed
    "misfit_less",
    "clear",  # share of the beams between the jambs that reach beyond the chord
    "deep",  # and of those that get deeper than a recess
    "front",  # and of those that end in front
    "depth",  # mean depth behind the chord, metres, at most 2
    "beams",  # logarithm of how many there are between the jambs
    "narrow",  # by how much, metres
    "wide",
    "incidence",  # cosine at the middle
    "range",  # of the middle, metres
    "jump_less",  # of the range beside the jambs, metres, -0.5 to 1
    "jump_more",
    "spacing",  # of the beams at both jambs, metres
    "wall_more",  # lengths of the supporting walls, metres, at most 1.5
    "wall_less",
    "skew",  # sine of twice the angle to the scan's longest wall
    "longest",  # length of that wall, metres, at most 4
)
"""Names of the evidence, in order; "more" and "less" are the larger and the smaller of the two
sides, so that mirroring a scan changes nothing."""

NO_WALL = 2.0
"""Misfit where no wall supports a jamb."""
SUPPORT_PIECES = 3
"""So many pieces beside a jamb are tried as the wall that ends there."""
DEEPEST, LONGEST_SUPPORT, LONGEST_WALL = 2.0, 1.5, 4.0
"""Greater depths and lengths say no more, metres."""
NARROW, WIDE = 0.8, 0.9
"""Between these a width is usual, metres."""
FRONT = 0.1
"""A beam that ends so far before the chord is stopped in front of it, metres."""
BESIDE = 0.8
"""Metres beside each jamb in which a wall is looked for."""
BAND, BAND_SLOPE = 0.05, 0.06
"""A wall beside a jamb lies this near the chord's line, metres, and so much more per metre."""
FINEST = 0.06
"""Beams that end nearer together on the chord's line need not all be looked at, metres."""
FLATTEST = 0.02
"""Beams that meet the chord's line at a smaller sine end the search for a wall."""


@njit(cache=True, error_model="numpy")
def measure_gap(
    ranges: FloatArray,
    directions: FloatArray,
    range_min: float,
    limit: float,
    gap: Any,
    settings: Any,
    evidence: FloatArray,
) -> bool:
    """The beams between the jambs: how many reach beyond the chord, and how far.

    Returns:
        Whether it can be an opening. Not so if too few beams pass, if none gets deeper than a
        recess, or if a beam beside a jamb ends in front of the chord: then the jamb is only the
        edge of a shadow.
    """
    first, last = gap.first, gap.last
    start_jump = reach_beyond(ranges, directions, range_min, limit, gap, first)
    end_jump = reach_beyond(ranges, directions, range_min, limit, gap, last)
    if min(start_jump, end_jump) < -settings.door_shadow:
        return False
    clear = deep = front = 0
    depth = 0.0
    for beam in range(first, last + 1):
        measured = ranges[beam]
        if not is_return(measured, range_min, limit):
            clear += 1
            deep += 1
            depth += DEEPEST
            continue
        slant = directions[beam, 0] * gap.along_y - directions[beam, 1] * gap.along_x
        across = measured * slant - gap.distance
        clear += across >= settings.door_depth * slant
        deep += across >= settings.door_recess
        front += across < -FRONT * slant
        depth += min(max(across, 0.0), DEEPEST)
    beams = last - first + 1
    if deep == 0 or clear < settings.door_clear_fraction * beams:
        return False
    start_jump, end_jump = max(min(start_jump, 1.0), -0.5), max(min(end_jump, 1.0), -0.5)
    evidence[4], evidence[5], evidence[6] = clear / beams, deep / beams, front / beams
    evidence[7], evidence[8] = depth / beams, math.log(beams)
    evidence[13], evidence[14] = min(start_jump, end_jump), max(start_jump, end_jump)
    return True


@njit(cache=True, error_model="numpy")
def reach_beyond(
    ranges: FloatArray,
    directions: FloatArray,
    range_min: float,
    limit: float,
    gap: Any,
    beam: int,
) -> float:
    """How far a beam reaches beyond the chord, along the beam, metres; far without a return."""
    if not is_return(ranges[beam], range_min, limit):
        return DEEPEST
    slant = directions[beam, 0] * gap.along_y - directions[beam, 1] * gap.along_x
    return float(ranges[beam] - gap.distance / slant)


@njit(cache=True, error_model="numpy")
def measure_walls(
    ranges: FloatArray,
    directions: FloatArray,
    range_min: float,
    limit: float,
    turn: int,
    gap: Any,
    pieces: int,
    settings: Any,
    scratch: Any,
    evidence: FloatArray,
) -> None:
    """The walls beside the jambs: in line with the gap, long, or missing."""
    before = wall_misfit(gap, -1, pieces, settings, scratch)
    after = wall_misfit(gap, 1, pieces, settings, scratch)
    evidence[2], evidence[3] = max(before[0], after[0]), min(before[0], after[0])
    evidence[16], evidence[17] = max(before[1], after[1]), min(before[1], after[1])
    lacking = missing_wall(ranges, directions, range_min, limit, turn, gap, -1)
    lacking_after = missing_wall(ranges, directions, range_min, limit, turn, gap, 1)
    evidence[0], evidence[1] = max(lacking, lacking_after), min(lacking, lacking_after)


@njit(cache=True, error_model="numpy")
def measure_place(gap: Any, along_x: float, along_y: float, length: float, evidence: Any) -> None:
    """Width, place, and direction against that of the scan's longest wall."""
    width = gap.width - 0.5 * (gap.start_spacing + gap.end_spacing)
    evidence[9], evidence[10] = max(NARROW - width, 0.0), max(width - WIDE, 0.0)
    x, y = 0.5 * (gap.start_x + gap.end_x), 0.5 * (gap.start_y + gap.end_y)
    distance = math.sqrt(x * x + y * y)
    evidence[11], evidence[12] = gap.distance / distance, distance
    evidence[15] = gap.start_spacing + gap.end_spacing
    cosine = along_x * gap.along_x + along_y * gap.along_y
    sine = along_x * gap.along_y - along_y * gap.along_x
    evidence[18] = 2.0 * abs(cosine * sine)
    evidence[19] = min(length, LONGEST_WALL)


@njit(cache=True, error_model="numpy")
def missing_wall(
    ranges: FloatArray,
    directions: FloatArray,
    range_min: float,
    limit: float,
    turn: int,
    gap: Any,
    step: int,
) -> float:
    """Metres of the chord's line beside a jamb that beams pass, so that no wall is there.

    Args:
        ranges: of the scan, like the next three.
        directions: of the beams.
        range_min: shortest valid range.
        limit: longest.
        turn: beams of a full circle, 0 if the scan is none.
        gap: the candidate.
        step: -1 for the side before its start, 1 for that after its end.
    """
    beam = gap.first - 1 if step < 0 else gap.last + 1
    x, y = (gap.start_x, gap.start_y) if step < 0 else (gap.end_x, gap.end_y)
    origin = gap.along_x * x + gap.along_y * y
    side = 1.0 if step > 0 else -1.0
    spacing = gap.start_spacing if step < 0 else gap.end_spacing
    step *= max(int(FINEST / spacing), 1)
    missing = reached = 0.0
    while 0 <= beam < len(ranges) and reached < BESIDE:
        dx, dy = directions[beam, 0], directions[beam, 1]
        slant = dx * gap.along_y - dy * gap.along_x
        if slant <= FLATTEST:
            break
        along = gap.distance / slant * (dx * gap.along_x + dy * gap.along_y)
        place = side * (along - origin)
        if place > reached:
            measured = ranges[beam]
            across = measured * slant - gap.distance
            if across > BAND + BAND_SLOPE * place or not is_return(measured, range_min, limit):
                missing += min(place, BESIDE) - reached
            reached = place
        beam += step
        if beam < 0:
            beam += turn
    return missing


@njit(cache=True, error_model="numpy")
def wall_misfit(
    gap: Any, step: int, pieces: int, settings: Any, scratch: Any
) -> tuple[float, float]:
    """How far the jambs are from the line of the wall that best supports one of them.

    As a share of what is allowed: `confidence` standard deviations of the fitted line there, plus
    the allowances for real walls, which are no straight lines.

    Args:
        gap: the candidate.
        step: -1 for a wall before its start, 1 for one after its end.
        pieces: how many there are.
        settings: limits.
        scratch: with the pieces.

    Returns:
        The share, at most `NO_WALL`, and the wall's length in metres.
    """
    k = gap.start_piece if step < 0 else gap.end_piece
    x, y = (gap.start_x, gap.start_y) if step < 0 else (gap.end_x, gap.end_y)
    far_x, far_y = (gap.end_x, gap.end_y) if step < 0 else (gap.start_x, gap.start_y)
    best, length = NO_WALL, 0.0
    for _ in range(SUPPORT_PIECES):
        if k < 0 or k >= pieces:
            break
        wall = scratch.pieces[k]
        k += step
        if wall.wall < 0 or gap.along_x * wall.along_x + gap.along_y * wall.along_y <= 0.0:
            continue
        end_x = wall.end_x if step < 0 else wall.start_x
        end_y = wall.end_y if step < 0 else wall.start_y
        if (end_x - x) ** 2 + (end_y - y) ** 2 > settings.door_wall_gap**2:
            continue
        allowed = settings.door_point_tolerance + settings.door_angle_tolerance * gap.width
        misfit = misfit_at(wall, far_x, far_y, allowed, settings)
        if misfit >= best:
            continue
        misfit = max(misfit, misfit_at(wall, x, y, settings.door_point_tolerance, settings))
        if misfit < best:
            best, length = misfit, min(wall.length, LONGEST_SUPPORT)
    return best, length


@njit(cache=True, error_model="numpy")
def misfit_at(wall: Any, x: float, y: float, allowance: float, settings: Any) -> float:
    """Distance of a point from a wall's line as a share of what is allowed there."""
    allowed = allowance + settings.confidence * line_deviation(wall, x, y, settings.sigma)
    return float(abs(offset(wall, x, y)) / max(allowed, 1e-9))


@njit(cache=True, error_model="numpy")
def line_deviation(piece: Any, x: float, y: float, sigma: float) -> float:
    """Standard deviation of a fitted line beside (x, y), metres.

    sigma sqrt(1/n + t^2 / sum t_i^2) with t along the line from the mean of its n points: the
    prediction of a straight-line regression.
    """
    along = piece.along_x * (x - piece.mean_x) + piece.along_y * (y - piece.mean_y)
    return float(sigma * math.sqrt(1.0 / piece.points + along * along / piece.spread))
