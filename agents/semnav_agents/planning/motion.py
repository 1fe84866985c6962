"""Moves of constant twist, their costs, and collision checks.

A move (d, 0, 0) is a straight line, (0, 0, a) a turn on the spot, and (d, 0, a) an arc of radius
d / a. An array of moves has a row (forward, left, turn) for each, shape (M, 3).
"""

from __future__ import annotations

import math
from typing import NamedTuple

from semnav_agents.planning.collision import (
    MAX_SWEEP_STEP,
    Footprint,
    ObstacleField,
    is_clear,
    room_at,
)
from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel

STILL, TURN, FORWARD, REVERSE, SIDEWAYS = range(5)
"""Kinds of motion; a robot stops where the kind changes."""

START_RADIUS = 0.3
"""Distance from the start within which the margin need not grow, metres: the rear of the body
swings out before the robot leaves."""


class Move(NamedTuple):
    """A displacement of the axle along the body's axes, driven at a constant twist.

    Attributes:
        forward: metres.
        left: metres.
        turn: radians.
    """

    forward: float
    left: float
    turn: float


class MotionCosts(NamedTuple):
    """Costs of moves, in seconds.

    Attributes:
        speed: forward, m/s.
        reverse: factor on the time of backward motion, where the lidar does not see.
        sideways_speed: m/s; 0 for a robot that cannot move sideways.
        turn_rate: on the spot, rad/s.
        stop: time lost where the kind of motion changes, seconds.
        steering: time lost for each 1/m by which the curvature changes, seconds.
        room: clearance beyond which more is worth nothing, metres.
        crowding: share by which a second counts more at clearance 0.
    """

    speed: float
    reverse: float
    sideways_speed: float
    turn_rate: float
    stop: float
    steering: float
    room: float
    crowding: float


class SafetyMargin(NamedTuple):
    """The distance to keep from obstacles: `full`, but less near the start.

    A robot that stands closer to a wall than `full` must be able to leave. The margin is `start`
    within `START_RADIUS` of the start and grows by `growth` per metre from there on.

    Attributes:
        full: metres.
        start: metres, at most `full`.
        growth: metres per metre.
        x: of the start, metres.
        y: of the start, metres.
    """

    full: float
    start: float
    growth: float
    x: float
    y: float


@kernel
def margin_at(margin: SafetyMargin, x: float, y: float) -> float:
    """Distance to keep from obstacles at an axle position, metres."""
    if margin.start >= margin.full:
        return margin.full
    travelled = max(0.0, math.hypot(x - margin.x, y - margin.y) - START_RADIUS)
    return min(margin.full, margin.start + margin.growth * travelled)


@kernel
def move_at(moves: FloatArray, k: int) -> Move:
    """Row k of an array of moves."""
    return Move(moves[k, 0], moves[k, 1], moves[k, 2])


@kernel
def kind_of(move: Move) -> int:
    """TURN, FORWARD, REVERSE or SIDEWAYS."""
    if abs(move.left) > abs(move.forward):
        return SIDEWAYS
    if abs(move.forward) < 1e-9:
        return TURN
    return FORWARD if move.forward > 0 else REVERSE


@kernel
def moved(x: float, y: float, heading: float, move: Move, share: float = 1.0) -> Pose:
    """The axle pose after that share of the move: the exponential map of SE(2)."""
    forward, left, turn = move.forward * share, move.left * share, move.turn * share
    half = turn / 2
    # chord / arc = sin(half) / half, by its series where that would divide by almost nothing
    chord = 1.0 - half * half / 6 if abs(half) < 1e-4 else math.sin(half) / half
    c, s = math.cos(heading + half) * chord, math.sin(heading + half) * chord
    return x + c * forward - s * left, y + s * forward + c * left, heading + turn


@kernel
def duration(move: Move, costs: MotionCosts) -> float:
    """Time of the move in free space, seconds."""
    turn = abs(move.turn)
    kind = kind_of(move)
    if kind == TURN:
        return turn / costs.turn_rate
    if kind == SIDEWAYS:
        return math.hypot(move.forward, move.left) / costs.sideways_speed
    travel = abs(move.forward) / costs.speed
    if kind == REVERSE:
        travel *= costs.reverse
    return travel + 0.2 * turn / costs.turn_rate


@kernel
def crowding_at(room: float, costs: MotionCosts) -> float:
    """Share by which a second counts more at that clearance."""
    lack = max(0.0, 1.0 - room / costs.room)
    return costs.crowding * lack * lack


@kernel
def sweep(
    field: ObstacleField,
    body: Footprint,
    start: Pose,
    move: Move,
    margin: SafetyMargin,
    costs: MotionCosts,
) -> float:
    """Cost of the move, seconds; infinite if it collides. The start itself is not tested."""
    reach = math.hypot(body.front, body.half_width)
    extent = math.hypot(move.forward, move.left) + reach * abs(move.turn)
    n = max(1, math.ceil(extent / MAX_SWEEP_STEP))
    crowd = 0.0
    for k in range(1, n + 1):
        x, y, heading = moved(start[0], start[1], start[2], move, k / n)
        if not is_clear(field, body, x, y, heading, margin_at(margin, x, y)):
            return math.inf
        crowd += crowding_at(room_at(field, body, x, y, heading), costs)
    return duration(move, costs) * (1.0 + crowd / n)


@kernel
def change_cost(before: int, after: int, costs: MotionCosts) -> float:
    """Time lost between moves of two kinds, seconds."""
    if before in (after, STILL):
        return 0.0
    return costs.stop if before == TURN or after == TURN else 2.0 * costs.stop


@kernel
def curvature(move: Move) -> float:
    """Turn per metre forward, 1/m; NaN for a turn on the spot and a sideways move."""
    return move.turn / move.forward if kind_of(move) in (FORWARD, REVERSE) else math.nan


@kernel
def steering_cost(before: float, after: float, costs: MotionCosts) -> float:
    """Time lost where the curvature changes, seconds; none where either is NaN."""
    change = abs(after - before)
    return 0.0 if math.isnan(change) else costs.steering * change
