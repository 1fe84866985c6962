"""Doors: gaps of door width between things in line, with room behind, told by a small scorer."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.scene import Door
from semnav_features.settings import ExtractorSettings
from tests.numpy_oracle.constants import (
    BEAMS_AT_EDGE,
    LONGEST_REVEAL,
    LONGEST_SPACING,
    SCORER_FILE,
)
from tests.numpy_oracle.door_evidence import Gap, Jamb, evidence_of, is_open
from tests.numpy_oracle.door_leaf import find_leaf
from tests.numpy_oracle.sweep import Sweep
from tests.numpy_oracle.walls import Piece


def find_doors(sweep: Sweep, pieces: list[Piece], settings: ExtractorSettings) -> list[Door]:
    """The best of every set of overlapping candidates, in beam order."""
    gaps = list(_candidates(sweep, pieces, settings))
    kept: list[int] = []
    for i in sorted(range(len(gaps)), key=lambda i: -gaps[i].confidence):
        middle = gaps[i].middle
        if all(math.dist(middle, gaps[k].middle) >= settings.door_width_min for k in kept):
            kept.append(i)
    return [_door(gaps[i], pieces) for i in sorted(kept)]


def confidence(evidence: dict[str, float]) -> float:
    """The formula of `features.door_scorer`."""
    scorer = json.loads(SCORER_FILE.read_text(encoding="utf-8"))
    inputs = np.array([evidence[name] for name in scorer["inputs"]])
    level = np.array(scorer["weights"]) @ inputs + scorer["bias"]
    total = scorer["offset"] + (level / (1.0 + np.abs(level))) @ scorer["output"]
    return float(1.0 / (1.0 + np.exp(-total)))


def _candidates(sweep: Sweep, pieces: list[Piece], settings: ExtractorSettings) -> Iterator[Gap]:
    starts, ends = _jambs(sweep, pieces, settings)
    for start in starts:
        for end in ends:
            gap = _gap(start, end, sweep, settings)
            if gap is None or not is_open(gap, sweep, settings):
                continue
            evidence = evidence_of(gap, sweep, pieces, settings)
            gap = replace(gap, confidence=confidence(evidence))
            supported = settings.one_sided_doors or evidence["misfit_more"] <= 1.0
            if supported and gap.confidence >= settings.door_confidence_min:
                yield gap


def _jambs(
    sweep: Sweep, pieces: list[Piece], settings: ExtractorSettings
) -> tuple[list[Jamb], list[Jamb]]:
    """Where openings may start and end: the ends of pieces, of groups beyond them, and reveals."""
    once = [k for k, p in enumerate(pieces) if not sweep.turn or p.beams[0] < sweep.turn]
    starts = [Jamb(pieces[k].end, pieces[k].beams[-1], k) for k in once]
    ends = [Jamb(piece.start, piece.beams[0], k) for k, piece in enumerate(pieces)]
    for group in sweep.connected_groups(settings):
        first, last = group[0], group[-1]
        if not any(pieces[k].beams[0] <= first <= pieces[k].beams[-1] for k in once):
            k = next((k for k in once if pieces[k].beams[0] > first), len(once))
            ends.append(Jamb(sweep.points([first])[0], first, k))
        if not any(pieces[k].beams[0] <= last <= pieces[k].beams[-1] for k in once):
            k = next((k for k in once[::-1] if pieces[k].beams[-1] < last), -1)
            starts.append(Jamb(sweep.points([last])[0], last, k))
        for k in once:
            piece, recedes = pieces[k], _recedes(pieces[k])
            is_within = first <= piece.beams[0] and piece.beams[-1] <= last
            meets = k > 0 and pieces[k - 1].beams[-1] >= piece.beams[0]
            meets |= not sweep.turn and piece.beams[0] < BEAMS_AT_EDGE
            if piece.beams[-1] == last and recedes > 0 and not meets:
                starts.append(Jamb(piece.start, piece.beams[0], k - 1, is_reveal=True))
            met = k + 1 < len(pieces) and pieces[k + 1].beams[0] <= piece.beams[-1]
            met |= not sweep.turn and piece.beams[-1] >= len(sweep.ranges) - BEAMS_AT_EDGE
            if is_within and piece.beams[0] == first and recedes < 0 and not met:
                ends.append(Jamb(piece.end, piece.beams[-1], k + 1, is_reveal=True))
    return sorted(starts, key=lambda j: j.beam), sorted(ends, key=lambda j: j.beam)


def _recedes(piece: Piece) -> int:
    """1 if a piece short enough for a reveal leads away from the scanner, -1 if towards it."""
    if piece.length > LONGEST_REVEAL:
        return 0
    return int(np.sign(piece.end @ piece.end - piece.start @ piece.start))


def _gap(start: Jamb, end: Jamb, sweep: Sweep, settings: ExtractorSettings) -> Gap | None:
    """The gap between two jambs if it can have the width of a door."""
    chord = end.point - start.point
    width = float(np.linalg.norm(chord))
    widest = settings.door_width_max + settings.door_width_tolerance
    narrowest = settings.door_width_min - settings.door_width_tolerance
    too_narrow = width < narrowest or end.beam - start.beam <= settings.door_beams
    if too_narrow or _farthest_beam(start, widest, sweep) < end.beam:
        return None
    along = chord / width
    distance = float(start.point[0] * along[1] - start.point[1] * along[0])
    if distance <= 0.0:
        return None
    spacing = [_spacing(jamb.point, distance, sweep.increment) for jamb in (start, end)]
    slack = tuple([0.0 if j.is_reveal else s for j, s in zip((start, end), spacing, strict=True)])
    too_wide = width > widest + 2.0 * LONGEST_SPACING or width - sum(slack) > widest
    return None if too_wide else Gap(start, end, along, width, distance, *spacing, slack)


def _farthest_beam(jamb: Jamb, widest: float, sweep: Sweep) -> int:
    """The last beam at which the other jamb can be."""
    distance, reach = float(np.linalg.norm(jamb.point)), widest + 2.0 * LONGEST_SPACING
    angle = math.asin(reach / distance) if distance > reach else math.pi
    return jamb.beam + int(angle / sweep.increment) + 1


def _spacing(point: FloatArray, distance: float, increment: float) -> float:
    """R dphi / sin(incidence) on the chord's line at a jamb, at most `LONGEST_SPACING`."""
    along = float(point @ point) * increment
    return along / distance if along < distance * LONGEST_SPACING else LONGEST_SPACING


def _door(gap: Gap, pieces: list[Piece]) -> Door:
    first = gap.start.point + 0.5 * gap.slack[0] * gap.along
    last = gap.end.point - 0.5 * gap.slack[1] * gap.along
    ends = (tuple(first.tolist()), tuple(last.tolist()))
    return Door(*ends, confidence=gap.confidence, leaf=find_leaf(gap, pieces))
