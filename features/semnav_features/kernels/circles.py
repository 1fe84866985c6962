"""Circles through points that a scanner at the origin measured."""

from __future__ import annotations

import math
from typing import TypeAlias

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.normal_equations import solve_step

Ray: TypeAlias = tuple[float, float, float]
"""A ray that touches a circle: its unit normal towards the centre (x, y), and its weight.

The weight is the variance of a range over that of the distance at which the ray passes; a ray of
weight 0 says nothing."""

NO_RAY = (0.0, 0.0, 0.0)

NEWTON_STEPS = 8
"""Steps of Newton's method for the algebraic fit; after these it has converged to rounding."""

GAUSS_NEWTON_STEPS = 2
"""Steps of the geometric fit: the second still gains a tenth on thin columns, a third nothing."""

MIN_SQUARED_COSINE = 0.1
"""Added to the squared cosine of the incidence: no point is exact, however grazing its beam."""


@kernel
def algebraic_circle(
    xs: FloatArray, ys: FloatArray, first: int, last: int
) -> tuple[float, float, float]:
    """Taubin's fit (IEEE PAMI 13, 1991) to points first to last (inclusive).

    It minimises sum (d_i^2 - R^2)^2 / sum d_i^2 with d_i the distances from the centre. Plain
    least squares of the numerator (Kasa) takes short arcs for much smaller circles than they
    are; Taubin's bias is of the order of the geometric fit's.

    Returns:
        Centre and radius, metres; NaN or infinity for points on one line.
    """
    n = last - first + 1
    mean_x = mean_y = 0.0
    for i in range(first, last + 1):
        mean_x += xs[i]
        mean_y += ys[i]
    mean_x, mean_y = mean_x / n, mean_y / n
    xx = xy = yy = xz = yz = zz = 0.0
    for i in range(first, last + 1):
        x, y = xs[i] - mean_x, ys[i] - mean_y
        z = x * x + y * y
        xx += x * x
        xy += x * y
        yy += y * y
        xz += x * z
        yz += y * z
        zz += z * z
    xx, xy, yy, xz, yz, zz = xx / n, xy / n, yy / n, xz / n, yz / n, zz / n
    root = taubin_root(xx, xy, yy, xz, yz, zz)
    double = 2.0 * ((xx - root) * (yy - root) - xy * xy)
    x = (xz * (yy - root) - yz * xy) / double
    y = (yz * (xx - root) - xz * xy) / double
    return mean_x + x, mean_y + y, math.sqrt(x * x + y * y + xx + yy)


@kernel
def taubin_root(xx: float, xy: float, yy: float, xz: float, yz: float, zz: float) -> float:
    """Smallest root, from below, of the characteristic polynomial of Taubin's fit."""
    z = xx + yy
    determinant = xx * yy - xy * xy
    a3 = 4.0 * z
    a2 = -3.0 * z * z - zz
    a1 = (zz + 4.0 * determinant - z * z) * z - xz * xz - yz * yz
    a0 = xz * (xz * yy - yz * xy) + yz * (yz * xx - xz * xy) - (zz - z * z) * determinant
    root = 0.0
    for _ in range(NEWTON_STEPS):
        root -= (a0 + root * (a1 + root * (a2 + root * a3))) / (
            a1 + root * (2.0 * a2 + root * 3.0 * a3)
        )
    return root


@kernel
def refine_circle(
    xs: FloatArray,
    ys: FloatArray,
    first: int,
    last: int,
    circle: tuple[float, float, float],
    start: Ray,
    end: Ray,
) -> tuple[float, float, float]:
    """Gauss-Newton steps towards the circle with the least weighted squared distances.

    The error of a range lies along its beam, so across the circle it is smaller by the cosine
    of the incidence: a point at the edge of a column tells its width better than one in front.
    """
    for _ in range(GAUSS_NEWTON_STEPS):
        circle = gauss_newton(xs, ys, first, last, circle, start, end)
    return circle


@kernel
def gauss_newton(
    xs: FloatArray,
    ys: FloatArray,
    first: int,
    last: int,
    circle: tuple[float, float, float],
    start: Ray,
    end: Ray,
) -> tuple[float, float, float]:
    """One step; unknowns are the centre and the radius."""
    x, y, radius = circle
    xx = xy = yy = xr = yr = rr = bx = by = br = 0.0
    for i in range(first, last + 1):
        dx, dy = xs[i] - x, ys[i] - y
        size = math.sqrt(dx * dx + dy * dy)
        ux, uy = dx / size, dy / size
        along = ux * xs[i] + uy * ys[i]
        incidence = along * along / (xs[i] * xs[i] + ys[i] * ys[i])
        weight = 1.0 / (incidence + MIN_SQUARED_COSINE)
        wx, wy, error = weight * ux, weight * uy, size - radius
        xx += wx * ux
        xy += wx * uy
        yy += wy * uy
        xr += wx
        yr += wy
        rr += weight
        bx += wx * error
        by += wy * error
        br += weight * error
    for nx, ny, weight in (start, end):
        error = radius - nx * x - ny * y
        xx += weight * nx * nx
        xy += weight * nx * ny
        yy += weight * ny * ny
        xr -= weight * nx
        yr -= weight * ny
        rr += weight
        bx += weight * nx * error
        by += weight * ny * error
        br -= weight * error
    return solve_step((x, y, radius), (xx, xy, yy, xr, yr, rr), (bx, by, br))


@kernel
def circle_residuals(
    xs: FloatArray, ys: FloatArray, first: int, last: int, circle: tuple[float, float, float]
) -> tuple[float, int]:
    """Sum of squared distances of points first to last to a circle, and the farthest of them."""
    x, y, radius = circle
    total, largest, worst = 0.0, -1.0, first
    for i in range(first, last + 1):
        error = abs(math.hypot(xs[i] - x, ys[i] - y) - radius)
        total += error * error
        if error > largest:
            largest, worst = error, i
    return total, worst
