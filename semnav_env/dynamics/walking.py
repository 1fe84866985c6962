"""From a velocity that somebody wants to a step that leads into nobody and nothing."""

from __future__ import annotations

import math
from typing import Any

from numba import njit

from semnav_env.dynamics.nearby import nearest_wall, on_body
from semnav_env.features.frames import FloatArray

ROUNDS = 4
"""How often a step is bent before it is given up."""

TIGHT = 1e-6
"""By which bodies may overlap, metres: rounding."""


@njit(cache=True, error_model="numpy")
def walk(
    places: FloatArray,
    velocities: FloatArray,
    radius: float,
    walls: Any,
    leaves: FloatArray,
    body: FloatArray,
    guard: float,
    seconds: float,
) -> None:
    """Move people, one after the other, and note how fast they really went.

    A step that would lead into a wall, a leaf or somebody is bent along it; one that cannot be
    bent is not taken. Nobody within `guard` of the robot steps towards it.

    Args:
        places: updated; metres, shape (n, 2).
        velocities: wanted; updated to those had, m/s, shape (n, 2).
        radius: of a person, metres.
        walls: as `walls_near` takes them.
        leaves: shape (m, 4).
        body: of the robot, see `on_body`.
        guard: metres; more than what robot and person can come nearer in a step, so that only the
            robot can make them touch.
        seconds: length of the step.
    """
    for i in range(len(places)):
        x, y = places[i]
        reach = radius + guard
        vx, vy = _off_the_robot(x, y, velocities[i, 0], velocities[i, 1], reach, body)
        step_x, step_y = seconds * vx, seconds * vy
        longest = math.hypot(step_x, step_y) + TIGHT
        for _ in range(ROUNDS):
            depth, push_x, push_y = _worst(x + step_x, y + step_y, i, places, radius, walls, leaves)
            if depth <= TIGHT:
                break
            step_x, step_y = step_x + depth * push_x, step_y + depth * push_y
        too_long = math.hypot(step_x, step_y) > longest
        if depth > TIGHT or too_long or _nears_robot(x, y, step_x, step_y, reach, body):
            step_x = step_y = 0.0
        places[i, 0], places[i, 1] = x + step_x, y + step_y
        velocities[i, 0], velocities[i, 1] = step_x / seconds, step_y / seconds


@njit(cache=True, error_model="numpy")
def _off_the_robot(
    x: float, y: float, vx: float, vy: float, reach: float, body: FloatArray
) -> tuple[float, float]:
    """The velocity without its part towards the robot, if that is near."""
    near_x, near_y = on_body(x, y, body)
    dx, dy = x - near_x, y - near_y
    distance = math.hypot(dx, dy)
    if distance > reach or distance < 1e-9:
        return vx, vy
    towards = min((vx * dx + vy * dy) / (distance * distance), 0.0)
    return vx - towards * dx, vy - towards * dy


@njit(cache=True, error_model="numpy")
def _nears_robot(
    x: float, y: float, step_x: float, step_y: float, reach: float, body: FloatArray
) -> bool:
    """Whether a step that was bent brings somebody nearer to a near robot."""
    near_x, near_y = on_body(x, y, body)
    before = math.hypot(x - near_x, y - near_y)
    near_x, near_y = on_body(x + step_x, y + step_y, body)
    after = math.hypot(x + step_x - near_x, y + step_y - near_y)
    return after < before - 1e-9 and after < reach


@njit(cache=True, error_model="numpy")
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
