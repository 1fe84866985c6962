"""Cuts a group of points at its corners by the curvature function with adaptive arms."""

from __future__ import annotations

import math
from typing import Any

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.lines import split_further

MIN_TURN = math.radians(20.0)
"""Least angle by which the arms turn at a corner, radians."""

MIN_TURN_DEVIATIONS = 3.0
"""Least angle by which they turn, in standard deviations of that angle."""

NEXT_STEP, PREVIOUS_STEP, ARM_AHEAD, ARM_BEHIND, CURVATURE, MIN_CURVATURE = range(6)
"""Columns of the table: the points one step on and one step back, the ends of the two arms, the
curvature, and that of the least turn which counts."""


@kernel
def cut_where_it_turns(
    xs: FloatArray, ys: FloatArray, first: int, last: int, settings: Any, scratch: Any
) -> int:
    """Cut points first to last where the curvature function peaks, then curves into chords.

    After P. Nunez, R. Vazquez-Martin, J. C. del Toro, A. Bandera, F. Sandoval (ICRA 2006). Two
    arms reach from every point i to points i + f and i - b, as far as the contour stays close to
    its chord:

        l(i, i + f) - d(i, i + f) <= U,

    with the length l of the contour and d of the chord; U is `split_distance`. So an arm is long
    on a wall and ends soon after a corner. The curvature is one plus the cosine of the angle
    between the arms: 0 on a line, 1 at a square corner. Where it is large, its peak is a corner.

    They measure the contour from beam to beam. With 2 cm of noise on beams 1 cm apart that would
    be three times its length, so here it is measured in steps of U or more. They call a stretch
    with neither a peak nor a curvature near zero a curve; here it is cut into chords by the
    end-point fit, as what follows finds arcs among these.

    Returns:
        How many indices were written to `scratch.vertices`; see `cuts.cut`.
    """
    table, limit = scratch.table, settings.split_distance
    for i in range(first, last + 1):
        table[i - first, NEXT_STEP] = step_from(xs, ys, i, last, 1, limit)
        table[i - first, PREVIOUS_STEP] = step_from(xs, ys, i, first, -1, limit)
    for i in range(first, last + 1):
        table[i - first, ARM_AHEAD] = arm_from(xs, ys, first, i, NEXT_STEP, limit, table)
        table[i - first, ARM_BEHIND] = arm_from(xs, ys, first, i, PREVIOUS_STEP, limit, table)
    for i in range(first, last + 1):
        write_curvature(xs, ys, first, i, settings, table)
    corners = find_peaks(first, last, table, scratch.vertices)
    corners = drop_shoulders(first, corners, table, scratch.vertices)
    for k in range(corners):
        scratch.stack[corners - k] = scratch.vertices[k]
    scratch.stack[0] = last
    return int(split_further(xs, ys, first, corners + 1, limit, scratch.stack, scratch.vertices))


@kernel
def step_from(xs: FloatArray, ys: FloatArray, i: int, end: int, way: int, length: float) -> int:
    """The first point from i towards `end` that is `length` away, or `end` if none is."""
    k = i
    while k != end:
        k += way
        if math.hypot(xs[k] - xs[i], ys[k] - ys[i]) >= length:
            break
    return k


@kernel
def arm_from(
    xs: FloatArray, ys: FloatArray, first: int, i: int, column: int, slack: float, table: FloatArray
) -> int:
    """The last point in steps from i whose contour is longer than its chord by `slack` at most."""
    contour, at = 0.0, i
    while True:
        to = int(table[at - first, column])
        contour += math.hypot(xs[to] - xs[at], ys[to] - ys[at])
        if to == at or contour - math.hypot(xs[to] - xs[i], ys[to] - ys[i]) > slack:
            return at
        at = to


@kernel
def write_curvature(
    xs: FloatArray, ys: FloatArray, first: int, i: int, settings: Any, table: FloatArray
) -> None:
    """Write the curvature at point i and how much is needed there.

    With arms of lengths a and b and the deviation sigma of a point, the angle between them has
    the deviation sigma sqrt(1/a^2 + 1/b^2 + (1/a + 1/b)^2). An arm that is no step long, at the
    end of a group, says nothing.
    """
    ahead, behind = int(table[i - first, ARM_AHEAD]), int(table[i - first, ARM_BEHIND])
    ax, ay = xs[ahead] - xs[i], ys[ahead] - ys[i]
    bx, by = xs[behind] - xs[i], ys[behind] - ys[i]
    a, b = math.hypot(ax, ay), math.hypot(bx, by)
    table[i - first, CURVATURE], table[i - first, MIN_CURVATURE] = 0.0, 1.0
    if min(a, b) < settings.split_distance:
        return
    noise = math.sqrt(1.0 / (a * a) + 1.0 / (b * b) + (1.0 / a + 1.0 / b) ** 2)
    least = max(MIN_TURN, min(MIN_TURN_DEVIATIONS * settings.sigma * noise, math.pi))
    table[i - first, CURVATURE] = 1.0 + (ax * bx + ay * by) / (a * b)
    table[i - first, MIN_CURVATURE] = 1.0 - math.cos(least)


@kernel
def find_peaks(first: int, last: int, table: FloatArray, peaks: Any) -> int:
    """Write the sharpest of every run of points that turn enough; returns how many.

    A run ends where the curvature falls below half of what is needed, so noise makes no two of it.
    """
    count, inside = 0, False
    for i in range(first + 1, last):
        curvature, needed = table[i - first, CURVATURE], table[i - first, MIN_CURVATURE]
        if curvature < 0.5 * needed:
            inside = False
        elif not inside and curvature >= needed:
            inside = True
            peaks[count] = i
            count += 1
        elif inside and curvature > table[peaks[count - 1] - first, CURVATURE]:
            peaks[count - 1] = i
    return count


@kernel
def drop_shoulders(first: int, count: int, table: FloatArray, peaks: Any) -> int:
    """Drop peaks with a sharper one beside them within their arms; returns how many are left.

    An arm that reaches a little past a corner bends, though the contour does not.
    """
    kept, before = 0, -1
    for k in range(count):
        peak = peaks[k]
        after = peaks[k + 1] if k + 1 < count else -1
        curvature = table[peak - first, CURVATURE]
        is_shoulder = before >= table[peak - first, ARM_BEHIND] and before >= 0
        is_shoulder = is_shoulder and table[before - first, CURVATURE] > curvature
        if not is_shoulder and 0 <= after <= table[peak - first, ARM_AHEAD]:
            is_shoulder = table[after - first, CURVATURE] > curvature
        before = peak
        peaks[kept] = peak
        kept += not is_shoulder
    return kept
