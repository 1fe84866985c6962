"""Pairs of scans whose first guess is far off, matched with guesses by corners and without."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from semnav_env.world.maps import FloorPlan
from semnav_features.frames import Pose, relative
from semnav_features.mapping import (
    Match,
    MatchError,
    match_by_corners,
    match_scans,
)
from semnav_features.scan import Scan
from studies.matching.matching import Pair, PairSpec, poses_in, simulated_pairs

RIGHT_PLACE, RIGHT_ANGLE = 0.05, math.radians(1.0)
"""A match is right within these errors, metres and radians."""


@dataclass(frozen=True)
class FarShares:
    """Shares of the pairs that are matched rightly.

    Attributes:
        plain: from the guess alone.
        corners: from the guess and from guesses by corners, by the larger share of inliers.
    """

    plain: float
    corners: float


def far_shares(plan: FloorPlan, off: float, turned: float, pairs: int, sigma: float) -> FarShares:
    """Match pairs 0.3 to 1 m apart whose guess is off by `off` metres and `turned` radians."""
    rng = np.random.default_rng(0)
    spec = PairSpec(sigma, (0.3, 1.0), (0.0, math.radians(30.0)), off, turned)
    right = np.zeros(2)
    for pair in itertools.islice(simulated_pairs(plan, poses_in(plan, rng), rng, spec), pairs):
        right += [_is_right(_match(match, pair), pair) for match in (match_scans, match_by_corners)]
    return FarShares(*(right / pairs).tolist())


def _match(match: Callable[[Scan, Scan, Pose], Match], pair: Pair) -> Match | None:
    try:
        return match(pair.reference, pair.scan, pair.guess)
    except MatchError:
        return None


def _is_right(match: Match | None, pair: Pair) -> bool:
    if match is None:
        return False
    x, y, turn = relative(pair.pose, match.pose)
    return math.hypot(x, y) <= RIGHT_PLACE and abs(turn) <= RIGHT_ANGLE
