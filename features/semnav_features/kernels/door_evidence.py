"""Measures in the scan what speaks for and against a gap being a door."""

from __future__ import annotations

import math
from typing import Any

from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.lines import offset
from semnav_features.kernels.segmentation import is_return

MISSING_WALL_MISFIT = 2.0
"""Misfit where no wall supports a jamb, as a share of what is allowed: twice the largest that is
accepted."""

SUPPORT_TRIALS = 3
"""Pieces beside a jamb that are tried as the wall that ends there: the nearest may be a door frame
or a stub."""

MAX_DEPTH, MAX_SUPPORT, MAX_WALL_LENGTH = 2.0, 1.5, 4.0
"""Greatest depth behind the chord, and greatest lengths of a supporting wall and of the scan's
longest wall, metres. Greater values say no more about a door, so they are cut off."""

MIN_JUMP, MAX_JUMP = -0.5, 1.0
"""Limits of how far a beam beside a jamb reaches beyond the chord, metres, for the same reason."""

USUAL_WIDTH_MIN, USUAL_WIDTH_MAX = 0.8, 0.9
"""Clear widths of usual doors, metres; a width outside says something against a door."""

FITS, IN_SHADOW, TOO_SHALLOW, TOO_COVERED = range(4)
"""What is wrong with the beams of a gap that can be no opening; `FITS` if nothing is."""

FRONT_DISTANCE = 0.1
"""A beam that ends farther than this before the chord, metres, is stopped in front of the gap."""

REVEAL_TOLERANCE = 0.1
"""A hit on the reveal, the side of the far jamb, lies within this of it along the chord, metres."""

MIN_REVEAL_HITS = 2
"""Fewest beams that must end at the reveal: one alone may be a mixture of two ranges at an edge."""

FLANK_LENGTH = 0.8
"""Length of the chord's line beside each jamb in which a wall is looked for, metres."""

FLANK_TOLERANCE, FLANK_SLOPE = 0.05, 0.06
"""A wall beside a jamb lies at most this far behind the chord's line, metres, and this much farther
for every metre from the jamb: walls are drawn and built a little off."""

FLANK_SPACING = 0.06
"""Where hits on the chord's line are closer together than this, metres, some beams are skipped."""

MIN_INCIDENCE_SINE = 0.02
"""Sine of the angle between beam and chord below which the search for a wall ends: the hits are too
far apart there."""


@kernel
def measure_gap(gap: Any, settings: Any, scratch: Any, evidence: Any) -> int:
    """Measure how many of the beams between the jambs reach beyond the chord, and how far.

    For a unit vector d of a beam and the chord's unit direction u, the sine d x u of the angle
    between them turns a length along the beam into one across the chord.

    A door that is seen at a grazing angle shows no more than its reveal, the side of its far jamb,
    which may be less deep than a recess. Beams that end there count as deep if no beam is.

    Returns:
        `FITS` if the gap can be an opening. It cannot if a beam beside a jamb ends in front of the
        chord, for then the jamb is only the edge of a shadow (`IN_SHADOW`), if no beam gets deeper
        than a recess or ends at the reveal (`TOO_SHALLOW`), or if too few pass (`TOO_COVERED`).
    """
    ranges, directions = scratch.ranges, scratch.directions
    range_min, limit = scratch.range_min, scratch.limit
    first, last = gap.first, gap.last
    start_jump = reach_beyond(gap, first, scratch)
    end_jump = reach_beyond(gap, last, scratch)
    if min(start_jump, end_jump) < -settings.door_shadow:
        return IN_SHADOW
    clear = deep = front = 0
    depth = 0.0
    for beam in range(first, last + 1):
        measured = ranges[beam]
        slant = directions[beam, 0] * gap.along_y - directions[beam, 1] * gap.along_x
        seen = is_return(measured, range_min, limit)
        across = measured * slant - gap.distance if seen else math.inf
        clear += across >= settings.door_depth * slant
        deep += across >= settings.door_recess
        front += across < -FRONT_DISTANCE * slant
        depth += min(max(across, 0.0), MAX_DEPTH)
    beams = last - first + 1
    if deep == 0:
        deep = count_reveal_hits(gap, scratch)
    if deep == 0:
        return TOO_SHALLOW
    if clear < settings.door_clear_fraction * beams:
        return TOO_COVERED
    start_jump = max(min(start_jump, MAX_JUMP), MIN_JUMP)
    end_jump = max(min(end_jump, MAX_JUMP), MIN_JUMP)
    evidence.clear_share, evidence.deep_share = clear / beams, deep / beams
    evidence.front_share, evidence.mean_depth = front / beams, depth / beams
    evidence.log_beams = math.log(beams)
    evidence.jump_less = min(start_jump, end_jump)
    evidence.jump_more = max(start_jump, end_jump)
    return FITS


@kernel
def count_reveal_hits(gap: Any, scratch: Any) -> int:
    """Number of beams that end at the reveal, the side of the far jamb.

    0 if they are fewer than `MIN_REVEAL_HITS`, or if a beam ends before the far jamb: then
    something fills the opening, such as a closed leaf. Every beam must have a return.
    """
    middle = 0.5 * (gap.start_x + gap.end_x) * gap.along_x
    middle += 0.5 * (gap.start_y + gap.end_y) * gap.along_y
    side = 1.0 if middle > 0.0 else -1.0  # the direction along the chord away from the scanner
    far_jamb = side * middle + 0.5 * gap.width
    hits = 0
    for beam in range(gap.first, gap.last + 1):
        dx, dy = scratch.directions[beam, 0], scratch.directions[beam, 1]
        along = side * scratch.ranges[beam] * (dx * gap.along_x + dy * gap.along_y)
        if along < far_jamb - REVEAL_TOLERANCE:
            return 0
        hits += along <= far_jamb + REVEAL_TOLERANCE
    return hits if hits >= MIN_REVEAL_HITS else 0


@kernel
def reach_beyond(gap: Any, beam: int, scratch: Any) -> float:
    """How far a beam reaches beyond the chord, along the beam, metres.

    `MAX_DEPTH` for a beam without a return.
    """
    measured, directions = scratch.ranges[beam], scratch.directions
    if not is_return(measured, scratch.range_min, scratch.limit):
        return MAX_DEPTH
    slant = directions[beam, 0] * gap.along_y - directions[beam, 1] * gap.along_x
    return float(measured - gap.distance / slant)


@kernel
def measure_walls(gap: Any, pieces: Any, settings: Any, scratch: Any, evidence: Any) -> None:
    """Measure the walls beside the jambs: how well in line, how long, and how much is missing."""
    before = wall_misfit(gap, -1, pieces, settings)
    after = wall_misfit(gap, 1, pieces, settings)
    evidence.misfit_more = max(before[0], after[0])
    evidence.misfit_less = min(before[0], after[0])
    evidence.wall_length_more = max(before[1], after[1])
    evidence.wall_length_less = min(before[1], after[1])
    missing_before, missing_after = missing_wall(gap, -1, scratch), missing_wall(gap, 1, scratch)
    evidence.missing_wall_more = max(missing_before, missing_after)
    evidence.missing_wall_less = min(missing_before, missing_after)


@kernel
def measure_place(gap: Any, along_x: float, along_y: float, length: float, evidence: Any) -> None:
    """Measure width, place, and direction relative to the scan's longest wall.

    Args:
        gap: the candidate.
        along_x: unit direction of the longest wall, like the next.
        along_y: the same.
        length: of that wall, metres.
        evidence: written.
    """
    width = gap.width - 0.5 * (gap.start_slack + gap.end_slack)
    evidence.width_below = max(USUAL_WIDTH_MIN - width, 0.0)
    evidence.width_above = max(width - USUAL_WIDTH_MAX, 0.0)
    x, y = 0.5 * (gap.start_x + gap.end_x), 0.5 * (gap.start_y + gap.end_y)
    distance = math.sqrt(x * x + y * y)
    evidence.incidence_cosine, evidence.distance = gap.distance / distance, distance
    evidence.beam_spacing = gap.start_spacing + gap.end_spacing
    cosine = along_x * gap.along_x + along_y * gap.along_y
    sine = along_x * gap.along_y - along_y * gap.along_x
    evidence.skew_sine = 2.0 * abs(cosine * sine)  # sin(2 a) = 2 sin(a) cos(a)
    evidence.longest_wall = min(length, MAX_WALL_LENGTH)


@kernel
def missing_wall(gap: Any, step: int, scratch: Any) -> float:
    """Length of the chord's line beside a jamb that beams pass, so that no wall is there, metres.

    Walks away from the jamb beam by beam. `reached` is how far along the line the walk has come;
    each beam answers for the stretch between the last one's place and its own.

    Args:
        gap: the candidate.
        step: -1 for the side before its start, 1 for that after its end.
        scratch: with the scan.
    """
    ranges, directions, beam_count = scratch.ranges, scratch.directions, scratch.beam_count
    range_min, limit = scratch.range_min, scratch.limit
    beam: int = gap.first - 1 if step < 0 else gap.last + 1
    x, y = (gap.start_x, gap.start_y) if step < 0 else (gap.end_x, gap.end_y)
    origin = gap.along_x * x + gap.along_y * y
    side = 1.0 if step > 0 else -1.0
    spacing = gap.start_spacing if step < 0 else gap.end_spacing
    step *= max(int(FLANK_SPACING / spacing), 1)  # from here on: beams from look to look
    missing = reached = 0.0
    while 0 <= beam < beam_count and reached < FLANK_LENGTH:
        dx, dy = directions[beam, 0], directions[beam, 1]
        slant = dx * gap.along_y - dy * gap.along_x
        if slant <= MIN_INCIDENCE_SINE:
            break
        along = gap.distance / slant * (dx * gap.along_x + dy * gap.along_y)
        place = side * (along - origin)
        if place > reached:
            measured = ranges[beam]
            across = measured * slant - gap.distance
            if across > FLANK_TOLERANCE + FLANK_SLOPE * place or not is_return(
                measured, range_min, limit
            ):
                missing += min(place, FLANK_LENGTH) - reached
            reached = place
        beam += step
        if beam < 0:  # a full circle goes on at its end; else 0 is added and the walk ends
            beam += scratch.beams_per_turn
    return missing


@kernel
def wall_misfit(gap: Any, step: int, pieces: Any, settings: Any) -> tuple[float, float]:
    """How far the jambs lie off the line of the wall that best supports one of them.

    The distance is divided by what is allowed: `confidence` standard deviations of the fitted line
    there, plus allowances for real walls, which are not quite straight.

    Args:
        gap: the candidate.
        step: -1 for a wall before its start, 1 for one after its end.
        pieces: dtype `PIECE`.
        settings: limits.

    Returns:
        The larger quotient of both jambs, at most `MISSING_WALL_MISFIT`, and the wall's length,
        metres.
    """
    k = gap.start_piece if step < 0 else gap.end_piece
    x, y = (gap.start_x, gap.start_y) if step < 0 else (gap.end_x, gap.end_y)
    far_x, far_y = (gap.end_x, gap.end_y) if step < 0 else (gap.start_x, gap.start_y)
    best, length = MISSING_WALL_MISFIT, 0.0
    for _ in range(SUPPORT_TRIALS):
        if k < 0 or k >= len(pieces):
            break
        wall = pieces[k]
        k += step
        if wall.wall < 0 or gap.along_x * wall.along_x + gap.along_y * wall.along_y <= 0.0:
            continue
        end_x = wall.end_x if step < 0 else wall.start_x
        end_y = wall.end_y if step < 0 else wall.start_y
        if (end_x - x) ** 2 + (end_y - y) ** 2 > settings.door_wall_gap**2:
            continue
        allowed = settings.door_point_tolerance + settings.door_angle_tolerance * gap.width
        misfit = misfit_at(wall, far_x, far_y, allowed, settings)
        if misfit >= best:  # the near jamb can only make it worse
            continue
        misfit = max(misfit, misfit_at(wall, x, y, settings.door_point_tolerance, settings))
        if misfit < best:
            best, length = misfit, min(wall.length, MAX_SUPPORT)
    return best, length


@kernel
def misfit_at(wall: Any, x: float, y: float, allowance: float, settings: Any) -> float:
    """Distance of a point from a wall's line as a share of what is allowed there."""
    allowed = allowance + settings.confidence * line_deviation(wall, x, y, settings.sigma)
    return float(abs(offset(wall, x, y)) / max(allowed, 1e-9))


@kernel
def line_deviation(piece: Any, x: float, y: float, sigma: float) -> float:
    """Standard deviation of a fitted line, across itself, beside (x, y), metres.

    sigma sqrt(1/n + t^2 / sum t_i^2), where t is the place of (x, y) along the line, counted from
    the mean of its n points: the prediction error of a straight-line regression.
    """
    along = piece.along_x * (x - piece.mean_x) + piece.along_y * (y - piece.mean_y)
    return float(sigma * math.sqrt(1.0 / piece.points + along * along / piece.spread))
