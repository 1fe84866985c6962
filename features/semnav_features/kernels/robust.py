"""Fits every line a second time, with less weight on points that do not belong to it."""

from __future__ import annotations

import math
from typing import Any

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.layout import ROUND
from semnav_features.kernels.lines import fit, offset

BIWEIGHT_DEVIATIONS = 4.685
"""Tukey's constant: points farther off than this many standard deviations do not count. Where no
point is wrong the estimate is 95 percent as efficient as least squares."""

VARIANCE_FACTOR = 1.271
"""Factor from weighted squared residuals to the variance of the line.

Weighted residuals are smaller than plain ones, and the fit is a little less efficient: the factor
is E[psi^2] / E[psi']^2 over E[w r^2] / E[w] for normally distributed r."""

REWEIGHTINGS = 2
"""How often the weights are computed anew."""


@kernel
def refit_robustly(count: int, settings: Any, scratch: Any) -> None:
    """Fit the pieces that could be walls once more, each point weighted by how near it is.

    Iteratively reweighted total least squares with Tukey's biweight, begun at the plain fit.
    Mouldings, frames and points between two surfaces pull at a line though they are near enough
    to it for the end-point fit.
    """
    for k in range(count):
        piece = scratch.pieces[k]
        if piece.points >= settings.wall_beams and not piece.flags & ROUND:
            for _ in range(REWEIGHTINGS):
                reweight(scratch.xs, scratch.ys, settings, piece)


@kernel
def reweight(xs: FloatArray, ys: FloatArray, settings: Any, piece: Any) -> None:
    """One step: weighted moments of all points from the first to the last, and their line.

    The deviation of a point is that of the residuals, but no more than that of a range: wrong
    points make it larger, and a grazing wall smaller. `points` is then how many points count.
    """
    deviation = min(settings.sigma, math.sqrt(piece.scatter / piece.points))
    farthest = BIWEIGHT_DEVIATIONS * max(deviation, 1e-3 * settings.split_distance)
    x0, y0 = piece.mean_x, piece.mean_y
    points, total = 0, 0.0
    sx = sy = sxx = sxy = syy = 0.0
    for i in range(piece.first, piece.last + 1):
        share = offset(piece, xs[i], ys[i]) / farthest
        weight = max(1.0 - share * share, 0.0) ** 2
        dx, dy = xs[i] - x0, ys[i] - y0
        points += weight > 0.0
        total += weight
        sx += weight * dx
        sy += weight * dy
        sxx += weight * dx * dx
        sxy += weight * dx * dy
        syy += weight * dy * dy
    if points < settings.wall_beams:
        return
    piece.points = points
    scale = points / total
    piece.mean_x, piece.mean_y = x0 + sx / total, y0 + sy / total
    piece.xx = scale * (sxx - sx * sx / total)
    piece.xy = scale * (sxy - sx * sy / total)
    piece.yy = scale * (syy - sy * sy / total)
    fit(xs, ys, piece)
    piece.scatter *= VARIANCE_FACTOR
