"""Every limit of the line map, with its unit."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

from semnav_features.checked_fields import Angle, Bounds, Count, Length, Share, check_fields


@dataclass(frozen=True)
class MapSettings:
    """Limits of `LineMap`. Lengths in metres, angles in radians.

    Attributes:
        position: standard deviation of a scan's pose, metres.
        angle: standard deviation of its heading, radians.
        least_move: a scan is added if the scanner has moved this far since the last one, metres,
        least_turn: or has turned this far, radians.
        confidence: lines may be one if they differ by no more than this many standard deviations
            and the next two tolerances.
        angle_tolerance: of a line's direction, as walls are not quite straight, radians.
        offset_tolerance: of its offset, as walls are not quite flat, metres.
        gap: segments of one line that are farther apart than this stay two walls, because nothing
            is known of the space between, metres. It is narrower than a robot's passage.
        wall_hits: a piece of wall counts when this many scans showed it, and if also ...
        wall_share: ... this share of the scans whose beams ended on it showed it as part of a
            wall: beams also end on lines that only cut corners.
        wall_length: shortest wall, metres.
        wall_reach: walls are taken from scenes up to this distance from the scanner, metres.
        door_jamb: two sightings are one door if both jambs agree to this, metres.
        door_reach: doors are taken from scenes up to this distance, metres.
        door_apart: of doors whose middles are nearer to each other only one counts, metres: two
            do not fit side by side.
        door_sightings: a door counts when it was seen and looked through this often, and if ...
        door_share: ... its mean confidence is at least this, where every scan that looked through
            its opening and did not find it has the confidence 0, and if ...
        door_open: ... this share of the beams that came to its opening passed it.

    Raises:
        ValueError: a limit is no number or out of its bounds; names it.
    """

    position: Length = 0.02
    angle: Angle = math.radians(0.3)
    least_move: Length = 0.1
    least_turn: Angle = math.radians(5.0)
    confidence: Annotated[float, Bounds(0.0, 100.0)] = 3.0
    angle_tolerance: Angle = math.radians(2.0)
    offset_tolerance: Length = 0.03
    gap: Length = 0.3
    wall_hits: Count = 3
    wall_share: Share = 0.15
    wall_length: Length = 0.2
    wall_reach: Length = 8.0
    door_jamb: Length = 0.35
    door_apart: Length = 0.6
    door_reach: Length = 5.0
    door_sightings: Count = 3
    door_share: Share = 0.25
    door_open: Share = 0.6

    def __post_init__(self) -> None:
        check_fields(self)
