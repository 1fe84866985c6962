"""Moves of constant twist, what they cost, and whether they are free.

A move is (forward, left, turn): the displacement of the axle, in metres and radians along the
body's axes, driven at a constant twist. (d, 0, 0) is a straight line, (0, 0, a) a turn on the
spot, (d, 0, a) an arc of radius d / a.
"""

from __future__ import annotations

import math
from typing import NamedTuple, TypeAlias

from numba import njit

from semnav_env.agents.planning.collision import STRIDE, Body, Field, is_clear, room_at

Triple: TypeAlias = tuple[float, float, float]

STILL, TURN, FORWARD, REVERSE, SIDEWAYS = range(5)
"""Kinds of motion; a robot stops where the kind changes."""


GRACE = 0.3
"""Metres from the start over which the gap need not grow: the rear swings out before one leaves."""


class Costs(NamedTuple):
    """What a move costs, in seconds.

    Attributes:
        speed: m/s forward.
        reverse: factor on backward motion, which the lidar does not see.
        sideways_speed: m/s; 0 for a robot that cannot.
        turn_rate: rad/s on the spot.
        stop: seconds lost where the kind of motion changes.
        steering: seconds for each 1/m by which the curvature changes.
        room: metres of clearance beyond which more is worth nothing.
        crowding: how many times longer a second counts at clearance 0, less 1.
    """

    speed: float
    reverse: float
    sideways_speed: float
    turn_rate: float
    stop: float
    steering: float
    room: float
    crowding: float


class Margin(NamedTuple):
    """The gap to keep: `full`, but less close to where one starts.

    There it is `start` up to `GRACE` metres away and grows by `growth` per metre from then on.

    A robot that stands closer to a wall than the margin must be able to leave.

    Attributes:
        full: metres.
        start: metres, at most `full`.
        growth: metres per metre.
        x: where one starts, metres.
        y: the same.
    """

    full: float
    start: float
    growth: float
    x: float
    y: float


@njit(cache=True)
def margin_at(margin: Margin, x: float, y: float) -> float:
    """Metres to keep at an axle position."""
    if margin.start >= margin.full:
        return margin.full
    travelled = max(0.0, math.hypot(x - margin.x, y - margin.y) - GRACE)
    return min(margin.full, margin.start + margin.growth * travelled)


@njit(cache=True)
def kind_of(move: Triple) -> int:
    """TURN, FORWARD, REVERSE or SIDEWAYS."""
    if abs(move[1]) > abs(move[0]):
        return SIDEWAYS
    if abs(move[0]) < 1e-9:
        return TURN
    return FORWARD if move[0] > 0 else REVERSE


@njit(cache=True)
def moved(x: float, y: float, heading: float, move: Triple, share: float = 1.0) -> Triple:
    """The axle pose after that share of the move: the exponential map of SE(2)."""
    forward, left, turn = move[0] * share, move[1] * share, move[2] * share
    half = turn / 2
    chord = 1.0 - half * half / 6 if abs(half) < 1e-4 else math.sin(half) / half
    c, s = math.cos(heading + half) * chord, math.sin(heading + half) * chord
    return x + c * forward - s * left, y + s * forward + c * left, heading + turn


@njit(cache=True)
def duration(move: Triple, costs: Costs) -> float:
    """Seconds for the move in free space."""
    turn = abs(move[2])
    kind = kind_of(move)
    if kind == TURN:
        return turn / costs.turn_rate
    if kind == SIDEWAYS:
        return math.hypot(move[0], move[1]) / costs.sideways_speed
    travel = abs(move[0]) / costs.speed
    if kind == REVERSE:
        travel *= costs.reverse
    return travel + 0.2 * turn / costs.turn_rate


@njit(cache=True)
def crowding_at(room: float, costs: Costs) -> float:
    """Factor by which a second counts more at that clearance."""
    lack = max(0.0, 1.0 - room / costs.room)
    return costs.crowding * lack * lack


@njit(cache=True)
def sweep(
    field: Field, body: Body, start: Triple, move: Triple, margin: Margin, costs: Costs
) -> float:
    """Cost of the move in seconds, infinite if it collides. The start itself is not tested."""
    reach = math.hypot(body.front, body.half_width)
    extent = math.hypot(move[0], move[1]) + reach * abs(move[2])
    n = max(1, math.ceil(extent / STRIDE))
    crowd = 0.0
    for k in range(1, n + 1):
        x, y, heading = moved(start[0], start[1], start[2], move, k / n)
        if not is_clear(field, body, x, y, heading, margin_at(margin, x, y)):
            return math.inf
        crowd += crowding_at(room_at(field, body, x, y, heading), costs)
    return duration(move, costs) * (1.0 + crowd / n)


@njit(cache=True)
def change_cost(before: int, after: int, costs: Costs) -> float:
    """Seconds lost between moves of two kinds."""
    if before in (after, STILL):
        return 0.0
    return costs.stop if before == TURN or after == TURN else 2.0 * costs.stop


@njit(cache=True)
def curvature(move: Triple) -> float:
    """1/m, positive to the left when driving forward; NaN for a turn or a sideways move."""
    return move[2] / move[0] if kind_of(move) in (FORWARD, REVERSE) else math.nan


@njit(cache=True)
def steering_cost(before: float, after: float, costs: Costs) -> float:
    """Seconds lost where the curvature changes; none where either is NaN."""
    change = abs(after - before)
    return 0.0 if math.isnan(change) else costs.steering * change
