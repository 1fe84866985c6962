"""Numba kernels that probe a corridor: by rays across its axis and by lanes along it.

In the frame of the axis x runs along the corridor and y to its left; the robot lies at x = 0.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from semnav_env.features.frames import FloatArray

SPACING = 0.1
"""Distance between the probes of the sides along the axis, metres."""

BEHIND = 2.0
"""How far behind the robot the sides are probed, metres."""

NEAR = 8.0
"""Where the corridor is as wide as usual: not farther ahead than this, metres."""

REACH = 6.0
"""A side farther than this is none, metres."""

BODY_WIDTH = 0.7
"""A corridor ends where no way of this width goes on, metres."""

FURNITURE = 1.5
"""What stands in the way of going on before a side is at most this deep, metres."""

DOORWAY = 0.5
"""Nearer than this to a door that lies across the way, one stands in the doorway, metres."""

SILL = 0.1
"""A wall nearer than this is the one in whose doorway one stands, not one ahead, metres."""

LANE = 0.1
"""Distance between the lanes, metres."""

ASIDE = 0.85
"""Ways that begin so far beside the robot still count as ahead of it, metres."""

ALONG = math.sin(math.radians(15.0))
"""A wall nearer to the axis in direction runs along the corridor and does not end it."""


@njit(cache=True)
def in_frame(segments: FloatArray, x: float, y: float, heading: float) -> FloatArray:
    """Segments, shape (n, 4), seen from an axis that begins at (x, y)."""
    c, s = math.cos(heading), math.sin(heading)
    local = np.empty_like(segments)
    for i in range(len(segments)):
        for k in (0, 2):
            dx, dy = segments[i, k] - x, segments[i, k + 1] - y
            local[i, k], local[i, k + 1] = c * dx + s * dy, c * dy - s * dx
    return local


@njit(cache=True)
def probe(local: FloatArray, sign: float, back: float, count: int) -> FloatArray:
    """How far the first `count` rays go to one side, at most `REACH`, metres; inf beyond.

    Args:
        local: segments in the frame of the axis, shape (n, 4).
        sign: 1 for the left side, -1 for the right.
        back: how far the corridor goes back, metres; no ray starts behind that.
        count: of rays; ray k starts at x = k * `SPACING` - `BEHIND`.
    """
    side = np.full(count, np.inf)
    start = max(0, math.ceil((BEHIND - back) / SPACING))
    for i in range(len(local)):
        x1, y1, x2, y2 = local[i, 0], sign * local[i, 1], local[i, 2], sign * local[i, 3]
        if max(y1, y2) < 0.0 or abs(x2 - x1) < 1e-9:
            continue
        slope = (y2 - y1) / (x2 - x1)
        first = math.ceil((min(x1, x2) + BEHIND) / SPACING)
        last = math.floor((max(x1, x2) + BEHIND) / SPACING)
        for k in range(max(first, start), min(last, count - 1) + 1):
            distance = y1 + slope * (k * SPACING - BEHIND - x1)
            if 0.0 <= distance < side[k] and distance <= REACH:
                side[k] = distance
    return side


@njit(cache=True)
def shift(local: FloatArray, offset: float) -> None:
    """Move the axis to its left."""
    local[:, 1] -= offset
    local[:, 3] -= offset


@njit(cache=True)
def usual_distances(local: FloatArray, back: float, straight: float) -> tuple[float, float]:
    """How far the left and the right side usually lie from the axis, metres.

    Args:
        local: segments in the frame of the axis, which lies on a way ahead.
        back: how far it goes back, metres.
        straight: how far it goes on, metres.
    """
    middle = round(REACH / LANE)
    lanes = _lanes(local, -middle * LANE, 2 * middle + 1, DOORWAY)
    count = int((min(straight, NEAR) + BEHIND) / SPACING) + 1
    left = _usual(probe(local, 1.0, back, count), _room(lanes[middle:], straight))
    right = _usual(probe(local, -1.0, back, count), _room(lanes[middle::-1], straight))
    return left, right


@njit(cache=True)
def _usual(side: FloatArray, room: float) -> float:
    """The usual distance of a side; `REACH` where none is seen.

    A third of the probes may meet furniture, and two thirds the depths of a junction. More of
    them do where a robot stands in the junction; so a side is not far beyond the `room` for
    going on, either.
    """
    seen = np.sort(side[np.isfinite(side)])
    usual = seen[len(seen) // 3] if len(seen) > 0 else REACH
    return room if usual > room + FURNITURE else usual


@njit(cache=True)
def _room(lanes: FloatArray, straight: float) -> float:
    """How far beside the first lane the others go on about as far as `straight`, metres."""
    count = 0
    while count < len(lanes) and _goes_on(lanes[count], straight):
        count += 1
    return max(count - 0.5, 0.5 * BODY_WIDTH / LANE) * LANE


@njit(cache=True)
def way_ahead(local: FloatArray) -> tuple[float, float]:
    """The nearest way for a body that goes on about as far as any near x = 0.

    Returns:
        How far it lies to the left of the robot, and how far it goes on, metres.
    """
    ways = _ways(_lanes(local, -ASIDE, round(2.0 * ASIDE / LANE) + 1, SILL))
    farthest, middle = ways.max(), (len(ways) - 1) // 2
    for k in range(middle + 1):
        for way in (middle - k, middle + k):
            if _goes_on(ways[way], farthest):
                return (way - middle) * LANE, ways[way]
    return 0.0, farthest


@njit(cache=True)
def _goes_on(distance: float, farthest: float) -> bool:
    """Whether a distance is about as long as another; both may be infinite."""
    return distance == farthest or distance > farthest - 1.0


@njit(cache=True)
def way_back(local: FloatArray) -> float:
    """How far any way for a body near the axis goes back, metres."""
    turned = local.copy()
    turned[:, 0] *= -1.0
    turned[:, 2] *= -1.0
    return farthest_way(turned, BODY_WIDTH, BODY_WIDTH)


@njit(cache=True)
def farthest_way(local: FloatArray, left: float, right: float) -> float:
    """The farthest that any way for a body goes on between the sides, metres."""
    ways = _ways(_lanes(local, LANE - right, max(1, int((left + right) / LANE) - 1), SILL))
    return float(ways.max())


@njit(cache=True)
def _ways(lanes: FloatArray) -> FloatArray:
    """How far each way goes on that is as wide as a body: several lanes beside each other."""
    width = min(len(lanes), round(BODY_WIDTH / LANE))
    ways = np.empty(len(lanes) - width + 1)
    for k in range(len(ways)):
        ways[k] = lanes[k : k + width].min()
    return ways


@njit(cache=True)
def _lanes(local: FloatArray, start: float, count: int, nearest: float) -> FloatArray:
    """How far each lane goes on from x = `nearest`; they lie at y = start + k * `LANE`."""
    lanes = np.full(count, np.inf)
    for i in range(len(local)):
        x1, y1, x2, y2 = local[i, 0], local[i, 1], local[i, 2], local[i, 3]
        if max(x1, x2) < nearest or abs(y2 - y1) <= ALONG * math.hypot(x2 - x1, y2 - y1):
            continue
        slope = (x2 - x1) / (y2 - y1)
        first = max(math.ceil((min(y1, y2) - start) / LANE), 0)
        last = min(math.floor((max(y1, y2) - start) / LANE), count - 1)
        for k in range(first, last + 1):
            x = x1 + slope * (start + k * LANE - y1)
            if x >= nearest:
                lanes[k] = min(lanes[k], x)
    return lanes
