"""Turns desired velocities into steps that lead into nobody and nothing."""

from __future__ import annotations

import math
from typing import Any

from semnav_env.world.dynamics.nearby import nearest_on_body, nearest_wall
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

MAX_DEFLECTIONS = 4
"""Number of times that a step is bent along what is in its way before it is given up."""

OVERLAP_TOLERANCE = 1e-6
"""Depth by which bodies may overlap, metres: rounding errors."""


@kernel
def walk(
    places: FloatArray,
    velocities: FloatArray,
    radius: float,
    walls: Any,
    leaves: FloatArray,
    body: FloatArray,
    guard: float,
    touch: float,
    seconds: float,
) -> None:
    """Move people one after the other and write the velocities that they had.

    A step that would lead into a wall, a leaf or somebody is bent along it; one that cannot be
    bent is not taken. Nobody within `guard` of the robot steps towards it. A person within `touch`
    of it steps only straight away from it: someone walking along a robot in contact would drag it.

    Args:
        places: updated; metres, shape (n, 2).
        velocities: the desired ones; updated to the ones had, m/s, shape (n, 2).
        radius: radius of a person, metres.
        walls: `Culling` as `walls_near` takes it.
        leaves: segments that move, shape (m, 4).
        body: the robot, see `nearest_on_body`.
        guard: distance, metres, larger than robot and person can come nearer in a step, so that
            only the robot can make them touch.
        touch: distance that the robot can go in this step, metres.
        seconds: length of the step.
    """
    for i in range(len(places)):
        x, y = places[i]
        near_x, near_y = nearest_on_body(x, y, body)
        gap = math.hypot(x - near_x, y - near_y) - radius
        vx, vy = velocities[i, 0], velocities[i, 1]
        if gap < guard:
            vx, vy = _off_the_robot(x - near_x, y - near_y, vx, vy, gap < touch)
        step_x, step_y = seconds * vx, seconds * vy
        longest = math.hypot(step_x, step_y) + OVERLAP_TOLERANCE
        depth = 0.0
        for _ in range(MAX_DEFLECTIONS):
            depth, push_x, push_y = _worst(x + step_x, y + step_y, i, places, radius, walls, leaves)
            if depth <= OVERLAP_TOLERANCE or gap < touch:
                break
            step_x, step_y = step_x + depth * push_x, step_y + depth * push_y
        too_long = math.hypot(step_x, step_y) > longest
        nearer = gap < guard and _nears_robot(x, y, step_x, step_y, radius + gap, body)
        if depth > OVERLAP_TOLERANCE or too_long or nearer:
            step_x = step_y = 0.0
        places[i, 0], places[i, 1] = x + step_x, y + step_y
        velocities[i, 0], velocities[i, 1] = step_x / seconds, step_y / seconds


@kernel
def _off_the_robot(
    dx: float, dy: float, vx: float, vy: float, straight: bool
) -> tuple[float, float]:
    """The part of a velocity that does not lead towards a robot at -d, or straight away from it."""
    squared = max(dx * dx + dy * dy, 1e-12)
    away = (vx * dx + vy * dy) / squared
    if straight:
        return max(away, 0.0) * dx, max(away, 0.0) * dy
    return vx - min(away, 0.0) * dx, vy - min(away, 0.0) * dy


@kernel
def _nears_robot(
    x: float, y: float, step_x: float, step_y: float, before: float, body: FloatArray
) -> bool:
    """Whether a step leads nearer to the robot than `before`."""
    near_x, near_y = nearest_on_body(x + step_x, y + step_y, body)
    return math.hypot(x + step_x - near_x, y + step_y - near_y) < before - 1e-9


@kernel
def _worst(
    x: float,
    y: float,
    i: int,
    places: FloatArray,
    radius: float,
    walls: Any,
    leaves: FloatArray,
) -> tuple[float, float, float]:
    """How deep person i at (x, y) would be in something, and the direction out of it."""
    wall_x, wall_y = nearest_wall(x, y, walls, leaves)
    dx, dy = x - wall_x, y - wall_y
    distance = max(math.hypot(dx, dy), 1e-9)
    worst, out_x, out_y = radius - distance, dx / distance, dy / distance
    for j in range(len(places)):
        dx, dy = x - places[j, 0], y - places[j, 1]
        distance = max(math.hypot(dx, dy), 1e-9)
        if j != i and 2.0 * radius - distance > worst:
            worst, out_x, out_y = 2.0 * radius - distance, dx / distance, dy / distance
    return worst, out_x, out_y
