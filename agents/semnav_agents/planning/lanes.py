"""Straight lanes through narrow places.

A search over sampled states seldom finds a gap that leaves a few centimetres. Where the coarse way
to the target is narrow, the widest straight strips through that place are therefore measured from
the obstacle points. Poses in the middle of a strip become anchors, to which the search may connect
exactly.

A lane is a row (x, y, heading, width): a point in its middle, metres, its direction, radians, and
the width that is free, metres.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from semnav_agents.planning.collision import CELL_DIAGONAL, Footprint, ObstacleField, is_clear
from semnav_agents.planning.heuristic import COARSE_CELL
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

X, Y, HEADING, WIDTH = range(4)
"""Columns of a lane."""

LANE_HEADINGS = 48
"""Directions in which lanes are measured, evenly over half a turn."""

HALF_LANE_LENGTH = 0.85
"""Distance before and behind a gap over which a lane is measured, metres."""

MAX_HALF_WIDTH = 1.0
"""Distance to either side within which obstacles limit a lane, metres."""

USEFUL_EXTRA_WIDTH = 0.5
"""Width beyond the body's above which a lane is no better than another, metres."""

LANES_PER_GAP = 3
"""Largest number of lanes that are kept for a gap."""

ANCHORS_PER_LANE, ANCHOR_DISTANCE = 9, 0.4
"""Anchors along a lane, the middle one in the gap, and their distance in metres."""


@kernel
def narrowest(room: FloatArray, way: NDArray[np.int64], limit: float) -> NDArray[np.int64]:
    """Indices of the cells of `way` whose room is below the limit and the least within 0.6 m."""
    around = int(0.6 / COARSE_CELL)
    gaps = []
    for k in range(len(way)):
        here = room[way[k, 0], way[k, 1]]
        if here >= limit:
            continue
        least = True
        for m in range(max(0, k - around), min(len(way), k + around + 1)):
            there = room[way[m, 0], way[m, 1]]
            if there < here or (there == here and m < k):
                least = False
        if least:
            gaps.append(k)
    return np.array(gaps, dtype=np.int64)


@kernel
def strip(
    near: FloatArray, x: float, y: float, heading: float, reach: float
) -> tuple[float, float]:
    """Free limits to the left and right of a line through (x, y), metres (left > 0 > right)."""
    c, s = math.cos(heading), math.sin(heading)
    left, right = MAX_HALF_WIDTH, -MAX_HALF_WIDTH
    for k in range(len(near)):
        dx, dy = near[k, 0] - x, near[k, 1] - y
        if abs(c * dx + s * dy) < reach:
            across = c * dy - s * dx
            if across > 0:
                left = min(left, across)
            else:
                right = max(right, across)
    return left, right


@kernel
def points_near(field: ObstacleField, x: float, y: float, radius: float) -> FloatArray:
    """The obstacle points within the radius, shape (N, 2)."""
    near = [(0.0, 0.0)]
    for k in range(len(field.points)):
        dx, dy = field.points[k, 0] - x, field.points[k, 1] - y
        if dx * dx + dy * dy < radius * radius:
            near.append((field.points[k, 0], field.points[k, 1]))
    out = np.empty((len(near) - 1, 2))
    for k in range(1, len(near)):
        out[k - 1] = near[k]
    return out


@kernel
def lanes_through(
    field: ObstacleField, body: Footprint, x: float, y: float, ahead: float, margin: float
) -> FloatArray:
    """The best lanes through (x, y) for a robot that arrives with heading `ahead`, shape (L, 4)."""
    near = points_near(field, x, y, HALF_LANE_LENGTH + MAX_HALF_WIDTH)
    lanes, scores = np.empty((LANE_HEADINGS, 4)), np.full(LANE_HEADINGS, -np.inf)
    for k in range(LANE_HEADINGS):
        turn = math.pi * ((k + 0.5) / LANE_HEADINGS - 0.5)
        lanes[k] = centred(near, x, y, ahead + turn, HALF_LANE_LENGTH)
        width = lanes[k, WIDTH] - 2 * body.half_width
        if width >= 2 * margin - CELL_DIAGONAL:
            scores[k] = min(width, USEFUL_EXTRA_WIDTH) - 0.1 * abs(turn)
    best = _best_apart(lanes, scores)
    for k in range(len(best)):
        best[k] = refined(near, best[k])
    return best


@kernel
def centred(near: FloatArray, x: float, y: float, heading: float, reach: float) -> FloatArray:
    """The lane of that heading around (x, y)."""
    left, right = 0.0, 0.0
    for _ in range(3):
        left, right = strip(near, x, y, heading, reach)
        shift = (left + right) / 2
        x, y = x - math.sin(heading) * shift, y + math.cos(heading) * shift
    return np.array([x, y, heading, left - right])


@kernel
def is_passable(field: ObstacleField, body: Footprint, x: float, y: float, margin: float) -> bool:
    """Whether the body fits through the gap at (x, y) in any heading.

    While the middle of the body passes the gap, the whole body lies in one straight strip. The
    place (x, y) is the middle of the gap only approximately. The test therefore leaves out a tenth
    of the length and 1 cm of the width, and also tries places up to 0.1 m away.
    """
    reach = 0.45 * (body.front + body.rear)
    near = points_near(field, x, y, reach + MAX_HALF_WIDTH + 0.2)
    for k in range(2 * LANE_HEADINGS):
        heading = math.pi * k / (2 * LANE_HEADINGS)
        for offset in (0.0, 0.1, -0.1):
            px, py = x + offset * math.cos(heading), y + offset * math.sin(heading)
            lane = centred(near, px, py, heading, reach)
            fits = lane[WIDTH] >= 2 * (body.half_width + margin) - 0.01
            if fits and math.hypot(lane[X] - px, lane[Y] - py) < 0.15:
                return True
    return False


@kernel
def refined(near: FloatArray, lane: FloatArray) -> FloatArray:
    """The widest lane within one step of heading."""
    best = lane
    for k in range(-6, 7):
        heading = lane[HEADING] + k / 6 * math.pi / LANE_HEADINGS
        trial = centred(near, lane[X], lane[Y], heading, HALF_LANE_LENGTH)
        if trial[WIDTH] > best[WIDTH] + 1e-6:
            best = trial
    return best


@kernel
def _best_apart(lanes: FloatArray, scores: FloatArray) -> FloatArray:
    """The best lanes that differ by more than 20 degrees, shape (L, 4)."""
    apart = round(LANE_HEADINGS * 20 / 180)
    kept = np.empty((LANES_PER_GAP, 4))
    n = 0
    while n < LANES_PER_GAP and scores.max() > -np.inf:
        best = scores.argmax()
        kept[n] = lanes[best]
        n += 1
        scores[max(0, best - apart) : best + apart + 1] = -np.inf
    return kept[:n]


@kernel
def lane_anchors(
    field: ObstacleField,
    body: Footprint,
    room: FloatArray,
    way: NDArray[np.int64],
    limit: float,
    margin: float,
) -> FloatArray:
    """Free axle poses along the lanes through every narrow place of the way, shape (K, 3).

    Args:
        field: the obstacle points.
        body: the footprint.
        room: of `heuristic.room_grid`.
        way: cells (j, i) of the coarse way, shape (M, 2).
        limit: room below which a place of the way counts as narrow, metres.
        margin: distance to keep from obstacles, metres.
    """
    gaps = narrowest(room, way, limit)
    anchors = np.empty((len(gaps) * LANES_PER_GAP * ANCHORS_PER_LANE, 3))
    n = 0
    for gap in gaps:
        j, i = way[gap]
        k0, k1 = max(0, gap - 5), min(len(way) - 1, gap + 5)
        ahead = math.atan2(float(way[k1, 0] - way[k0, 0]), float(way[k1, 1] - way[k0, 1]))
        x, y = field.x + (i + 0.5) * COARSE_CELL, field.y + (j + 0.5) * COARSE_CELL
        lanes = lanes_through(field, body, x, y, ahead, margin)
        for k in range(len(lanes)):
            for step in range(ANCHORS_PER_LANE):
                along = (
                    ANCHOR_DISTANCE * (step - ANCHORS_PER_LANE // 2) - (body.front - body.rear) / 2
                )
                heading = lanes[k, HEADING]
                ax = lanes[k, X] + along * math.cos(heading)
                ay = lanes[k, Y] + along * math.sin(heading)
                if is_clear(field, body, ax, ay, heading, margin):
                    anchors[n] = ax, ay, heading
                    n += 1
    return anchors[:n]


@kernel
def close_gaps(
    field: ObstacleField, body: Footprint, room: FloatArray, way: NDArray[np.int64], margin: float
) -> bool:
    """Close in `room` the gaps of the way that are too narrow for the body.

    The ends of the way stay open: whether the robot fits where it stands and where it is sent is
    not judged here.

    Returns:
        whether a gap was closed.
    """
    closed = False
    around = round(0.3 / COARSE_CELL)
    for gap in narrowest(room, way, CELL_DIAGONAL):
        j, i = way[gap]
        at_end = gap < 2 * around or gap > len(way) - 1 - 2 * around
        x, y = field.x + (i + 0.5) * COARSE_CELL, field.y + (j + 0.5) * COARSE_CELL
        if not at_end and not is_passable(field, body, x, y, margin):
            room[max(0, j - around) : j + around + 1, max(0, i - around) : i + around + 1] = -1.0
            closed = True
    return closed
