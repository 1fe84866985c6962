"""The line through the middles of both jambs, which is that of the door in a floor plan."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from semnav_features.checked_fields import Bounds, Count, Length, check_fields
from semnav_features.clouds.wall_line import WallLine
from semnav_features.frames import FloatArray, Pose


@dataclass(frozen=True)
class RevealRules:
    """Settings for the middle of a jamb across the wall.

    Attributes:
        strip: half the width of the strip at the edge that holds the reveal, metres.
        reach: largest distance of the evaluated points from the wall's line, metres.
        other_wall: distance from the wall's line at which points mean that another wall begins at
            the jamb, on the robot's side, metres: its face is not seen then.
        min_depth: of a frame, metres. Less is seen where the reveal is hidden.
        max_depth: of a frame, metres. More is seen where an open leaf continues the reveal.
        points: fewest points of a jamb.
        sure: standard deviation of a middle where the seen depth is that of a frame, metres.
        leaf: of one that seems deeper, metres.
        unsure: of one whose depth is not seen, metres.
        line: of the wall's line about the middles of the jambs, metres.
        slope: of the direction from jamb to jamb about that of the wall, no unit.
        turn: of that direction about the expected one, radians.
    """

    strip: Annotated[float, Bounds(0.001, 100.0, "m")] = 0.03
    reach: Length = 0.30
    other_wall: Length = 0.27
    min_depth: Length = 0.10
    max_depth: Length = 0.16
    points: Count = 10
    sure: Length = 0.015
    leaf: Length = 0.03
    unsure: Length = 0.05
    line: Length = 0.06
    slope: float = 0.08
    turn: float = 0.08

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class DoorLine:
    """A line t = offset + slope s in the frame of a wall's line.

    Attributes:
        offset: metres, at s = 0.
        slope: no unit.
        covariance: of (offset, slope), shape (2, 2).
    """

    offset: float
    slope: float
    covariance: FloatArray

    @property
    def frame(self) -> Pose:
        """Its frame in that of the wall's line."""
        return 0.0, self.offset, math.atan(self.slope)


@dataclass(frozen=True)
class JambMiddle:
    """Position of a jamb across a wall.

    Attributes:
        left: of its middle from the wall's line, metres to the left.
        sigma: standard deviation, metres.
    """

    left: float
    sigma: float


def jamb_middle(
    points: FloatArray, place: float, side: float, rules: RevealRules
) -> JambMiddle | None:
    """Position of a jamb across a wall; None if its points are few or those of another wall.

    Args:
        points: frame of the wall's line, above the floor, metres, shape (n, 3).
        place: of the jamb along the line, metres.
        side: 1 if the robot is to the left of the line, else -1.
        rules: what a jamb is.
    """
    near = (np.abs(points[:, 0] - place) <= rules.strip) & (np.abs(points[:, 1]) <= rules.reach)
    across = side * points[near, 1]
    if len(across) < rules.points:
        return None
    back, face, farthest = np.quantile(across, (0.05, 0.95, 0.98)).tolist()
    if farthest > rules.other_wall:
        return None
    depth = face - back
    if depth < rules.min_depth:
        return JambMiddle(side * (face - 0.5 * rules.min_depth), rules.unsure)
    if depth > rules.max_depth:
        return JambMiddle(side * (face - 0.5 * rules.max_depth), rules.leaf)
    return JambMiddle(side * (face - 0.5 * depth), rules.sure)


def door_line(
    wall: WallLine, jambs: Sequence[tuple[float, JambMiddle]], rules: RevealRules
) -> DoorLine:
    """Weighted least squares over the middles of the jambs, the wall and the expected direction.

    Args:
        wall: the wall's line, frame of the expected door.
        jambs: place along the wall's line, and middle, of each jamb.
        rules: standard deviations of each.
    """
    slope_sigma = math.hypot(rules.slope, math.sqrt(wall.covariance[1, 1]))
    rows = [
        (1.0, 0.0, 0.0, rules.line),
        (0.0, 1.0, 0.0, slope_sigma),
        (0.0, 1.0, -wall.slope, rules.turn),
        *((1.0, place, middle.left, middle.sigma) for place, middle in jambs),
    ]
    table = np.array(rows)
    design, values = table[:, :2] / table[:, 3:], table[:, 2] / table[:, 3]
    covariance = np.asarray(np.linalg.inv(design.T @ design), dtype=np.float64)
    offset, slope = (covariance @ design.T @ values).tolist()
    return DoorLine(offset, slope, covariance)
