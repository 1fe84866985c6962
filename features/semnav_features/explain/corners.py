"""Reasons why two walls make no corner."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from semnav_features.elements import Rejection
from semnav_features.explain.trace import Trace, ends
from semnav_features.frames import wrap_angle
from semnav_features.kernels.corners import (
    ENDS_APART,
    PARTNER_TRIALS,
    PLACE_TOO_FAR,
    TOO_STRAIGHT,
    WALL_GOES_ON,
    full_corner,
)


def rejected_corners(trace: Trace) -> Iterator[Rejection]:
    """Reject pairs of a wall's end and a next wall's start that make no corner."""
    count = len(trace.walls)
    for k in range(count):
        for step in range(1, min(PARTNER_TRIALS, count - 1) + 1):
            partner = (k + step) % count
            if (k + step >= count and trace.beams_per_turn == 0) or _is_joined(trace, k, partner):
                break
            if reason := _reason(trace, k, partner, is_next=step == 1):
                place = ends(trace.walls[k])[1], ends(trace.walls[partner])[0]
                yield Rejection("corner", *place, reason)


def _is_joined(trace: Trace, k: int, partner: int) -> bool:
    return bool(trace.scratch.joints[k]["partner"] == partner)


def _reason(trace: Trace, k: int, partner: int, is_next: bool) -> str:
    """The reason why two walls make no corner; empty if they are not neighbours."""
    a, b, settings = trace.walls[k], trace.walls[partner], trace.settings
    fault, _, _ = full_corner(a, b, trace.record)
    if fault == ENDS_APART:
        gap, limit = math.dist(ends(a)[1], ends(b)[0]), 2 * settings.corner_gap
        return f"the ends are {gap:.3f} m apart; twice corner_gap is {limit:g}" if is_next else ""
    if fault == TOO_STRAIGHT:
        angle, limit = math.degrees(_angle_between(a, b)), math.degrees(settings.corner_angle)
        if angle > limit:
            return f"the walls turn by {angle:.1f} degrees; opposite walls do not meet"
        return f"the walls turn by {angle:.1f} degrees; corner_angle is {limit:g}"
    if fault == PLACE_TOO_FAR:
        return f"the lines meet beyond corner_gap, {settings.corner_gap:g} m, from the ends"
    if fault == WALL_GOES_ON:
        return f"one goes on behind the other, which ends over {settings.corner_fuse:g} m before it"
    return "an end, or the place, belongs to another corner"


def _angle_between(a: Any, b: Any) -> float:
    headings = [math.atan2(piece["along_y"], piece["along_x"]) for piece in (a, b)]
    return abs(wrap_angle(headings[1] - headings[0]))
