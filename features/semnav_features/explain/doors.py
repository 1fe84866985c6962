"""Why a gap between two possible jambs is no door."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from semnav_features.elements import Rejection
from semnav_features.explain.trace import Trace
from semnav_features.frames import FloatArray
from semnav_features.kernels import door_evidence as beams
from semnav_features.kernels import doors as kernel
from semnav_features.kernels.evidence_layout import EVIDENCE
from semnav_features.kernels.jambs import find_jambs
from semnav_features.kernels.scratch import CANDIDATE

LEAST_GAP = 0.3
"""Width below which a gap is a corner or a crack that nobody takes for a door, metres."""


def rejected_doors(trace: Trace) -> Iterator[Rejection]:
    """Every gap between possible jambs that is no door, in beam order.

    A gap of a door's width is looked at with all jambs that it could have. One that is too narrow,
    too wide or of too few beams is named only if there is nothing between its jambs.
    """
    tried = GapTrial(trace)
    starts, ends = find_jambs(_groups(trace), len(trace.pieces), trace.scratch)
    for start in trace.scratch.start_jambs[:starts]:
        after = [end for end in trace.scratch.end_jambs[:ends] if end["beam"] > start["beam"]]
        for k, end in enumerate(after):
            if tried.is_full or not tried.is_near(start, end):
                break
            if reason := tried.reason(start, end, is_next=k == 0):
                yield Rejection("door", *_points(start, end), reason)


def _groups(trace: Trace) -> int:
    """Number of connected groups of points: the last one ends with the last point."""
    ranges = trace.ranges[: trace.beams_per_turn or len(trace.ranges)]
    scratch = trace.scratch
    valid = (ranges >= scratch.range_min) & (ranges > 0.0) & (ranges < scratch.limit)
    return int(np.argmax(trace.scratch.group_first == valid.sum()))


def _points(start: Any, end: Any) -> tuple[tuple[float, float], tuple[float, float]]:
    return (float(start["x"]), float(start["y"])), (float(end["x"]), float(end["y"]))


class GapTrial:
    """Applies the tests of the kernel `find_candidates` to one gap after the other.

    Args:
        trace: of the scan.
    """

    def __init__(self, trace: Trace) -> None:
        self._trace = trace
        self._gap, self._evidence = np.zeros(1, CANDIDATE), np.zeros(1, EVIDENCE)
        self._longest = kernel.longest_wall(trace.pieces)
        self._accepted = 0

    @property
    def is_full(self) -> bool:
        """Whether the kernel had no room for more candidates."""
        return self._accepted == len(self._trace.scratch.candidates)

    def is_near(self, start: Any, end: Any) -> bool:
        """Whether so few beams lie between two jambs that the gap can be a door."""
        settings = self._trace.settings
        widest = settings.door_width_max + settings.door_width_tolerance
        most = kernel.farthest_beam(
            start, widest + 2.0 * kernel.MAX_BEAM_SPACING, self._trace.scratch.increment
        )
        return bool(end["beam"] <= start["beam"] + most)

    def reason(self, start: Any, end: Any, is_next: bool) -> str:
        """Why a gap is no door; empty if it is one, or is not worth a word."""
        trace, gap, settings = self._trace, self._gap[0], self._trace.settings
        between = int(end["beam"] - start["beam"]) - 1
        width = math.dist(*_points(start, end))
        if between < settings.door_beams:
            named = is_next and between > 0 and width >= LEAST_GAP
            return f"{between} beams pass; door_beams is {settings.door_beams}" if named else ""
        if fault := kernel.set_gap(start, end, trace.scratch.increment, trace.record, gap):
            return self._fault_of_width(fault, width) if is_next and width >= LEAST_GAP else ""
        if fault := beams.measure_gap(gap, trace.record, trace.scratch, self._evidence[0]):
            return self._fault_of_beams(fault)
        return self._fault_of_confidence()

    def _fault_of_width(self, fault: int, width: float) -> str:
        settings = self._trace.settings
        slack = settings.door_width_tolerance
        if fault == kernel.TOO_NARROW:
            return (
                f"{width:.3f} m wide; door_width_min less door_width_tolerance is "
                f"{settings.door_width_min - slack:g}"
            )
        if fault == kernel.TOO_WIDE:
            return (
                f"{width:.3f} m wide; door_width_max and door_width_tolerance are "
                f"{settings.door_width_max + slack:g}"
            )
        return "it is seen from behind"

    def _fault_of_beams(self, fault: int) -> str:
        settings = self._trace.settings
        slant, across = self._across()
        if fault == beams.IN_SHADOW:
            front = -min(across[0] / slant[0], across[-1] / slant[-1])
            return (
                f"a beam beside a jamb ends {front:.3f} m in front of it; door_shadow is "
                f"{settings.door_shadow:g}"
            )
        if fault == beams.TOO_SHALLOW:
            deepest = across.max()
            return (
                f"no beam gets deeper than {deepest:.3f} m, and too few end at the side of the far "
                f"jamb alone; door_recess is {settings.door_recess:g}"
            )
        clear = (across >= settings.door_depth * slant).mean()
        return (
            f"{clear:.3f} of its beams get farther than door_depth, {settings.door_depth:g} m; "
            f"door_clear_fraction is {settings.door_clear_fraction:g}"
        )

    def _across(self) -> tuple[FloatArray, FloatArray]:
        """For each beam of the gap the sine of its angle to the chord, and how deep it gets, m."""
        scratch, gap = self._trace.scratch, self._gap[0]
        chosen = slice(int(gap["first"]), int(gap["last"]) + 1)
        dx, dy = scratch.directions[chosen].T
        slant = dx * gap["along_y"] - dy * gap["along_x"]
        measured = scratch.ranges[chosen]
        seen = (measured >= scratch.range_min) & (measured > 0.0) & (measured < scratch.limit)
        return slant, np.where(seen, measured * slant - gap["distance"], np.inf)

    def _fault_of_confidence(self) -> str:
        trace, gap, evidence = self._trace, self._gap[0], self._evidence[0]
        record, scratch, settings = trace.record, trace.scratch, trace.settings
        beams.measure_walls(gap, trace.pieces, record, scratch, evidence)
        beams.measure_place(gap, *self._longest, evidence)
        numbers = self._evidence.view(np.float64)
        gap["confidence"] = kernel.score(numbers, scratch.scorer)
        if not kernel.is_accepted(gap, record, evidence):
            if gap["confidence"] < settings.door_confidence_min:
                return (
                    f"its confidence is {gap['confidence']:.3f}; door_confidence_min is "
                    f"{settings.door_confidence_min:g}"
                )
            return (
                f"a jamb is {evidence['misfit_more']:.2f} times as far off the line of its wall as "
                "door_point_tolerance and door_angle_tolerance allow, and one_sided_doors is False"
            )
        candidate = scratch.candidates[self._accepted]
        self._accepted += 1
        if candidate["state"] == kernel.KEPT:
            return ""
        return (
            f"its confidence is {candidate['confidence']:.3f}, and a door of a higher one has its "
            f"middle within door_width_min, {settings.door_width_min:g} m"
        )
