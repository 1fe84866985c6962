"""Fewer stops: shorter ways between the ends of moves, and arcs in place of turns on the spot."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from semnav_env.agents.planning.collision import Body, Field
from semnav_env.agents.planning.connect import (
    connection,
    cost_of_moves,
    last_kind,
    smooth_connection,
)
from semnav_env.agents.planning.motion import (
    FORWARD,
    REVERSE,
    STILL,
    TURN,
    Costs,
    Margin,
    Triple,
    kind_of,
    moved,
)
from semnav_env.features.frames import FloatArray

RADII = (2.0, 1.4, 1.0, 0.7, 0.5, 0.35)
"""Metres, of arcs that round a corner; tried from the widest."""

WIDE, TIGHT = 1.2, 0.6
"""Metres, of the arcs of smooth connections."""

SIDES = (1.0, -1.0)


@njit(cache=True)
def merged(moves: FloatArray) -> FloatArray:
    """The moves without empty ones, equal motions that follow one another joined."""
    out = np.empty_like(moves)
    n = 0
    for k in range(len(moves)):
        if moves[k, 0] == 0.0 and moves[k, 1] == 0.0 and moves[k, 2] == 0.0:
            continue
        if n > 0 and _same_twist(out[n - 1], moves[k]):
            out[n - 1] += moves[k]
        else:
            out[n] = moves[k]
            n += 1
    return out[:n]


@njit(cache=True)
def _same_twist(a: FloatArray, b: FloatArray) -> bool:
    kind_a, kind_b = kind_of((a[0], a[1], a[2])), kind_of((b[0], b[1], b[2]))
    if kind_a != kind_b:
        return False
    if kind_a == TURN:
        return bool(a[2] * b[2] > 0)
    straight = a[2] == 0.0 and b[2] == 0.0 and a[1] * b[1] >= 0
    same_arc = abs(a[2] * b[0] - b[2] * a[0]) < 1e-9 and a[1] == 0.0 and b[1] == 0.0
    return bool(straight or same_arc)


@njit(cache=True)
def shortened(
    field: Field, body: Body, start: Triple, moves: FloatArray, margin: Margin, costs: Costs
) -> FloatArray:
    """The moves with runs of them replaced by a short connection wherever that is cheaper."""
    at, out, pose, kind = 0, [moves[:0]], start, STILL
    while at < len(moves):
        for upto in range(len(moves), at, -1):
            old = moves[at:upto]
            new = old
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


@njit(cache=True)
def _cheapest(
    field: Field,
    body: Body,
    pose: Triple,
    old: FloatArray,
    kind: int,
    margin: Margin,
    costs: Costs,
    limit: float,
) -> FloatArray:
    """The cheapest connection below the limit of the ends of `old`; empty if there is none."""
    end = end_of(pose, old)
    best = old[:0]
    for k in range(9):
        if k == 0:
            moves = connection(pose, end, False)
        else:
            radius = WIDE if k < 5 else TIGHT
            moves = smooth_connection(pose, end, radius, SIDES[k % 2], SIDES[k // 2 % 2])
        if len(moves) > 0:
            cost = cost_of_moves(field, body, pose, moves, kind, margin, costs, limit)
            if cost < limit:
                best, limit = moves, cost
    return best


@njit(cache=True)
def end_of(pose: Triple, moves: FloatArray) -> Triple:
    """The axle pose after the moves."""
    for k in range(len(moves)):
        pose = moved(pose[0], pose[1], pose[2], (moves[k, 0], moves[k, 1], moves[k, 2]))
    return pose


@njit(cache=True)
def _stacked(parts: list[FloatArray]) -> FloatArray:
    total = 0
    for part in parts:
        total += len(part)
    out, n = np.empty((total, 3)), 0
    for part in parts:
        out[n : n + len(part)] = part
        n += len(part)
    return out


@njit(cache=True)
def rounded(
    field: Field, body: Body, start: Triple, moves: FloatArray, margin: Margin, costs: Costs
) -> FloatArray:
    """The moves with turns on the spot between two straight lines replaced by arcs, where cheaper.

    An arc of radius R through a turn a touches both lines R tan(a / 2) from their corner.
    """
    out = np.zeros((len(moves), 3))
    out[:] = moves
    pose = start
    for k in range(len(moves)):
        if 0 < k < len(moves) - 1 and _is_corner(out, k):
            before = moved(pose[0], pose[1], pose[2], (-out[k - 1, 0], 0.0, 0.0))
            out[k - 1 : k + 2] = _arc(field, body, before, out[k - 1 : k + 2], margin, costs)
            pose = moved(before[0], before[1], before[2], (out[k - 1, 0], 0.0, 0.0))
        pose = moved(pose[0], pose[1], pose[2], (out[k, 0], out[k, 1], out[k, 2]))
    return merged(out)


@njit(cache=True)
def _is_corner(moves: FloatArray, k: int) -> bool:
    before, after = moves[k - 1], moves[k + 1]
    straight = before[2] == 0.0 and after[2] == 0.0 and before[1] == 0.0 and after[1] == 0.0
    turn = moves[k, 0] == 0.0 and moves[k, 1] == 0.0 and abs(moves[k, 2]) < 2.4
    return bool(straight and turn and before[0] * after[0] > 0)


@njit(cache=True)
def _arc(
    field: Field, body: Body, pose: Triple, corner: FloatArray, margin: Margin, costs: Costs
) -> FloatArray:
    kind = FORWARD if corner[0, 0] > 0 else REVERSE
    best = corner.copy()
    cost = cost_of_moves(field, body, pose, corner, kind, margin, costs, math.inf)
    sign, turn = math.copysign(1.0, corner[0, 0]), corner[1, 2]
    for radius in RADII:
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
