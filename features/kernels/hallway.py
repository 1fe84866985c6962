"""Numba kernels that look along the sides of a hallway."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from semnav_env.features.frames import FloatArray


@njit(cache=True)
def dominant_heading(walls: FloatArray, x: float, y: float, heading: float) -> float:
    """The direction that most metres of wall run along, within 45 degrees of `heading`.

    Args:
        walls: shape (n, 4), metres; those farther than 8 m from (x, y) do not count.
        x: where to look from, metres.
        y: the same.
        heading: radians.

    Returns:
        Radians; `heading` itself where no wall runs along it.
    """
    bins = 45
    weight = np.zeros(bins)
    offset = np.zeros(len(walls))
    length = np.zeros(len(walls))
    for i in range(len(walls)):
        dx, dy = walls[i, 2] - walls[i, 0], walls[i, 3] - walls[i, 1]
        length[i] = math.hypot(dx, dy)
        along = ((x - walls[i, 0]) * dx + (y - walls[i, 1]) * dy) / max(length[i] ** 2, 1e-9)
        along = min(max(along, 0.0), 1.0)
        if math.hypot(walls[i, 0] + along * dx - x, walls[i, 1] + along * dy - y) > 8.0:
            length[i] = 0.0
        turn = math.atan2(dy, dx) - heading
        offset[i] = turn - math.pi * math.floor(turn / math.pi + 0.5)
        k = int((offset[i] / (math.pi / 2) + 0.5) * bins)
        if 0 <= k < bins:
            weight[k] += length[i]
    best, most = -1, 0.0
    for k in range(bins):
        near = weight[k] + (weight[k - 1] if k > 0 else 0.0)
        near += weight[k + 1] if k + 1 < bins else 0.0
        if near > most:
            best, most = k, near
    if best < 0:
        return heading
    centre = ((best + 0.5) / bins - 0.5) * (math.pi / 2)
    total, mean = 0.0, 0.0
    for i in range(len(walls)):
        if abs(offset[i] - centre) < math.radians(5.0):
            total += length[i]
            mean += length[i] * offset[i]
    return heading + (mean / total if total > 0.0 else 0.0)


@njit(cache=True)
def probe(
    segments: FloatArray, start: float, spacing: float, count: int
) -> tuple[FloatArray, FloatArray]:
    """How far rays across the x axis go to the left (+y) and to the right (-y).

    Args:
        segments: shape (n, 4) in the frame of the axis, metres.
        start: x of the first ray.
        spacing: between rays.
        count: number of rays.

    Returns:
        Two arrays of shape (count,), metres, infinite where a ray meets nothing.
    """
    left = np.full(count, np.inf)
    right = np.full(count, np.inf)
    for i in range(len(segments)):
        x1, y1, x2, y2 = segments[i, 0], segments[i, 1], segments[i, 2], segments[i, 3]
        if x2 < x1:
            x1, y1, x2, y2 = x2, y2, x1, y1
        first = max(0, math.ceil((x1 - start) / spacing))
        last = min(count - 1, math.floor((x2 - start) / spacing))
        if x2 - x1 < 1e-9:
            continue
        slope = (y2 - y1) / (x2 - x1)
        for k in range(first, last + 1):
            y = y1 + slope * (start + k * spacing - x1)
            if y >= 0.0:
                left[k] = min(left[k], y)
            else:
                right[k] = min(right[k], -y)
    return left, right


@njit(cache=True)
def stepped_back(side: FloatArray, step: float, usual: float) -> list[tuple[int, int, float]]:
    """The runs of probes where a side lies more than `step` behind where it was before.

    Args:
        side: distance of the side at each probe, inf where nothing is seen, shape (n,).
        step: metres.
        usual: where the side is before the first probe, metres.

    Returns:
        For each run its first probe, the first probe after it, and the side's distance before it.
    """
    runs = [(0, 0, 0.0) for _ in range(0)]
    reference, first = usual, -1
    for i in range(len(side)):
        if side[i] > reference + step:
            if first < 0:
                first = i
            continue
        if first >= 0:
            runs.append((first, i, reference))
            first = -1
        reference = max(side[i], usual)  # furniture and end walls stand before the side
    return runs


@njit(cache=True)
def leads_out(walls: FloatArray, edge: float, offset: float) -> bool:
    """Whether a wall leads away from the axis at the edge of an opening.

    Args:
        walls: shape (n, 4) in the frame of the axis, the opening at positive y, metres.
        edge: x of the opening's edge.
        offset: y of the side.
    """
    for i in range(len(walls)):
        x1, y1, x2, y2 = walls[i, 0], walls[i, 1], walls[i, 2], walls[i, 3]
        if y2 < y1:
            x1, y1, x2, y2 = x2, y2, x1, y1
        steep = y2 - y1 > abs(x2 - x1)
        if steep and y1 < offset + 0.6 and y2 > offset + 0.8 and abs(x1 - edge) < 0.4:
            return True
    return False
