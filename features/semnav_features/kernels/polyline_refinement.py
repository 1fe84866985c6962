"""The best places for the vertices of polylines: squared range residuals made least.

The problem is the second step of Schaefer et al. (IROS 2018, section III.C): inner vertices move
freely, the first and the last vertex of a polyline along their beams. They search without
derivatives; here each vertex in turn takes Gauss-Newton steps, which lead to the same kind of
minimum in a thousandth of the time.
"""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

Vector: TypeAlias = tuple[float, float]

System: TypeAlias = tuple[float, float, float, float, float]
"""Normal equations of one vertex: matrix xx, xy, yy and gradient x, y."""

GAUSS_NEWTON_STEPS, STEP_HALVINGS, MAX_SWEEPS = 4, 6, 100
"""Steps of one vertex, halvings of a step that does not improve, and sweeps over all vertices."""

DAMPING, MIN_DIAGONAL = 1e-3, 1e-9
"""Added to the diagonal of the normal equations, as a share of it and absolutely, so that they can
always be solved."""

MIN_SWEEP_GAIN = 1e-5
"""A sweep over all vertices that gains less is the last, square metres."""


@kernel
def refine_vertices(
    directions: FloatArray,
    ranges: FloatArray,
    chosen: NDArray[np.int64],
    starts: NDArray[np.bool_],
) -> FloatArray:
    """Move the vertices of polylines to where the squared range residuals are least.

    Args:
        directions: cosine and sine of the beam of every point, shape (n, 2), counter-clockwise.
        ranges: metres, shape (n,).
        chosen: the points at which the vertices are to begin with, in beam order, shape (m,).
        starts: which of them start a polyline, shape (m,).

    Returns:
        The vertices, shape (m, 2).
    """
    count = len(chosen)
    vertices = np.empty((count, 2))
    border = np.empty(count, np.int64)
    for k in range(count):
        for axis in range(2):
            vertices[k, axis] = ranges[chosen[k]] * directions[chosen[k], axis]
        last = k + 1 == count or starts[k + 1]
        border[k] = chosen[k] + 1 if last else chosen[k]
    for _ in range(MAX_SWEEPS):
        gain = 0.0
        for k in range(count):
            gain += move_vertex(directions, ranges, vertices, border, starts, chosen[k], k)
        if gain < MIN_SWEEP_GAIN:
            break
    return vertices


@kernel
def move_vertex(
    directions: FloatArray,
    ranges: FloatArray,
    vertices: FloatArray,
    border: NDArray[np.int64],
    starts: NDArray[np.bool_],
    beam: int,
    k: int,
) -> float:
    """Gauss-Newton steps of one vertex; returns by how much the squared residuals fell.

    `border[k]` is the first point after vertex k; it moves with the vertex.
    """
    left = not starts[k]
    right = k + 1 < len(starts) and not starts[k + 1]
    low = border[k - 1] if left else border[k]
    high = border[k + 1] if right else border[k]
    before = (vertices[k - 1, 0], vertices[k - 1, 1]) if left else (0.0, 0.0)
    after = (vertices[k + 1, 0], vertices[k + 1, 1]) if right else (0.0, 0.0)
    ray = (directions[beam, 0], directions[beam, 1])
    at, middle = (vertices[k, 0], vertices[k, 1]), border[k]
    cost = start = two_sided_cost(directions, ranges, low, middle, high, before, at, after)
    for _ in range(GAUSS_NEWTON_STEPS):
        system = normal_equations(directions, ranges, low, middle, high, before, at, after)
        step_x, step_y = free_step(system) if left and right else step_along(system, ray)
        moved = False
        for _ in range(STEP_HALVINGS):
            to = (at[0] + step_x, at[1] + step_y)
            if is_in_order(before, to, after, ray, left, right):
                new = first_after(directions, low, high, to) if left and right else border[k]
                least = two_sided_cost(directions, ranges, low, new, high, before, to, after)
                if least < cost:
                    at, middle, cost, moved = to, new, least, True
                    break
            step_x, step_y = 0.5 * step_x, 0.5 * step_y
        if not moved:
            break
    vertices[k, 0], vertices[k, 1], border[k] = at[0], at[1], middle
    return start - cost


@kernel
def is_in_order(
    before: Vector, at: Vector, after: Vector, ray: Vector, left: bool, right: bool
) -> bool:
    """Whether a vertex is in front of the scanner and between its neighbours, as they turn."""
    return bool(
        at[0] * ray[0] + at[1] * ray[1] > 0.0
        and (not left or before[0] * at[1] - before[1] * at[0] > 0.0)
        and (not right or at[0] * after[1] - at[1] * after[0] > 0.0)
    )


@kernel
def first_after(directions: FloatArray, low: int, high: int, vertex: Vector) -> int:
    """The first of the points low to high that does not lie clockwise of the vertex."""
    while low < high and directions[low, 1] * vertex[0] < directions[low, 0] * vertex[1]:
        low += 1
    return low


@kernel
def two_sided_cost(
    directions: FloatArray,
    ranges: FloatArray,
    low: int,
    middle: int,
    high: int,
    before: Vector,
    at: Vector,
    after: Vector,
) -> float:
    """Squared residuals of the lines on both sides of a vertex."""
    cost = line_cost(directions, ranges, low, middle, before, at)
    return float(cost + line_cost(directions, ranges, middle, high, at, after))


@kernel
def line_cost(
    directions: FloatArray, ranges: FloatArray, low: int, high: int, a: Vector, b: Vector
) -> float:
    """Squared residuals of points low to high (exclusive) against the line through a and b."""
    along_x, along_y, area = b[0] - a[0], b[1] - a[1], a[0] * b[1] - a[1] * b[0]
    total = 0.0
    for i in range(low, high):
        slope = directions[i, 0] * along_y - directions[i, 1] * along_x
        if not (area > 0.0 and slope > 0.0):
            return math.inf
        total += (area / slope - ranges[i]) ** 2
    return total


@kernel
def normal_equations(
    directions: FloatArray,
    ranges: FloatArray,
    low: int,
    middle: int,
    high: int,
    before: Vector,
    at: Vector,
    after: Vector,
) -> System:
    """The matrix xx, xy, yy and the gradient x, y of a vertex, from the lines on both sides."""
    left = one_sided_equations(directions, ranges, low, middle, before, at, 1.0)
    right = one_sided_equations(directions, ranges, middle, high, after, at, -1.0)
    return (
        left[0] + right[0],
        left[1] + right[1],
        left[2] + right[2],
        left[3] + right[3],
        left[4] + right[4],
    )


@kernel
def one_sided_equations(
    directions: FloatArray,
    ranges: FloatArray,
    low: int,
    high: int,
    fixed: Vector,
    moving: Vector,
    sense: float,
) -> System:
    """What the points of one line say about the vertex at its moving end.

    With the range N / D = a x m / d x (m - a) of a beam d, where a is fixed and m moves,
    dN/dm = (-a_y, a_x) and dD/dm = (-d_y, d_x).
    """
    along_x, along_y = sense * (moving[0] - fixed[0]), sense * (moving[1] - fixed[1])
    area = sense * (fixed[0] * moving[1] - fixed[1] * moving[0])
    xx = xy = yy = gradient_x = gradient_y = 0.0
    for i in range(low, high):
        x, y = directions[i, 0], directions[i, 1]
        slope = x * along_y - y * along_x
        distance = area / slope
        jacobian_x = sense * (distance * y - fixed[1]) / slope
        jacobian_y = sense * (fixed[0] - distance * x) / slope
        residual = distance - ranges[i]
        xx += jacobian_x * jacobian_x
        xy += jacobian_x * jacobian_y
        yy += jacobian_y * jacobian_y
        gradient_x += jacobian_x * residual
        gradient_y += jacobian_y * residual
    return xx, xy, yy, gradient_x, gradient_y


@kernel
def free_step(system: System) -> Vector:
    """The damped Gauss-Newton step of a vertex that may move anywhere."""
    xx, xy, yy, x, y = system
    xx, yy = xx * (1.0 + DAMPING) + MIN_DIAGONAL, yy * (1.0 + DAMPING) + MIN_DIAGONAL
    determinant = xx * yy - xy * xy
    return (xy * y - yy * x) / determinant, (xy * x - xx * y) / determinant


@kernel
def step_along(system: System, ray: Vector) -> Vector:
    """The same for a vertex that may only move along its beam."""
    xx, xy, yy, x, y = system
    curvature = xx * ray[0] ** 2 + 2.0 * xy * ray[0] * ray[1] + yy * ray[1] ** 2
    length = -(x * ray[0] + y * ray[1]) / (curvature * (1.0 + DAMPING) + MIN_DIAGONAL)
    return length * ray[0], length * ray[1]
