"""Straight lanes through narrow places.

A search over sampled states hardly ever meets a gap that leaves a few centimetres. So where the
coarse way to the target is narrow, the widest straight strips through that place are measured
from the obstacle points, and poses centred in them become anchors, which the search may connect
to exactly.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from semnav_env.agents.planning.collision import SLACK, Body, Field, is_clear
from semnav_env.agents.planning.heuristic import STEP
from semnav_env.features.frames import FloatArray

HEADINGS = 48
"""Headings tried over half a turn."""

REACH = 0.85
"""Metres before and behind the gap over which a lane is measured."""

WIDEST = 1.0
"""Metres to either side within which a lane is measured."""

WORTH = 0.5
"""Metres of width beyond the body's that make one lane better than another."""

PER_GAP = 3
"""Lanes kept for each gap."""

STEPS = 9
"""Anchors along a lane, 0.4 m apart, the middle one in the gap."""


@njit(cache=True)
def narrowest(room: FloatArray, way: NDArray[np.int64], limit: float) -> NDArray[np.int64]:
    """Places in `way` (cells, (M, 2)) where the room is least within 0.6 m and below the limit."""
    around = int(0.6 / STEP)
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


@njit(cache=True)
def strip(
    near: FloatArray, x: float, y: float, heading: float, reach: float
) -> tuple[float, float]:
    """Free limits to the left and right of a line through (x, y), metres (left > 0 > right)."""
    c, s = math.cos(heading), math.sin(heading)
    left, right = WIDEST, -WIDEST
    for k in range(len(near)):
        dx, dy = near[k, 0] - x, near[k, 1] - y
        if abs(c * dx + s * dy) < reach:
            across = c * dy - s * dx
            if across > 0:
                left = min(left, across)
            else:
                right = max(right, across)
    return left, right


@njit(cache=True)
def points_near(field: Field, x: float, y: float, radius: float) -> FloatArray:
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


@njit(cache=True)
def lanes_through(
    field: Field, body: Body, x: float, y: float, ahead: float, margin: float
) -> FloatArray:
    """The best lanes through (x, y) for one who comes that way with heading `ahead`.

    Returns:
        rows (x, y, heading, width) of a point in the middle of each lane, shape (L, 4).
    """
    near = points_near(field, x, y, REACH + WIDEST)
    lanes, scores = np.empty((HEADINGS, 4)), np.full(HEADINGS, -np.inf)
    for k in range(HEADINGS):
        turn = math.pi * ((k + 0.5) / HEADINGS - 0.5)
        lanes[k] = centred(near, x, y, ahead + turn, REACH)
        width = lanes[k, 3] - 2 * body.half_width
        if width >= 2 * margin - SLACK:
            scores[k] = min(width, WORTH) - 0.1 * abs(turn)
    best = _best_apart(lanes, scores)
    for k in range(len(best)):
        best[k] = refined(near, best[k])
    return best


@njit(cache=True)
def centred(near: FloatArray, x: float, y: float, heading: float, reach: float) -> FloatArray:
    """The lane of that heading around (x, y): (x, y, heading, width), its middle and width."""
    left, right = 0.0, 0.0
    for _ in range(3):
        left, right = strip(near, x, y, heading, reach)
        shift = (left + right) / 2
        x, y = x - math.sin(heading) * shift, y + math.cos(heading) * shift
    return np.array([x, y, heading, left - right])


@njit(cache=True)
def is_passable(field: Field, body: Body, x: float, y: float, margin: float) -> bool:
    """Whether the body fits through the gap at (x, y) in any heading.

    While its middle passes the gap the whole body lies in one straight strip. Since (x, y) is
    only about the middle, a tenth of the length and 1 cm of width are left out, and places up to
    0.1 m away are tried too.
    """
    reach = 0.45 * (body.front + body.rear)
    near = points_near(field, x, y, reach + WIDEST + 0.2)
    for k in range(2 * HEADINGS):
        heading = math.pi * k / (2 * HEADINGS)
        for offset in (0.0, 0.1, -0.1):
            px, py = x + offset * math.cos(heading), y + offset * math.sin(heading)
            lane = centred(near, px, py, heading, reach)
            fits = lane[3] >= 2 * (body.half_width + margin) - 0.01
            if fits and math.hypot(lane[0] - px, lane[1] - py) < 0.15:
                return True
    return False


@njit(cache=True)
def refined(near: FloatArray, lane: FloatArray) -> FloatArray:
    """The widest lane within one step of heading."""
    best = lane
    for k in range(-6, 7):
        trial = centred(near, lane[0], lane[1], lane[2] + k / 6 * math.pi / HEADINGS, REACH)
        if trial[3] > best[3] + 1e-6:
            best = trial
    return best


@njit(cache=True)
def _best_apart(lanes: FloatArray, scores: FloatArray) -> FloatArray:
    """The best lanes that differ by more than 20 degrees, shape (L, 4)."""
    apart = round(HEADINGS * 20 / 180)
    kept = np.empty((PER_GAP, 4))
    n = 0
    while n < PER_GAP and scores.max() > -np.inf:
        best = scores.argmax()
        kept[n] = lanes[best]
        n += 1
        scores[max(0, best - apart) : best + apart + 1] = -np.inf
    return kept[:n]


@njit(cache=True)
def lane_anchors(
    field: Field, body: Body, room: FloatArray, way: NDArray[np.int64], limit: float, margin: float
) -> FloatArray:
    """Free axle poses along the lanes through every narrow place of the way, shape (K, 3)."""
    gaps = narrowest(room, way, limit)
    anchors = np.empty((len(gaps) * PER_GAP * STEPS, 3))
    n = 0
    for gap in gaps:
        j, i = way[gap]
        k0, k1 = max(0, gap - 5), min(len(way) - 1, gap + 5)
        ahead = math.atan2(float(way[k1, 0] - way[k0, 0]), float(way[k1, 1] - way[k0, 1]))
        x, y = field.x + (i + 0.5) * STEP, field.y + (j + 0.5) * STEP
        lanes = lanes_through(field, body, x, y, ahead, margin)
        for k in range(len(lanes)):
            for step in range(STEPS):
                along = 0.4 * (step - 4) - (body.front - body.rear) / 2
                heading = lanes[k, 2]
                ax = lanes[k, 0] + along * math.cos(heading)
                ay = lanes[k, 1] + along * math.sin(heading)
                if is_clear(field, body, ax, ay, heading, margin):
                    anchors[n] = ax, ay, heading
                    n += 1
    return anchors[:n]


@njit(cache=True)
def close_gaps(
    field: Field, body: Body, room: FloatArray, way: NDArray[np.int64], margin: float
) -> bool:
    """Mark in `room` the gaps on the way that are too narrow for the body; whether there are any.

    The ends of the way stay open: where the robot stands and where it is sent is not judged here.
    """
    closed = False
    around = round(0.3 / STEP)
    for gap in narrowest(room, way, SLACK):
        j, i = way[gap]
        at_end = gap < 2 * around or gap > len(way) - 1 - 2 * around
        x, y = field.x + (i + 0.5) * STEP, field.y + (j + 0.5) * STEP
        if not at_end and not is_passable(field, body, x, y, margin):
            room[max(0, j - around) : j + around + 1, max(0, i - around) : i + around + 1] = -1.0
            closed = True
    return closed
