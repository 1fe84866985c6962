"""Where a search is to lead, and the test whether it has arrived."""

from __future__ import annotations

import math
from typing import NamedTuple

from semnav_agents.planning.connect import wrapped
from semnav_agents.planning.motion import move_at, moved
from semnav_features.frames import FloatArray, Pose, wrap_angle
from semnav_features.kernels.compiling import kernel
from semnav_features.kernels.exact_hypot import exact_hypot


class Aim(NamedTuple):
    """Where a search is to lead the robot's centre.

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


@kernel
def is_outdated(planned: Aim, wanted: Aim) -> bool:
    """Whether a path to one aim may end where another one is not reached.

    The aims lie apart by more than half a tolerance, or the second one asks for more: a lookout
    point may become the place at which to stop.
    """
    away = exact_hypot(planned.x - wanted.x, planned.y - wanted.y)
    near = wanted.position_tolerance
    if away > 0.5 * near or near < planned.position_tolerance:
        return True
    if wanted.any_heading:
        return False
    turned = abs(wrap_angle(planned.heading - wanted.heading))
    return planned.any_heading or turned > 0.5 * wanted.heading_tolerance


@kernel
def arrived(aim: Aim, pose: Pose) -> bool:
    """Whether an axle pose meets the aim's tolerances."""
    x, y = pose[0] - aim.axle * math.cos(pose[2]), pose[1] - aim.axle * math.sin(pose[2])
    if math.hypot(aim.x - x, aim.y - y) > aim.position_tolerance:
        return False
    return aim.any_heading or abs(wrapped(aim.heading - pose[2])) <= aim.heading_tolerance


@kernel
def trimmed(aim: Aim, start: Pose, moves: FloatArray) -> FloatArray:
    """The moves cut off well inside an aim with any heading; other aims keep all moves."""
    if not aim.any_heading:
        return moves
    near = 0.6 * aim.position_tolerance
    region = Aim(aim.x, aim.y, aim.heading, near, aim.heading_tolerance, True, aim.axle)
    pose = start
    for k in range(len(moves)):
        move = move_at(moves, k)
        parts = max(1, math.ceil(math.hypot(move.forward, move.left) / 0.1))
        for part in range(1, parts + 1):
            share = part / parts
            if arrived(region, moved(pose[0], pose[1], pose[2], move, share)):
                kept = moves[: k + 1].copy()
                kept[k] *= share
                return kept
        pose = moved(pose[0], pose[1], pose[2], move)
    return moves


@kernel
def target_from(aim: Aim, pose: Pose, backwards: bool) -> Pose:
    """The axle pose to connect to; with any heading, the one that is approached straight on."""
    heading = aim.heading
    if aim.any_heading:
        heading = math.atan2(aim.y - pose[1], aim.x - pose[0]) + (math.pi if backwards else 0.0)
    return aim.x + aim.axle * math.cos(heading), aim.y + aim.axle * math.sin(heading), heading
