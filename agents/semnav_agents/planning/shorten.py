"""Shortens planned moves: direct connections, and arcs in place of turns on the spot."""

from __future__ import annotations

import math

import numpy as np

from semnav_agents.planning.collision import Footprint, ObstacleField
from semnav_agents.planning.connect import (
    connection,
    cost_of_moves,
    is_move,
    last_kind,
    smooth_connection,
)
from semnav_agents.planning.motion import (
    FORWARD,
    REVERSE,
    STILL,
    TURN,
    MotionCosts,
    Move,
    SafetyMargin,
    kind_of,
    move_at,
    moved,
)
from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel

ARC_RADII = (2.0, 1.4, 1.0, 0.7, 0.5, 0.35)
"""Radii of the arcs that round a corner, metres; the widest is tried first."""

WIDE_RADIUS, TIGHT_RADIUS = 1.2, 0.6
"""Radii of the arcs of smooth connections, metres."""

ARC_SIDES = (1.0, -1.0)
"""An arc to the left, and one to the right."""


@kernel
def merged(moves: FloatArray) -> FloatArray:
    """The moves without empty ones, equal motions that follow one another joined."""
    out = np.empty_like(moves)
    n = 0
    for k in range(len(moves)):
        if not is_move(move_at(moves, k)):
            continue
        if n > 0 and _same_twist(move_at(out, n - 1), move_at(moves, k)):
            out[n - 1] += moves[k]
        else:
            out[n] = moves[k]
            n += 1
    return out[:n]


@kernel
def _same_twist(a: Move, b: Move) -> bool:
    """Whether one move goes on as the other, so that both are one move."""
    if kind_of(a) != kind_of(b):
        return False
    if kind_of(a) == TURN:
        return bool(a.turn * b.turn > 0)
    straight = a.turn == 0.0 and b.turn == 0.0 and a.left * b.left >= 0
    # equal curvature, turn / forward, multiplied out so that nothing is divided by 0
    same_curvature = abs(a.turn * b.forward - b.turn * a.forward) < 1e-9
    same_arc = same_curvature and a.left == 0.0 and b.left == 0.0
    return bool(straight or same_arc)


@kernel
def shortened(
    field: ObstacleField,
    body: Footprint,
    start: Pose,
    moves: FloatArray,
    margin: SafetyMargin,
    costs: MotionCosts,
) -> FloatArray:
    """The moves with stretches of them replaced by a short connection where that is cheaper."""
    at, out, pose, kind = 0, [moves[:0]], start, STILL
    while at < len(moves):
        old = new = moves[at:]
        for upto in range(len(moves), at, -1):
            old = new = moves[at:upto]
            if upto > at + 1:
                price = cost_of_moves(field, body, pose, old, kind, margin, costs, math.inf)
                new = _cheapest(field, body, pose, old, kind, margin, costs, price - 0.01)
            if len(new) > 0:
                break
        out.append(new)
        kind = last_kind(new, kind)
        pose = end_of(pose, old)
        at += len(old)
    return merged(_stacked(out))


@kernel
def _cheapest(
    field: ObstacleField,
    body: Footprint,
    pose: Pose,
    old: FloatArray,
    kind: int,
    margin: SafetyMargin,
    costs: MotionCosts,
    limit: float,
) -> FloatArray:
    """The cheapest connection of the ends of `old` that costs less than `limit`, or no moves."""
    end = end_of(pose, old)
    best = old[:0]
    for k in range(9):  # turn-drive-turn; then two radii, each with four pairs of sides
        if k == 0:
            moves = connection(pose, end, False)
        else:
            radius = WIDE_RADIUS if k < 5 else TIGHT_RADIUS
            moves = smooth_connection(pose, end, radius, ARC_SIDES[k % 2], ARC_SIDES[k // 2 % 2])
        if len(moves) > 0:
            cost = cost_of_moves(field, body, pose, moves, kind, margin, costs, limit)
            if cost < limit:
                best, limit = moves, cost
    return best


@kernel
def end_of(pose: Pose, moves: FloatArray) -> Pose:
    """The axle pose after the moves."""
    for k in range(len(moves)):
        pose = moved(pose[0], pose[1], pose[2], move_at(moves, k))
    return pose


@kernel
def _stacked(parts: list[FloatArray]) -> FloatArray:
    total = 0
    for part in parts:
        total += len(part)
    out, n = np.empty((total, 3)), 0
    for part in parts:
        out[n : n + len(part)] = part
        n += len(part)
    return out


@kernel
def rounded(
    field: ObstacleField,
    body: Footprint,
    start: Pose,
    moves: FloatArray,
    margin: SafetyMargin,
    costs: MotionCosts,
) -> FloatArray:
    """The moves with turns on the spot between straight lines replaced by arcs where cheaper.

    An arc of radius R through an angle a touches both lines R tan(a / 2) from their corner.
    """
    out = np.zeros((len(moves), 3))
    out[:] = moves
    pose = start
    for k in range(len(moves)):
        if 0 < k < len(moves) - 1 and _is_corner(out, k):
            before = moved(pose[0], pose[1], pose[2], Move(-out[k - 1, 0], 0.0, 0.0))
            out[k - 1 : k + 2] = _arc(field, body, before, out[k - 1 : k + 2], margin, costs)
            pose = moved(before[0], before[1], before[2], Move(out[k - 1, 0], 0.0, 0.0))
        pose = moved(pose[0], pose[1], pose[2], move_at(out, k))
    return merged(out)


@kernel
def _is_corner(moves: FloatArray, k: int) -> bool:
    """Whether a move is a turn on the spot between two straight lines in the same direction."""
    before, at, after = move_at(moves, k - 1), move_at(moves, k), move_at(moves, k + 1)
    straight = before.turn == 0.0 and after.turn == 0.0 and before.left == 0.0 and after.left == 0.0
    turns = at.forward == 0.0 and at.left == 0.0 and abs(at.turn) < 2.4
    return bool(straight and turns and before.forward * after.forward > 0)


@kernel
def _arc(
    field: ObstacleField,
    body: Footprint,
    pose: Pose,
    corner: FloatArray,
    margin: SafetyMargin,
    costs: MotionCosts,
) -> FloatArray:
    """The cheapest of a corner's own moves (line, turn, line) and of those with an arc, (3, 3)."""
    kind = FORWARD if corner[0, 0] > 0 else REVERSE
    best = corner.copy()
    cost = cost_of_moves(field, body, pose, corner, kind, margin, costs, math.inf)
    sign, turn = math.copysign(1.0, corner[0, 0]), corner[1, 2]
    for radius in ARC_RADII:
        cut = radius * math.tan(abs(turn) / 2)
        if cut > abs(corner[0, 0]) or cut > 0.6 * abs(corner[2, 0]):
            continue
        trial = corner.copy()
        trial[0, 0] -= sign * cut
        trial[1, 0] = sign * radius * abs(turn)
        trial[2, 0] -= sign * cut
        price = cost_of_moves(field, body, pose, trial, kind, margin, costs, cost)
        if price < cost:
            best, cost = trial, price
    return best
