"""The constants of the extraction chain, written down a second time.

Taken from the kernels named here, on purpose not imported: a constant that is changed there by
mistake then makes the tests fail.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from importlib.resources import files

SCORER_FILE = files("semnav_features") / "door_scorer.json"
"""The weights of the scorer of doors, which are data of the package."""

PRIOR_POINTS = 4
"""`walls`: weight of the known sigma in the variance of a wall, in points."""

PIECE_PRICE = 20.0
"""`optimal_partition`: what one more piece must gain, in minus twice the log likelihood."""

MERGE_CHI_SQUARE = 13.8
"""`merging`: quantile 0.999 of chi-square with two degrees of freedom."""

NEXT_WALLS = 3
"""`corners`: so many walls after a wall are tried as the other side of its corner."""

END_ON = 0.1
"""`corridor_probes`: sine of the angle below which a probe passes along a wall."""

LONGEST_SPACING = 0.3
"""`doors`: how far from its last point a jamb may lie, metres."""

LONGEST_REVEAL = 0.5
"""`jambs`: a longer piece is no reveal, metres."""

BEAMS_AT_EDGE = 2
"""`jambs`: a piece that ends within this many beams of the edge of the scan has no end there."""

MOST_VEILED = 2
"""`filters`: beams in a row that may be a veil."""

ROUNDING = 1e-9
"""`filters`: more than rounding can add to a range, as a share of it."""

FEWEST_BEAMS = 8
"""`full_circle`: a circle of fewer beams is not taken for one."""


@dataclass(frozen=True)
class RobustFit:
    """`robust`: Tukey's constant, number of steps, and squared residuals to a variance."""

    biweight: float = 4.685
    steps: int = 2
    loss: float = 1.271


@dataclass(frozen=True)
class CurvaturePeaks:
    """`curvature`: least turn in radians, and in standard deviations."""

    least_turn: float = math.radians(20.0)
    deviations: float = 3.0


@dataclass(frozen=True)
class ArcRuns:
    """`arc_candidates`: which runs of pieces may be an arc."""

    solid: int = 3
    most_turn: float = math.cos(math.radians(110.0))
    chord_sagitta: float = 12.0
    uneven: float = 1.3
    least_bow: float = 0.25 * 0.25 / 8.0


@dataclass(frozen=True)
class CircleFit:
    """`arcs` and `circles`: near, finest and edge error in sigmas; Gauss-Newton steps."""

    near: float = 3.0
    finest: float = 0.1
    edge_error: float = 0.25
    least_cosine: float = 0.1
    refinements: int = 2


@dataclass(frozen=True)
class Evidence:
    """`door_evidence`: lengths in metres; band_slope, flattest and no_wall without a unit."""

    no_wall: float = 2.0
    support_pieces: int = 3
    deepest: float = 2.0
    longest_support: float = 1.5
    longest_wall: float = 4.0
    narrow: float = 0.8
    wide: float = 0.9
    front: float = 0.1
    at_reveal: float = 0.1
    reveal_hits: int = 2
    beside: float = 0.8
    band: float = 0.05
    band_slope: float = 0.06
    finest: float = 0.06
    flattest: float = 0.02


@dataclass(frozen=True)
class Leaf:
    """`door_leaf`: metres from the jamb, length in widths of the opening, radians."""

    hinge: float = 0.12
    shortest: float = 0.5
    longest: float = 1.15
    narrowest: float = math.radians(20.0)


ROBUST, CURVATURE, ARC_RUNS = RobustFit(), CurvaturePeaks(), ArcRuns()
CIRCLE_FIT, EVIDENCE, LEAF = CircleFit(), Evidence(), Leaf()
