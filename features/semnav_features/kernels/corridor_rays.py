"""Probes a corridor by rays across its axis and by lanes along it.

In the frame of the axis x runs along the corridor and y to its left; the robot is at x = 0. A lane
is a line along the axis; a way is as many lanes beside each other as a body is wide.
"""

from __future__ import annotations

import math

import numpy as np

from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.rows import put_row
from semnav_features.kernels.selection import finite_values, value_of_rank

PROBE_SPACING = 0.1
"""Distance between the probes of the sides along the axis, metres."""

PROBED_BEHIND = 2.0
"""How far behind the robot the sides are probed, metres."""

WIDTH_RANGE = 8.0
"""The typical width of a corridor is taken from probes up to this far ahead, metres."""

MAX_SIDE_DISTANCE = 6.0
"""What a ray meets farther off than this is no side of the corridor, metres."""

BODY_WIDTH = 0.7
"""A corridor ends where no way of this width goes on, metres."""

MAX_FURNITURE_DEPTH = 1.5
"""Greatest depth of furniture that stands before a side, metres."""

DOORWAY_DEPTH = 0.5
"""Distance from a door across the way within which a robot stands in the doorway, metres."""

MIN_WALL_DISTANCE = 0.1
"""A wall nearer than this is the one in whose doorway the robot stands and not one ahead of it,
metres."""

LANE_SPACING = 0.1
"""Distance between the lanes, which are lines along the axis, metres."""

SCREENING_MARGIN = 0.1
"""A segment that lies farther than this beside all rays or lanes is left out at once, metres; those
nearer are looked at closely, so that rounding decides nothing here."""

MAX_WAY_OFFSET = 0.85
"""Farthest beside the robot that a way may begin and still count as ahead of it, metres."""

MIN_END_SINE = math.sin(math.radians(15.0))
"""Sine of the least angle to the axis of a wall that ends the corridor; flatter ones run along
it."""


@kernel
def in_frame(segments: FloatArray, x: float, y: float, heading: float) -> FloatArray:
    """Segments, shape (n, 4), seen from an axis that begins at (x, y)."""
    c, s = math.cos(heading), math.sin(heading)
    local = np.empty_like(segments)
    for i in range(len(segments)):
        for k in (0, 2):
            dx, dy = segments[i, k] - x, segments[i, k + 1] - y
            local[i, k], local[i, k + 1] = c * dx + s * dy, c * dy - s * dx
    return local


@kernel
def probe(local: FloatArray, sign: float, back: float, count: int) -> FloatArray:
    """How far the first `count` rays go to one side, metres; inf beyond `MAX_SIDE_DISTANCE`.

    Args:
        local: segments in the frame of the axis, shape (n, 4).
        sign: 1 for the left side, -1 for the right.
        back: how far the corridor goes back, metres; no ray starts behind that.
        count: of rays; ray k starts at x = k * `PROBE_SPACING` - `PROBED_BEHIND`.
    """
    side = np.full(count, np.inf)
    start = max(0, math.ceil((PROBED_BEHIND - back) / PROBE_SPACING))
    farthest = count * PROBE_SPACING - PROBED_BEHIND
    for i in range(len(local)):
        x1, y1, x2, y2 = local[i, 0], sign * local[i, 1], local[i, 2], sign * local[i, 3]
        if (
            max(y1, y2) < 0.0
            or min(y1, y2) > MAX_SIDE_DISTANCE + SCREENING_MARGIN
            or abs(x2 - x1) < 1e-9
        ):
            continue
        if (
            max(x1, x2) < -PROBED_BEHIND - SCREENING_MARGIN
            or min(x1, x2) > farthest + SCREENING_MARGIN
        ):
            continue
        slope = (y2 - y1) / (x2 - x1)
        first = math.ceil((min(x1, x2) + PROBED_BEHIND) / PROBE_SPACING)
        last = math.floor((max(x1, x2) + PROBED_BEHIND) / PROBE_SPACING)
        for k in range(max(first, start), min(last, count - 1) + 1):
            distance = y1 + slope * (k * PROBE_SPACING - PROBED_BEHIND - x1)
            if 0.0 <= distance < side[k] and distance <= MAX_SIDE_DISTANCE:
                side[k] = distance
    return side


@kernel
def shift(local: FloatArray, offset: float) -> None:
    """Move the axis to its left."""
    for i in range(len(local)):
        local[i, 1] -= offset
        local[i, 3] -= offset


@kernel
def typical_distances(local: FloatArray, back: float, straight: float) -> tuple[float, float]:
    """Typical distances of the left and the right side from the axis, metres.

    Args:
        local: segments in the frame of the axis, which lies on a way ahead.
        back: how far it goes back, metres.
        straight: how far it goes on, metres.
    """
    middle = round(MAX_SIDE_DISTANCE / LANE_SPACING)
    lanes = _lanes(local, -middle * LANE_SPACING, 2 * middle + 1, DOORWAY_DEPTH)
    count = int((min(straight, WIDTH_RANGE) + PROBED_BEHIND) / PROBE_SPACING) + 1
    left = _usual(probe(local, 1.0, back, count), _room(lanes[middle:], straight))
    right = _usual(probe(local, -1.0, back, count), _room(lanes[middle::-1], straight))
    return left, right


@kernel
def _usual(side: FloatArray, room: float) -> float:
    """The typical distance of a side; `MAX_SIDE_DISTANCE` where none is seen.

    It is the lower tertile: up to a third of the probes may meet furniture, and up to two thirds
    the far walls of a junction. If the robot stands in the junction more of them do; so the
    distance is limited to little more than the `room` beside the axis in which ways go on.
    """
    seen = finite_values(side)
    usual = value_of_rank(seen, len(seen) // 3) if len(seen) > 0 else MAX_SIDE_DISTANCE
    return room if usual > room + MAX_FURNITURE_DEPTH else usual


@kernel
def _room(lanes: FloatArray, straight: float) -> float:
    """Width of the lanes, from the first one on, that go on about as far as `straight`, metres."""
    count = 0
    while count < len(lanes) and _goes_on(lanes[count], straight):
        count += 1
    return max(count - 0.5, 0.5 * BODY_WIDTH / LANE_SPACING) * LANE_SPACING


@kernel
def way_ahead(local: FloatArray) -> tuple[float, float]:
    """The nearest way for a body that goes on about as far as any way beside the robot.

    Returns:
        How far it lies to the left of the robot, and how far it goes on, metres.
    """
    ways = _ways(
        _lanes(
            local,
            -MAX_WAY_OFFSET,
            round(2.0 * MAX_WAY_OFFSET / LANE_SPACING) + 1,
            MIN_WALL_DISTANCE,
        )
    )
    farthest, middle = ways.max(), (len(ways) - 1) // 2
    for k in range(middle + 1):
        for way in (middle - k, middle + k):
            if _goes_on(ways[way], farthest):
                return (way - middle) * LANE_SPACING, ways[way]
    return 0.0, farthest


@kernel
def _goes_on(distance: float, farthest: float) -> bool:
    """Whether a distance is about as long as another; both may be infinite."""
    return distance == farthest or distance > farthest - 1.0


@kernel
def way_back(local: FloatArray) -> float:
    """How far any way for a body near the axis goes back, metres."""
    turned = np.empty_like(local)
    for i in range(len(local)):
        put_row(turned, i, (-local[i, 0], local[i, 1], -local[i, 2], local[i, 3]))
    return farthest_way(turned, BODY_WIDTH, BODY_WIDTH)


@kernel
def farthest_way(local: FloatArray, left: float, right: float) -> float:
    """The farthest that any way for a body goes on between the sides, metres."""
    ways = _ways(
        _lanes(
            local,
            LANE_SPACING - right,
            max(1, int((left + right) / LANE_SPACING) - 1),
            MIN_WALL_DISTANCE,
        )
    )
    return float(ways.max())


@kernel
def _ways(lanes: FloatArray) -> FloatArray:
    """How far each way goes on that is as wide as a body: several lanes beside each other."""
    width = min(len(lanes), round(BODY_WIDTH / LANE_SPACING))
    ways = np.empty(len(lanes) - width + 1)
    for k in range(len(ways)):
        ways[k] = lanes[k : k + width].min()
    return ways


@kernel
def _lanes(local: FloatArray, start: float, count: int, nearest: float) -> FloatArray:
    """How far each lane goes on from x = `nearest`; they lie at y = start + k * `LANE_SPACING`."""
    lanes = np.full(count, np.inf)
    for i in range(len(local)):
        x1, y1, x2, y2 = local[i, 0], local[i, 1], local[i, 2], local[i, 3]
        if (
            max(y1, y2) < start - SCREENING_MARGIN
            or min(y1, y2) > start + count * LANE_SPACING + SCREENING_MARGIN
        ):
            continue
        if max(x1, x2) < nearest or abs(y2 - y1) <= MIN_END_SINE * math.hypot(x2 - x1, y2 - y1):
            continue
        slope = (x2 - x1) / (y2 - y1)
        first = max(math.ceil((min(y1, y2) - start) / LANE_SPACING), 0)
        last = min(math.floor((max(y1, y2) - start) / LANE_SPACING), count - 1)
        for k in range(first, last + 1):
            x = x1 + slope * (start + k * LANE_SPACING - y1)
            if x >= nearest:
                lanes[k] = min(lanes[k], x)
    return lanes


@kernel
def first_gap(side: FloatArray, start: int, stop: int, longer_than: int) -> int:
    """Where more than `longer_than` infinite values in a row first begin; -1 if nowhere."""
    run = 0
    for k in range(max(start, 0), min(stop, len(side))):
        run = run + 1 if math.isinf(side[k]) else 0
        if run > longer_than:
            return k - run + 1
    return -1
