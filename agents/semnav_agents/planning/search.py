"""Hybrid A*: continuous poses, one kept for each bin of position and heading.

D. Dolgov, S. Thrun, M. Montemerlo, J. Diebel, Path Planning for Autonomous Vehicles in Unknown
Semi-structured Environments, IJRR 29 (2010), with a connection "turn, drive, turn" in place of
the Reeds-Shepp curves, since these robots turn on the spot. The search may also connect exactly to
anchors: the target, and poses in lanes through narrow places.
"""

from __future__ import annotations

import heapq
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semnav_agents.planning.aim import Aim, arrived, target_from
from semnav_agents.planning.collision import FIELD_CELL, Footprint, ObstacleField
from semnav_agents.planning.connect import connection, cost_of_moves, last_kind
from semnav_agents.planning.heuristic import seconds_at
from semnav_agents.planning.motion import (
    STILL,
    MotionCosts,
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

POSITION_BIN = 0.1
"""Side of a bin of positions, metres; one node is kept for each bin of position and heading."""

HEADING_BINS = 48
"""Number of bins of heading in a full turn."""

POLISH_EXPANSIONS = 150
"""Number of nodes that are still expanded, to find a better way, once the target is connected."""

MAX_ANCHOR_DISTANCE = 3.0
"""Largest distance to an anchor that a node is connected to, metres."""


class SearchProblem(NamedTuple):
    """What a search is given, and does not change.

    Attributes:
        field: the obstacles.
        body: the footprint.
        aim: where to go.
        time: seconds to the aim from every cell, of `heuristic.seconds_to`.
        primitives: moves, (P, 3).
        margin: distance to keep from obstacles.
        costs: what a move costs.
        greed: weight of the time still to go; above 1 the search is faster and the path longer.
    """

    field: ObstacleField
    body: Footprint
    aim: Aim
    time: FloatArray
    primitives: FloatArray
    margin: SafetyMargin
    costs: MotionCosts
    greed: float


class SearchTree(NamedTuple):
    """The tree of a search: node 0 is the start, node 1 the exact target, then come the anchors.

    Attributes:
        pose: axle poses, (N, 3).
        cost: seconds from the start, (N,).
        parent: node from which each is reached, or -1, (N,).
        move: index of the primitive that leads here, or the kind of connection, (N,).
        kind: last kind of motion, (N,).
        bend: last curvature, 1/m; NaN unless a primitive came last, (N,).
        done: whether the node was expanded, (N,).
        bins: numbers of the bins that have a node, -1 in free places, (2^n,); see `bin_place`.
        node_in: node of the bin in each of these places, (2^n,).
        node_count: number of nodes, (1,); an array, so that kernels can change it.
    """

    pose: FloatArray
    cost: FloatArray
    parent: NDArray[np.int64]
    move: NDArray[np.int64]
    kind: NDArray[np.int64]
    bend: FloatArray
    done: NDArray[np.bool_]
    bins: NDArray[np.int64]
    node_in: NDArray[np.int32]
    node_count: NDArray[np.int64]


FORWARD_CONNECTION, BACKWARD_CONNECTION = -1, -2
"""Values of `SearchTree.move` for connections driven forward and backward."""

TARGET_NODE = 1
"""The node of the exact target."""


@kernel
def seconds_left(problem: SearchProblem, pose: Pose) -> float:
    """The heuristic at an axle pose, seconds."""
    axle = problem.aim.axle
    x, y = pose[0] - axle * math.cos(pose[2]), pose[1] - axle * math.sin(pose[2])
    return seconds_at(problem.field, problem.time, x, y)


@kernel
def new_tree(start: Pose, anchors: FloatArray, capacity: int) -> SearchTree:
    """A tree of the start alone, with room for `capacity` nodes."""
    places = 1
    while places < 3 * capacity:
        places *= 2
    tree = SearchTree(
        np.zeros((capacity, 3)),
        np.full(capacity, np.inf),
        np.full(capacity, -1, dtype=np.int64),
        np.zeros(capacity, dtype=np.int64),
        np.full(capacity, STILL, dtype=np.int64),
        np.full(capacity, np.nan),
        np.zeros(capacity, dtype=np.bool_),
        np.full(places, -1, dtype=np.int64),
        np.empty(places, dtype=np.int32),
        np.array([2 + len(anchors)]),
    )
    tree.pose[0] = start
    tree.pose[2 : 2 + len(anchors)] = anchors
    tree.cost[0] = 0.0
    return tree


@kernel
def pose_of(tree: SearchTree, node: int) -> Pose:
    """The node's axle pose."""
    return tree.pose[node, 0], tree.pose[node, 1], tree.pose[node, 2]


@kernel
def bin_place(tree: SearchTree, number: int) -> int:
    """The place of a bin in `tree.bins`: where it is, or the free place where it belongs.

    A hash table with linear probing: an array with a place for every bin of the window would take
    longer to make than most searches.
    """
    last = len(tree.bins) - 1
    place = (number * 2654435761 >> 12) & last  # Knuth's multiplicative hash
    while tree.bins[place] >= 0 and tree.bins[place] != number:
        place = (place + 1) & last
    return place


@kernel
def connect(
    problem: SearchProblem, tree: SearchTree, heap: list[tuple[float, int]], node: int, to: int
) -> None:
    """Reach the node `to` by turn, drive, turn, if that is free and cheaper than before."""
    limit = tree.cost[to] - tree.cost[node]
    for backwards in (False, True):
        end = pose_of(tree, to)
        if to == TARGET_NODE:
            end = target_from(problem.aim, pose_of(tree, node), backwards)
        moves = connection(pose_of(tree, node), end, backwards)
        cost = cost_of_moves(
            problem.field,
            problem.body,
            pose_of(tree, node),
            moves,
            tree.kind[node],
            problem.margin,
            problem.costs,
            limit,
        )
        if cost < limit:
            limit = cost
            tree.pose[to] = end
            tree.parent[to], tree.cost[to] = node, tree.cost[node] + cost
            tree.move[to] = BACKWARD_CONNECTION if backwards else FORWARD_CONNECTION
            tree.kind[to] = last_kind(moves, tree.kind[node])
            left = 0.0 if to == TARGET_NODE else problem.greed * seconds_left(problem, end)
            heapq.heappush(heap, (tree.cost[to] + left, to))


@kernel
def _cells_across(field: ObstacleField) -> int:
    """Number of bins of position along a side of the window."""
    cells: int = math.ceil(field.distance.shape[0] * FIELD_CELL / POSITION_BIN)
    return cells


@kernel
def expand(
    problem: SearchProblem, tree: SearchTree, heap: list[tuple[float, int]], node: int
) -> None:
    """Add the nodes to which the primitives lead."""
    field, costs = problem.field, problem.costs
    pose = pose_of(tree, node)
    cells = _cells_across(problem.field)
    for k in range(len(problem.primitives)):
        move = move_at(problem.primitives, k)
        x, y, heading = moved(pose[0], pose[1], pose[2], move)
        i, j = math.floor((x - field.x) / POSITION_BIN), math.floor((y - field.y) / POSITION_BIN)
        if not (0 <= i < cells and 0 <= j < cells) or tree.node_count[0] >= len(tree.cost):
            continue
        angle = math.floor(heading / (2.0 * math.pi) * HEADING_BINS) % HEADING_BINS
        place = bin_place(tree, (j * cells + i) * HEADING_BINS + angle)
        there = tree.node_in[place] if tree.bins[place] >= 0 else -1
        cost = tree.cost[node] + change_cost(tree.kind[node], kind_of(move), costs)
        cost += steering_cost(tree.bend[node], curvature(move), costs)
        if there >= 0 and (tree.done[there] or cost + duration(move, costs) >= tree.cost[there]):
            continue
        cost += sweep(field, problem.body, pose, move, problem.margin, costs)
        left = seconds_left(problem, (x, y, heading))
        if cost == math.inf or left == math.inf or (there >= 0 and cost >= tree.cost[there]):
            continue
        if there < 0:
            there = tree.node_count[0]
            tree.node_count[0] += 1
            tree.bins[place] = (j * cells + i) * HEADING_BINS + angle
            tree.node_in[place] = there
        tree.pose[there] = x, y, heading
        tree.cost[there], tree.parent[there] = cost, node
        tree.move[there], tree.kind[there], tree.bend[there] = k, kind_of(move), curvature(move)
        heapq.heappush(heap, (cost + problem.greed * left, there))


@kernel
def search(
    problem: SearchProblem, start: Pose, anchors: FloatArray, max_expansions: int
) -> tuple[FloatArray, bool, int]:
    """The moves from an axle pose to the aim.

    Returns:
        moves, shape (M, 3); whether they reach the aim (otherwise they lead to the pose with the
        least time left); the number of nodes that were expanded.
    """
    capacity = 2 + len(anchors) + max_expansions * 8
    tree = new_tree(start, anchors, capacity)
    heap = [(0.0, 0)]
    expanded, best, least = 0, 0, seconds_left(problem, start)
    limit = max_expansions
    while heap and expanded < limit:
        _, node = heapq.heappop(heap)
        if tree.done[node]:
            continue
        tree.done[node] = True
        expanded += 1
        pose = pose_of(tree, node)
        if node == TARGET_NODE or arrived(problem.aim, pose):
            return moves_to(problem, tree, node), True, expanded
        left = seconds_left(problem, pose)
        if left < least:
            best, least = node, left
        connect(problem, tree, heap, node, TARGET_NODE)
        if limit == max_expansions and tree.cost[TARGET_NODE] < math.inf:
            limit = min(limit, expanded + POLISH_EXPANSIONS)
        if node < 2 + len(anchors) or expanded % 4 == 0:
            for k in range(2, 2 + len(anchors)):
                end = pose_of(tree, k)
                if (
                    not tree.done[k]
                    and math.hypot(end[0] - pose[0], end[1] - pose[1]) < MAX_ANCHOR_DISTANCE
                ):
                    connect(problem, tree, heap, node, k)
        expand(problem, tree, heap, node)
    connected = tree.cost[TARGET_NODE] < math.inf
    return moves_to(problem, tree, TARGET_NODE if connected else best), connected, expanded


@kernel
def moves_to(problem: SearchProblem, tree: SearchTree, node: int) -> FloatArray:
    """The moves from the start to a node, shape (M, 3)."""
    chain = [node]
    while tree.parent[chain[-1]] >= 0:
        chain.append(tree.parent[chain[-1]])
    moves = np.zeros((3 * len(chain), 3))
    n = 0
    for at in chain[-2::-1]:
        if tree.move[at] >= 0:
            moves[n] = problem.primitives[tree.move[at]]
            n += 1
        else:
            start = pose_of(tree, tree.parent[at])
            moves[n : n + 3] = connection(
                start, pose_of(tree, at), tree.move[at] == BACKWARD_CONNECTION
            )
            n += 3
    return moves[:n]
