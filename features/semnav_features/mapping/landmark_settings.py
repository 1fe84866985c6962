"""Every limit of the landmark map, with its unit."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from semnav_features.checked_fields import Bounds, Count, check_fields
from semnav_features.frames import FloatArray


@dataclass(frozen=True)
class LandmarkSettings:
    """Limits of `LandmarkMap` and of its sightings. Lengths in metres, angles in radians.

    Attributes:
        position: standard deviation of a scan's pose, metres; 0 if the poses are exact.
        angle: standard deviation of its heading, radians.
        roughness: standard deviation of a wall from a straight line, metres.
        reach: corners and arcs are taken up to this distance from the scanner, metres.
        end_gap: an end of a wall is a landmark if neighbouring beams meet the wall no farther apart
            than this there, metres.
        agreement: sightings are of one landmark if their squared Mahalanobis distance is below
            this; 9.21 is the limit of 99 % for two unknowns.
        heading_tolerance: the walls at a corner agree up to this angle, radians.
        sightings: a landmark counts when it was seen in this many scans.
        least_move: a scan is added if the scanner has moved this far since the last one, metres,
        least_turn: or has turned this far, radians.

    Raises:
        ValueError: a limit is out of its range; names it and its range.
    """

    position: Annotated[float, Bounds(0.0, 10.0)] = 0.02
    angle: Annotated[float, Bounds(0.0, 1.0)] = math.radians(0.5)
    roughness: Annotated[float, Bounds(1e-4, 1.0)] = 0.002
    reach: Annotated[float, Bounds(0.1, 1000.0)] = 8.0
    end_gap: Annotated[float, Bounds(1e-3, 10.0)] = 0.15
    agreement: Annotated[float, Bounds(0.1, 1000.0)] = 9.21
    heading_tolerance: Annotated[float, Bounds(1e-3, math.pi)] = math.radians(15.0)
    sightings: Count = 3
    least_move: Annotated[float, Bounds(0.0, 100.0)] = 0.1
    least_turn: Annotated[float, Bounds(0.0, math.pi)] = math.radians(5.0)

    def __post_init__(self) -> None:
        check_fields(self)

    @property
    def pose_covariance(self) -> FloatArray:
        """Of a scan's pose: x, y and heading, shape (3, 3)."""
        return np.diag((self.position**2, self.position**2, self.angle**2))
