"""When a contact tells of a wall that the lidar does not see."""

from __future__ import annotations

from dataclasses import dataclass

MOST_PIECES = 16
"""When so many pieces are known, a new one replaces the oldest."""


@dataclass(frozen=True)
class BumpLimits:
    """What a contact tells.

    Attributes:
        piece_length: length of wall that one contact tells of, metres.
        least_growth: a contact is new if it makes a known piece longer by this, metres.
        piece_gap: pieces nearer to one another are one, metres: no robot gets between them.
        line_offset: largest distance of two pieces from one line, metres: odometry drifts.
        line_slope: largest slope between two pieces on one line, as a tangent.
        look_depth: the place to look for is this far inside what was touched, metres.
        seen_depth: it is seen if a beam ends at most this far behind that place, metres.
        seen_beams: beams to each side that are asked as well.
        opening_overlap: a piece this far inside the opening of a door shows that it is no door,
            metres.
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
