"""The two perpendicular directions along which most of a building's walls run."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np
import shapely

from semnav_features.frames import FloatArray

PIECE_TOLERANCE = 2.0
"""Distance within which a straight piece of an outline lies from the line between its ends,
pixels."""

LEAST_PIECE_LENGTH = 5.0
"""Length of the shortest piece that counts, pixels; a shorter one has no certain direction."""

BIN_WIDTH = math.radians(0.5)
"""Width of a bin of the histogram of directions, radians."""

MEAN_WINDOWS = (math.radians(2.0), math.radians(1.0))
"""Largest angles of a piece from the histogram's peak, and then from the first mean, at which it
counts for the mean direction, radians."""

QUARTER_TURN = math.pi / 2
"""A right angle, radians."""


def dominant_direction(rings: Sequence[FloatArray]) -> float:
    """The direction of most walls and of the walls at right angles to them.

    Every straight piece of the outlines votes for its direction modulo 90 degrees, with the square
    of its length: the mean of directions is best with the inverse of their variances as weights,
    and a piece's direction is known to about a pixel on its length. The mean is taken around the
    peak of the histogram, so that neither furniture nor oblique walls pull it.

    Args:
        rings: closed outlines, in pixels, shape (k, 2) each.

    Returns:
        Radians from -45 to 45 degrees; exactly 0 if no piece is long enough, or if it differs from
        that by less than the pieces do from each other, or by less than a pixel along the longest.
    """
    pieces = [piece for ring in rings for piece in _pieces(ring)]
    if not pieces:
        return 0.0
    steps = np.array(pieces)
    lengths = np.linalg.norm(steps, axis=1)
    turns = np.arctan2(steps[:, 1], steps[:, 0]) % QUARTER_TURN
    peak = _peak(turns, lengths**2)
    mean = square = 0.0
    for near in MEAN_WINDOWS:
        away = _wrapped(turns - peak)
        weights = np.where(np.abs(away) <= near, lengths**2, 0.0)
        total = max(float(weights.sum()), 1e-9)
        mean, square = (float(away**power @ weights) / total for power in (1, 2))
        peak += mean
    direction = float(_wrapped(np.array(peak)))
    along_axes = direction**2 <= square - mean**2
    return 0.0 if along_axes or abs(math.sin(direction)) * lengths.max() < 1.0 else direction


def _pieces(ring: FloatArray) -> Iterator[FloatArray]:
    """The straight pieces of an outline as vectors, pixels."""
    if np.ptp(ring, axis=0).max() < LEAST_PIECE_LENGTH:
        return
    ends = shapely.get_coordinates(
        shapely.simplify(shapely.linearrings(ring), PIECE_TOLERANCE)
    ).tolist()
    corners = ring[:-1]
    number = {(x, y): k for k, (x, y) in enumerate(corners.tolist())}
    for (x1, y1), (x2, y2) in pairwise(ends):
        if math.dist((x1, y1), (x2, y2)) < LEAST_PIECE_LENGTH:
            continue
        first, last = number[x1, y1], number[x2, y2]
        between = (last - first) % len(corners)
        points = corners[(first + np.arange(between + 1)) % len(corners)]
        yield math.dist((x1, y1), (x2, y2)) * _line_through(points)


def _line_through(points: FloatArray) -> FloatArray:
    """The unit vector along the line nearest to a stretch of an outline, least squares."""
    spread, weights = spread_out(points)
    away = spread - weights @ spread / weights.sum()
    return np.asarray(np.linalg.svd(np.sqrt(weights)[:, None] * away)[2][0])


def spread_out(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Points along a polyline and their weights, for sums in place of integrals over its length.

    Simpson's rule on each segment, exact for polynomials up to degree three.

    Args:
        points: vertices of the polyline, shape (n, 2).

    Returns:
        Shape (2 n - 1, 2) and (2 n - 1,).
    """
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    middles = (points[1:] + points[:-1]) / 2.0
    ends = (np.append(lengths, 0.0) + np.append(0.0, lengths)) / 6.0
    return np.concatenate((points, middles)), np.append(ends, 4.0 / 6.0 * lengths)


def _peak(turns: FloatArray, weights: FloatArray) -> float:
    """The middle of the two neighbouring bins that hold most."""
    bins = round(QUARTER_TURN / BIN_WIDTH)
    votes = np.bincount((turns / BIN_WIDTH).astype(np.intp) % bins, weights, bins)
    return BIN_WIDTH * (1.0 + float(np.argmax(votes + np.roll(votes, -1))))


def _wrapped(turns: FloatArray) -> FloatArray:
    """The same directions modulo 90 degrees, from -45 to 45 degrees."""
    return np.asarray((turns + QUARTER_TURN / 2) % QUARTER_TURN - QUARTER_TURN / 2)
