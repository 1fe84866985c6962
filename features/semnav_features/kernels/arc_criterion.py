"""Tells whether an arc explains points better than straight lines do."""

from __future__ import annotations

import math
from typing import Any

from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.lines import offset

RESIDUAL_FLOOR = 0.1
"""Residuals below this share of sigma do not make a fit better: it keeps the logarithm finite."""


@kernel
def straight_scatter(start: int, end: int, first: int, last: int, scratch: Any) -> float:
    """Sum of squared distances of points first to last from the nearer of the pieces beside them.

    Points of a piece count by its own scatter; `done` is the first point that does not count yet.
    """
    xs, ys, pieces = scratch.xs, scratch.ys, scratch.pieces
    total, done = 0.0, first
    for k in range(start, end + 2):
        before, after = pieces[max(k - 1, start)], pieces[min(k, end)]
        for i in range(done, after.first if k <= end else last + 1):
            a, b = offset(before, xs[i], ys[i]), offset(after, xs[i], ys[i])
            total += min(a * a, b * b)
        if k <= end:
            total += after.scatter
            done = after.last + 1
    return total


@kernel
def is_arc(arc: Any, straight: float, lines: int, settings: Any) -> bool:
    """Whether an arc is round enough, and explains its points better than straight lines do.

    The better model has the lower n ln(S / n) + k ln(n) (Schwarz's criterion), where S is the sum
    of squared residuals of n points and k the number of parameters: three for an arc, two for each
    line and one for each cut between lines. This needs no knowledge of the noise. A scanner
    outside a circle sees at most half of it.
    """
    n, span, finest = arc.points, extent(arc), (RESIDUAL_FLOOR * settings.sigma) ** 2
    within = math.hypot(arc.centre_x, arc.centre_y) < arc.radius
    gain = n * math.log((straight / n + finest) / (arc.residual * arc.residual + finest))
    return bool(
        (arc.points >= settings.arc_beams)
        & (arc.radius >= settings.arc_radius_min)
        & (arc.radius <= settings.arc_radius_max)
        & (arc.residual <= settings.arc_residual)
        & (span >= settings.arc_extent_min)
        & (within | (span <= math.pi))
        & (arc.radius * (1.0 - math.cos(0.5 * span)) >= settings.arc_sagitta_min)
        & (gain + (3.0 * lines - 1.0 - 3.0) * math.log(n) > 0.0)
    )


@kernel
def extent(arc: Any) -> float:
    """Angle that an arc spans about its centre, radians; see `elements.Arc.extent`."""
    ax, ay = arc.start_x - arc.centre_x, arc.start_y - arc.centre_y
    bx, by = arc.end_x - arc.centre_x, arc.end_y - arc.centre_y
    heading_change = math.atan2(ax * by - ay * bx, ax * bx + ay * by)
    heading_change = -heading_change if arc.convex else heading_change
    return heading_change if heading_change >= 0.0 else heading_change + 2.0 * math.pi
