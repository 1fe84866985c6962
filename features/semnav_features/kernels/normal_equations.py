"""Solves normal equations of three unknowns."""

from __future__ import annotations

from semnav_features.kernels.compiling import kernel


@kernel
def solve_step(
    guess: tuple[float, float, float],
    normal: tuple[float, float, float, float, float, float],
    right: tuple[float, float, float],
) -> tuple[float, float, float]:
    """The guess plus the solution of its normal equations, by Cramer's rule.

    Args:
        guess: three unknowns x, y, r.
        normal: the matrix, as its entries xx, xy, yy, xr, yr and rr.
        right: the right-hand side.
    """
    xx, xy, yy, xr, yr, rr = normal
    bx, by, br = right
    a, b, c = yy * rr - yr * yr, xr * yr - xy * rr, xy * yr - xr * yy
    d, e, f = xx * rr - xr * xr, xr * xy - xx * yr, xx * yy - xy * xy
    determinant = xx * a + xy * b + xr * c
    return (
        guess[0] + (a * bx + b * by + c * br) / determinant,
        guess[1] + (b * bx + d * by + e * br) / determinant,
        guess[2] + (c * bx + e * by + f * br) / determinant,
    )
