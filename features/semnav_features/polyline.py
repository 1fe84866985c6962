"""A scan as polylines with a given number of vertices."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.kernels.polyline_refinement import refine_vertices
from semnav_features.kernels.polyline_vertices import choose_vertices
from semnav_features.scan import Scan


def polylines(
    scan: Scan,
    vertices: int = 20,
    *,
    missed: float = 0.4,
    link: float = 1.0,
    refine: bool = True,
) -> tuple[FloatArray, ...]:
    r"""The polylines with a given number of vertices under which a scan is most likely.

    The likelihood is that of Schaefer, Buescher, Luft, Burgard, "A Maximum Likelihood Approach to
    Extract Polylines from 2-D Laser Range Scans" (IROS 2018): beams that meet a line have normal
    range errors, the others a constant probability. In place of their greedy removal of vertices
    the best points to start from are found by dynamic programming.

    .. math:: \sum_{\text{hit}} (r_i - \hat r_i)^2 + \sum_{\text{no hit}} \text{missed}^2

    Beams beyond one full turn are left out; in a full-circle scan no line crosses the first beam.
    Takes some milliseconds for 360 beams, and up to a second for a thousand in one smooth curve.

    Args:
        scan: a scan of a lidar.
        vertices: number of vertices of all polylines together; fewer only where more do not
            improve the fit.
        missed: residual that counts for a beam that meets no line, metres; a smaller one leaves
            more beams out.
        link: largest distance between neighbouring points that a line may join, metres; no line
            crosses a missing return.
        refine: move the vertices to the best places; otherwise they are points of the scan.

    Returns:
        Polylines in beam order, each with its vertices counter-clockwise as seen from the
        scanner, shape (m, 2), metres, lidar frame.

    Raises:
        ValueError: vertices, missed or link is out of its range.
    """
    _check(vertices, missed, link)
    beams_per_turn = 2.0 * math.pi / scan.angle_increment * (1.0 + 1e-9)
    beams = np.flatnonzero(scan.valid[: math.ceil(beams_per_turn)])
    if len(beams) < 2:
        return ()
    ranges, angles = scan.ranges[beams], scan.angles[beams]
    directions = np.stack((np.cos(angles), np.sin(angles)), axis=1)
    groups = _linked(beams, directions * ranges[:, None], link)
    chosen, starts = choose_vertices(directions, ranges, groups, min(vertices, len(beams)), missed)
    corners = directions[chosen] * ranges[chosen, None]
    if refine and len(chosen):
        corners = refine_vertices(directions, ranges, chosen, starts)
    return tuple(np.split(corners, np.flatnonzero(starts)[1:])) if len(chosen) else ()


def _linked(beams: NDArray[np.int64], points: FloatArray, link: float) -> NDArray[np.int64]:
    """First indices of groups of linked neighbours, and the number of points as the last entry."""
    distance = np.hypot(*np.diff(points, axis=0).T)
    broken = (np.diff(beams) > 1) | (distance > link)
    return np.concatenate(([0], np.flatnonzero(broken) + 1, [len(beams)])).astype(np.int64)


def _check(vertices: int, missed: float, link: float) -> None:
    if not 2 <= vertices <= 1000:
        raise ValueError(f"vertices is {vertices}; it must be from 2 to 1000")
    for name, value in (("missed", missed), ("link", link)):
        if not 0.0 < value < math.inf:
            raise ValueError(f"{name} is {value}; it must be positive and finite, in metres")
