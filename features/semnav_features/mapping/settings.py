"""Every limit of the scan matcher, with its unit."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from semnav_features.checked_fields import Bounds, Share, check_fields
from semnav_features.mapping.icp import SETTINGS


@dataclass(frozen=True)
class MatchSettings:
    """Limits of `match_scans`. Lengths in metres, angles in radians.

    Attributes:
        sigma: standard deviation of a range, metres; None to estimate it from each scan.
        roughness: standard deviation of a surface from a plane, metres; it limits the weight of
            grazing beams, whose noise is along the wall.
        window: largest number of neighbours on either side of a point to which its line is fitted.
        max_distance: points are paired up to this distance at first, metres.
        outliers: a pair counts while its residual is below this multiple of the root mean square
            of the last round, and of one standard deviation at least.
        point_to_point: pair points with points and move them by Procrustes' closed form,
            instead of points with lines by Gauss-Newton.
        guess_position: standard deviation of the first guess, metres, x and y; it decides only
            where the scans do not.
        guess_angle: standard deviation of its heading, radians.
        tolerance_position: a smaller step ends the search, metres.
        tolerance_angle: the same for its rotation, radians.
        max_iterations: of the search.
        undetermined: the place along a direction counts as undetermined if the information of the
            scans on it is less than this share of that on the direction across.
        fewest_pairs: with fewer pairs there is no match.

    Raises:
        ValueError: a limit is out of its range; names it and its range.
    """

    sigma: Annotated[float | None, Bounds(1e-4, 1.0)] = None
    roughness: Annotated[float, Bounds(1e-4, 1.0)] = 0.003
    window: Annotated[int, Bounds(1, 10_000)] = 20
    max_distance: Annotated[float, Bounds(1e-3, 100.0)] = 0.6
    outliers: Annotated[float, Bounds(1.0, 100.0)] = 3.0
    point_to_point: bool = False
    guess_position: Annotated[float, Bounds(1e-3, 100.0)] = 0.3
    guess_angle: Annotated[float, Bounds(1e-3, 100.0)] = math.radians(15.0)
    tolerance_position: Annotated[float, Bounds(1e-9, 1.0)] = 1e-4
    tolerance_angle: Annotated[float, Bounds(1e-9, 1.0)] = 1e-5
    max_iterations: Annotated[int, Bounds(1, 1000)] = 60
    undetermined: Share = 1e-3
    fewest_pairs: Annotated[int, Bounds(3, 10_000)] = 10

    def __post_init__(self) -> None:
        check_fields(self)

    def as_record(self) -> np.ndarray:
        """The settings as the kernel takes them, shape (1,)."""
        return np.array([tuple(getattr(self, n) for n in SETTINGS.names or ())], SETTINGS)
