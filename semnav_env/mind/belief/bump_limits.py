"""Limits that decide when a contact shows a wall that the lidar does not see."""

from __future__ import annotations

from dataclasses import dataclass

MOST_PIECES = 16
"""Largest number of pieces; a further piece replaces the oldest one."""


@dataclass(frozen=True)
class BumpLimits:
    """Limits of the bump map.

    Attributes:
        piece_length: length of wall that is assumed for one contact, metres.
        least_growth: a contact is new if it makes a known piece longer by this, metres.
        piece_gap: pieces with a smaller gap are joined, metres: no robot fits between them.
        line_offset: largest distance of two pieces from one line, metres: odometry drifts.
        line_slope: largest slope between two pieces on one line, as a tangent.
        look_depth: depth inside the touched object of the point that is looked for in the scan,
            metres.
        seen_depth: the object is seen if a beam ends at most this far behind that point, metres.
        seen_beams: number of neighbouring beams to each side that are checked as well.
        opening_overlap: overlap of a piece with the opening of a door at which the door does not
            count, metres.
    """

    piece_length: float = 0.2
    least_growth: float = 0.05
    piece_gap: float = 0.45
    line_offset: float = 0.15
    line_slope: float = 0.3
    look_depth: float = 0.03
    seen_depth: float = 0.25
    seen_beams: int = 3
    opening_overlap: float = 0.15


LIMITS = BumpLimits()
