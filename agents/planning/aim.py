"""Where a search is to lead, and when it is there."""

from __future__ import annotations

import math
from typing import NamedTuple

from numba import njit

from semnav_env.agents.planning.connect import wrapped
from semnav_env.agents.planning.motion import Triple, moved
from semnav_env.features.frames import FloatArray


class Aim(NamedTuple):
    """Where the robot's centre is to go.

    Attributes:
        x: metres.
        y: metres.
        heading: radians; any if `any_heading`.
        position_tolerance: metres.
        heading_tolerance: radians.
        any_heading: whether the heading does not matter.
        axle: x of the axle in the robot frame, metres.
    """

    x: float
    y: float
    heading: float
    position_tolerance: float
    heading_tolerance: float
    any_heading: bool
    axle: float


@njit(cache=True)
def arrived(aim: Aim, pose: Triple) -> bool:
    """Whether an axle pose meets the aim's tolerances."""
    x, y = pose[0] - aim.axle * math.cos(pose[2]), pose[1] - aim.axle * math.sin(pose[2])
    if math.hypot(aim.x - x, aim.y - y) > aim.position_tolerance:
        return False
    return aim.any_heading or abs(wrapped(aim.heading - pose[2])) <= aim.heading_tolerance


@njit(cache=True)
def trimmed(aim: Aim, start: Triple, moves: FloatArray) -> FloatArray:
    """The moves up to where a region, an aim with any heading, is entered by a good part."""
    if not aim.any_heading:
        return moves
    near = 0.6 * aim.position_tolerance
    region = Aim(aim.x, aim.y, aim.heading, near, aim.heading_tolerance, True, aim.axle)
    pose = start
    for k in range(len(moves)):
        move = (moves[k, 0], moves[k, 1], moves[k, 2])
        parts = max(1, math.ceil(math.hypot(move[0], move[1]) / 0.1))
        for part in range(1, parts + 1):
            share = part / parts
            if arrived(region, moved(pose[0], pose[1], pose[2], move, share)):
                kept = moves[: k + 1].copy()
                kept[k] *= share
                return kept
        pose = moved(pose[0], pose[1], pose[2], move)
    return moves


@njit(cache=True)
def target_from(aim: Aim, pose: Triple, backwards: bool) -> Triple:
    """The axle pose to connect to; one that is approached straight on if the heading is free."""
    heading = aim.heading
    if aim.any_heading:
        heading = math.atan2(aim.y - pose[1], aim.x - pose[0]) + (math.pi if backwards else 0.0)
    return aim.x + aim.axle * math.cos(heading), aim.y + aim.axle * math.sin(heading), heading
