"""Finds the pose of a scan relative to another one, by iterative closest points (point to line)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from semnav_features.extraction import beam_directions
from semnav_features.frames import ORIGIN, FloatArray, Point, Pose
from semnav_features.mapping.icp import align
from semnav_features.mapping.settings import MatchSettings
from semnav_features.mapping.steps import (
    CHI_SQUARED,
    CONVERGED,
    INLIERS,
    ITERATIONS,
    PAIRS,
    REPORT_SIZE,
    RESIDUAL,
    WEAK_X,
    WEAK_Y,
)
from semnav_features.mapping.surface import ROWS, range_noise, sense_surface
from semnav_features.scan import Scan

DEFAULT_MATCH_SETTINGS = MatchSettings()


class MatchError(ValueError):
    """Two scans cannot be matched; the message says why."""


@dataclass(frozen=True, eq=False, slots=True)
class Match:
    """The pose of a scan relative to a reference scan.

    Attributes:
        pose: of the scan in the frame of the reference, metres and radians.
        covariance: of `pose`, shape (3, 3), metres and radians. Along an undetermined direction
            it is that of the first guess.
        undetermined: the direction, a unit vector in the frame of the reference, along which the
            scans do not determine the position, as in a corridor without features; or None.
        residual: root mean square distance of the paired points to their lines, metres.
        inliers: share of the scan's points that are paired in the end, 0 to 1.
        iterations: number of iterations.
        converged: whether the last step was below the tolerances.
    """

    pose: Pose
    covariance: FloatArray
    undetermined: Point | None
    residual: float
    inliers: float
    iterations: int
    converged: bool


def match_scans(
    reference: Scan,
    scan: Scan,
    guess: Pose = ORIGIN,
    settings: MatchSettings = DEFAULT_MATCH_SETTINGS,
) -> Match:
    """Find the pose of a scan in the frame of another one.

    Every point of the scan is paired with the nearest of the reference; the pose then minimises

        sum w_i (n_i . (R p_i + t - q_i))^2,

    the distances to the lines through the neighbours of q_i (Censi 2008, eq. (2); here by a
    Gauss-Newton step, which is as good as his closed form because it is repeated), and both steps
    are repeated until it converges. The weight is the inverse of the variance of range noise of
    both scans across the line. With `settings.point_to_point` the step is Procrustes' closed form
    instead: the rigid motion with the least sum of |R p_i + t - q_i|^2 (Crosilla 2003, in the
    plane).

    The covariance is the inverse of sum w_i J_i^T J_i, J_i = (n_i, R p_i x n_i), scaled up by the
    weighted mean squared residual where that exceeds one, the first guess counting as one more
    observation.

    Args:
        reference: a scan.
        scan: another one, of the same surroundings, from a lidar that may differ.
        guess: of the scan's pose in the frame of the reference.
        settings: every limit.

    Raises:
        MatchError: too few pairs to determine a pose.
        ValueError: a guess that is not finite.
    """
    if not all(map(math.isfinite, guess)):
        raise ValueError(f"the guess is {guess}; it must be three finite numbers")
    return match_surfaces(
        surface_of(reference, settings), surface_of(scan, settings), guess, settings
    )


@dataclass(frozen=True, eq=False, slots=True)
class ReferenceLines:
    """A scan prepared for matching; keep it to match it with many others.

    Attributes:
        table: shape (`ROWS`, n), see `semnav_features.mapping.surface`.
        angle_min: of the scan, radians.
        angle_increment: of the scan, radians.
    """

    table: FloatArray
    angle_min: float
    angle_increment: float


def surface_of(scan: Scan, settings: MatchSettings = DEFAULT_MATCH_SETTINGS) -> ReferenceLines:
    """The points of a scan with their lines; beams beyond one full turn are left out."""
    directions = beam_directions(len(scan.ranges), scan.angle_min, scan.angle_increment)
    table = np.zeros((ROWS, len(directions)))
    limits = scan.range_min, scan.range_max
    ranges = scan.ranges[: len(directions)]
    sigma = settings.sigma or range_noise(ranges, limits)
    sense_surface(ranges, directions, scan.angle_increment, limits, sigma, settings.window, table)
    return ReferenceLines(table, scan.angle_min, scan.angle_increment)


def match_surfaces(
    reference: ReferenceLines,
    scan: ReferenceLines,
    guess: Pose = ORIGIN,
    settings: MatchSettings = DEFAULT_MATCH_SETTINGS,
) -> Match:
    """Match scans that were prepared before; see `match_scans`."""
    pose, information, report = (
        np.array(guess, dtype=np.float64),
        np.empty((3, 3)),
        np.zeros(REPORT_SIZE),
    )
    align(
        reference.table,
        scan.table,
        reference.angle_min,
        reference.angle_increment,
        _record(settings),
        pose,
        information,
        report,
    )
    if report[INLIERS] < settings.fewest_pairs:
        raise MatchError(
            f"{int(report[INLIERS])} of {int(report[PAIRS])} points of the scan fit the reference; "
            f"a match needs {settings.fewest_pairs}: give a better guess, or scans that overlap"
        )
    x, y, heading = pose.tolist()
    direction = float(report[WEAK_X]), float(report[WEAK_Y])
    weak = direction if any(direction) else None
    excess = max(1.0, report[CHI_SQUARED] / max(report[INLIERS] - 3.0, 1.0))
    return Match(
        (x, y, heading),
        _covariance(information / excess, weak, settings),
        weak,
        float(report[RESIDUAL]),
        float(report[INLIERS] / report[PAIRS]),
        int(report[ITERATIONS]),
        bool(report[CONVERGED]),
    )


def _covariance(information: FloatArray, weak: Point | None, settings: MatchSettings) -> FloatArray:
    """The inverse of the information of pairs and guess; along `weak` the pairs have none."""
    if weak is not None:
        information = without_place(information, weak)
    values, vectors = np.linalg.eigh(information)
    known = (vectors * np.maximum(values, 0.0)) @ vectors.T
    guess = (settings.guess_position, settings.guess_position, settings.guess_angle)
    return np.asarray(np.linalg.inv(known + np.diag(1.0 / np.square(guess))), np.float64)


def without_place(information: FloatArray, direction: Point) -> FloatArray:
    """The information without its part on the position along a direction, for any heading.

    With the blocks A of the position, b between position and heading, and c of the heading, the
    information on the position for an unknown heading is S = A - b b^T / c. If S w = l w, then

        I - l (w, 0) (w, 0)^T

    says nothing of the motion (w, -b.w / c), which goes along w and turns as the pairs demand,
    and as much as before of every other. Nothing is divided by l, which may be 0 or, as part of
    the information is an estimate, below.

    Args:
        information: of x, y and heading, shape (3, 3).
        direction: w, a unit vector along an axis of S.
    """
    w = np.array(direction)
    coupling = float(information[:2, 2] @ w)
    known = float(w @ information[:2, :2] @ w) - coupling**2 / max(information[2, 2], 1e-12)
    rest = information.copy()
    rest[:2, :2] -= known * np.outer(w, w)
    return rest


@lru_cache(maxsize=16)
def _record(settings: MatchSettings) -> np.ndarray:
    return settings.as_record()
