"""Finds doors: gaps of a door's width with room behind, which a small scorer takes for doors."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.door_evidence import (
    FITS,
    measure_gap,
    measure_place,
    measure_walls,
)
from semnav_features.kernels.door_leaf import find_leaf
from semnav_features.kernels.evidence_layout import BIAS_ROW, OFFSET_ROW, OUTPUT_ROW
from semnav_features.kernels.jambs import find_jambs

UNDECIDED, KEPT, SUPPRESSED = range(3)
"""Values of a candidate's `state`."""

TOO_NARROW, TOO_WIDE, FROM_BEHIND = range(1, 4)
"""What is wrong with the width or the side of a gap; 0, `FITS`, if nothing is."""

MAX_BEAM_SPACING = 0.3
"""Largest distance between neighbouring hits beside a jamb, metres. At a grazing angle hits are
farther apart, but the jamb is still taken to lie this close to the last point."""


@kernel
def find_doors(groups: int, pieces: int, settings: Any, scratch: Any, doors: np.ndarray) -> int:
    """Score every pair of jambs and write the best of those that overlap, in beam order.

    Returns:
        How many doors were written.
    """
    found = find_candidates(groups, pieces, settings, scratch)
    candidates = scratch.candidates[:found]
    keep_best(candidates, settings.door_width_min)
    count = 0
    for i in range(found):
        if candidates[i].state == KEPT and count < len(doors):
            write_door(candidates[i], scratch.pieces[:pieces], doors[count])
            count += 1
    return count


@kernel
def find_candidates(groups: int, pieces: int, settings: Any, scratch: Any) -> int:
    """Write gaps that can be doors, with their evidence and score; returns how many.

    Starts and ends of openings are sorted by beam. So `low`, the first end that is far enough from
    the start, only grows, and the inner loop stops at the last end that is near enough.
    """
    starts, ends = find_jambs(groups, pieces, scratch)
    found_pieces, increment = scratch.pieces[:pieces], scratch.increment
    along_x, along_y, length = longest_wall(found_pieces)
    widest = settings.door_width_max + settings.door_width_tolerance + 2.0 * MAX_BEAM_SPACING
    found = low = 0
    for i in range(starts):
        start = scratch.start_jambs[i]
        while low < ends and scratch.end_jambs[low].beam <= start.beam + settings.door_beams:
            low += 1
        last = start.beam + farthest_beam(start, widest, increment)
        for j in range(low, ends):
            end = scratch.end_jambs[j]
            if end.beam > last or found == len(scratch.candidates):
                break
            gap, evidence = scratch.candidates[found], scratch.evidence[found]
            if set_gap(start, end, increment, settings, gap) != FITS:
                continue
            if measure_gap(gap, settings, scratch, evidence) != FITS:
                continue
            measure_walls(gap, found_pieces, settings, scratch, evidence)
            measure_place(gap, along_x, along_y, length, evidence)
            numbers = scratch.evidence[found : found + 1].view(np.float64)
            gap.confidence = score(numbers, scratch.scorer)
            found += is_accepted(gap, settings, evidence)
    return found


@kernel
def is_accepted(gap: Any, settings: Any, evidence: Any) -> bool:
    """Whether a candidate is confident enough, and has the walls in line that are asked for."""
    both_in_line = evidence.misfit_more <= 1.0
    return bool(
        gap.confidence >= settings.door_confidence_min
        and (settings.one_sided_doors or both_in_line)
    )


@kernel
def score(evidence: FloatArray, scorer: FloatArray) -> float:
    """How likely a gap with that evidence is a door, 0 to 1; see `features.door_scorer`."""
    total = scorer[OFFSET_ROW, 0]
    for unit in range(scorer.shape[1]):
        level = scorer[BIAS_ROW, unit]
        for k in range(BIAS_ROW):
            level += scorer[k, unit] * evidence[k]
        total += scorer[OUTPUT_ROW, unit] * level / (1.0 + abs(level))
    return float(1.0 / (1.0 + math.exp(-total)))


@kernel
def longest_wall(pieces: np.ndarray) -> tuple[float, float, float]:
    """Direction and length of the longest straight piece; length 0 if there is none."""
    if len(pieces) == 0:
        return 1.0, 0.0, 0.0
    best = 0
    for k in range(len(pieces)):
        if pieces[k].length > pieces[best].length:
            best = k
    return pieces[best].along_x, pieces[best].along_y, pieces[best].length


@kernel
def farthest_beam(jamb: Any, widest: float, increment: float) -> int:
    """How many beams from a jamb the other one can be, at most.

    A chord of width w from a point at distance r spans asin(w / r) or less: it is seen square on
    at its far end. The arc sine is at most pi / 2 times its argument.
    """
    distance = math.sqrt(jamb.x * jamb.x + jamb.y * jamb.y)
    span = math.pi if distance <= widest else 0.5 * math.pi * widest / distance
    return int(span / increment) + 1


@kernel
def set_gap(start: Any, end: Any, increment: float, settings: Any, gap: Any) -> int:
    """Write the gap between two jambs; returns `FITS` if it can have the width of a door.

    A jamb lies up to one beam spacing past the last point that was seen, so the width is only
    known as an interval; it must meet the interval of door widths. The near end of a reveal is the
    jamb itself: it has no such slack.

    Returns:
        `FITS`, `TOO_NARROW`, `TOO_WIDE` or `FROM_BEHIND`.
    """
    x, y = end.x - start.x, end.y - start.y
    square = x * x + y * y
    widest = settings.door_width_max + settings.door_width_tolerance
    narrowest = settings.door_width_min - settings.door_width_tolerance
    if not (square >= narrowest**2) & (square <= (widest + 2.0 * MAX_BEAM_SPACING) ** 2):
        return TOO_NARROW if square < narrowest**2 else TOO_WIDE
    width = math.sqrt(square)
    x, y = x / width, y / width
    gap.distance = start.x * y - start.y * x
    if gap.distance <= 0.0:
        return FROM_BEHIND
    gap.start_spacing = beam_spacing(start, gap.distance, increment)
    gap.end_spacing = beam_spacing(end, gap.distance, increment)
    gap.start_slack = 0.0 if start.is_reveal else gap.start_spacing
    gap.end_slack = 0.0 if end.is_reveal else gap.end_spacing
    gap.width, gap.along_x, gap.along_y = width, x, y
    gap.start_x, gap.start_y, gap.end_x, gap.end_y = start.x, start.y, end.x, end.y
    gap.first, gap.last = start.beam + 1, end.beam - 1
    gap.start_piece, gap.end_piece = start.piece, end.piece
    return FITS if width - gap.start_slack - gap.end_slack <= widest else TOO_WIDE


@kernel
def beam_spacing(jamb: Any, distance: float, increment: float) -> float:
    """Distance between the hits of neighbouring beams near a jamb on the chord's line, metres."""
    square = jamb.x * jamb.x + jamb.y * jamb.y
    if square * increment >= distance * MAX_BEAM_SPACING:
        return MAX_BEAM_SPACING
    return float(square * increment / distance)


@kernel
def keep_best(candidates: np.ndarray, nearest: float) -> None:
    """Keep the best of every set of candidates whose midpoints are close together.

    Candidates are compared by place and not by angle, so that a door seen through a door stays.
    """
    found = len(candidates)
    for i in range(found):
        candidates[i].state = UNDECIDED
    while True:
        best = -1
        for i in range(found):
            if candidates[i].state == UNDECIDED and (
                best < 0 or candidates[i].confidence > candidates[best].confidence
            ):
                best = i
        if best < 0:
            break
        suppress_near(candidates, best, nearest)
        candidates[best].state = KEPT


@kernel
def suppress_near(candidates: np.ndarray, best: int, nearest: float) -> None:
    """Suppress the open candidates near the best one."""
    chosen = candidates[best]
    for i in range(len(candidates)):
        other = candidates[i]
        dx = chosen.start_x + chosen.end_x - other.start_x - other.end_x
        dy = chosen.start_y + chosen.end_y - other.start_y - other.end_y
        if other.state == UNDECIDED and dx * dx + dy * dy < (2.0 * nearest) ** 2:
            other.state = SUPPRESSED


@kernel
def write_door(gap: Any, pieces: np.ndarray, door: Any) -> None:
    """Write a door, its jambs where they are expected: in the middle of their slack."""
    start, end = 0.5 * gap.start_slack, 0.5 * gap.end_slack
    door.start_x, door.start_y = (
        gap.start_x + start * gap.along_x,
        gap.start_y + start * gap.along_y,
    )
    door.end_x, door.end_y = gap.end_x - end * gap.along_x, gap.end_y - end * gap.along_y
    door.confidence = gap.confidence
    door.hinge, door.leaf_angle = find_leaf(gap, pieces)
