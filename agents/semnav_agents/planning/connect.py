"""Short connections between two poses: turn, drive, turn; or arc, line, arc."""

from __future__ import annotations

import math

import numpy as np

from semnav_agents.planning.collision import Footprint, ObstacleField
from semnav_agents.planning.motion import (
    MotionCosts,
    Move,
    SafetyMargin,
    change_cost,
    curvature,
    duration,
    kind_of,
    move_at,
    moved,
    steering_cost,
    sweep,
)
from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel

MIN_TURN = 1e-3
"""Smallest turn of a connection, radians; a smaller one is left out."""

MIN_DISTANCE = 5e-3
"""Smallest distance that a connection drives, metres; between closer positions it only turns."""


@kernel
def wrapped(angle: float) -> float:
    """The same angle in (-pi, pi]."""
    return math.pi - (math.pi - angle) % (2.0 * math.pi)


@kernel
def connection(start: Pose, end: Pose, backwards: bool) -> FloatArray:
    """Turn, drive and turn from one axle pose to another, shape (3, 3); a zero row is no move."""
    moves = np.zeros((3, 3))
    dx, dy = end[0] - start[0], end[1] - start[1]
    distance = math.hypot(dx, dy)
    heading = start[2]
    if distance > MIN_DISTANCE:
        turn = wrapped(math.atan2(dy, dx) + (math.pi if backwards else 0.0) - heading)
        moves[0, 2] = turn if abs(turn) > MIN_TURN else 0.0
        moves[1, 0] = -distance if backwards else distance
        heading += turn
    last = wrapped(end[2] - heading)
    moves[2, 2] = last if abs(last) > MIN_TURN else 0.0
    return moves


@kernel
def smooth_connection(
    start: Pose, end: Pose, radius: float, first: float, last: float
) -> FloatArray:
    """Arc, line and arc forward from one axle pose to another, shape (3, 3).

    `first` and `last` are +1 for an arc to the left and -1 for one to the right. The line is the
    common tangent of both circles (L. Dubins, American Journal of Mathematics 79, 1957).

    Returns:
        an empty array where the circles have no such tangent.
    """
    x = end[0] - start[0] + radius * (first * math.sin(start[2]) - last * math.sin(end[2]))
    y = end[1] - start[1] + radius * (last * math.cos(end[2]) - first * math.cos(start[2]))
    squared = x * x + y * y
    offset = 0.0 if first == last else 2.0 * radius
    if squared <= offset * offset:
        return np.empty((0, 3))
    heading = math.atan2(y, x) + first * math.asin(offset / math.sqrt(squared))
    begin, finish = _arc_angle(start[2], heading, first), _arc_angle(heading, end[2], last)
    moves = np.zeros((3, 3))
    moves[0] = radius * abs(begin), 0.0, begin
    moves[1, 0] = math.sqrt(squared - offset * offset)
    moves[2] = radius * abs(finish), 0.0, finish
    return moves


@kernel
def _arc_angle(begin: float, end: float, side: float) -> float:
    angle = (side * (end - begin)) % (2.0 * math.pi)
    return 0.0 if angle > 2.0 * math.pi - MIN_TURN else side * angle


@kernel
def cost_of_moves(
    field: ObstacleField,
    body: Footprint,
    start: Pose,
    moves: FloatArray,
    before: int,
    margin: SafetyMargin,
    costs: MotionCosts,
    limit: float,
) -> float:
    """Cost of driving the moves, seconds; infinite if they collide or cost `limit` or more.

    `before` is the kind of motion that precedes the moves. The time in free space, which is quick
    to compute, is compared with the limit before any move is tested for collisions.
    """
    least, kind = 0.0, before
    for k in range(len(moves)):
        move = move_at(moves, k)
        if is_move(move):
            least += change_cost(kind, kind_of(move), costs) + duration(move, costs)
            kind = kind_of(move)
    if least >= limit:
        return math.inf
    cost, kind, pose, bend = 0.0, before, start, math.nan
    for k in range(len(moves)):
        move = move_at(moves, k)
        if is_move(move):
            cost += change_cost(kind, kind_of(move), costs)
            cost += sweep(field, body, pose, move, margin, costs)
            if cost >= limit:
                return math.inf
            cost += steering_cost(bend, curvature(move), costs)
            bend, kind = curvature(move), kind_of(move)
            pose = moved(pose[0], pose[1], pose[2], move)
    return cost


@kernel
def is_move(move: Move) -> bool:
    """Whether any part of the move is not zero."""
    return move.forward != 0.0 or move.left != 0.0 or move.turn != 0.0


@kernel
def last_kind(moves: FloatArray, kind: int) -> int:
    """The kind of the last move that is not zero; `kind` if there is none."""
    for k in range(len(moves)):
        move = move_at(moves, k)
        if is_move(move):
            kind = kind_of(move)
    return kind
