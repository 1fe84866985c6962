"""The social force model: people are driven by what they want and by what they keep away from.

D. Helbing and P. Molnar, Social force model for pedestrian dynamics, Physical Review E 51 (1995)
4282. The equations have the numbers of that paper; its attractive effects (6) and fluctuations
are left out.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from semnav_env.world.dynamics.body_row import BODY_VX, BODY_VY
from semnav_env.world.dynamics.nearby import MAX_WALL_PIECES, nearest_on_body, walls_near
from semnav_env.world.dynamics.settings import MAX_SPEED_FACTOR
from semnav_features.frames import FloatArray
from semnav_features.kernels.compiling import kernel

RELAXATION_TIME = 0.5
"""Time tau in which a person takes up the desired velocity, seconds, equation (2)."""

V0 = 2.1
"""Strength of the repulsion between people, m^2/s^2: V(b) = V0 exp(-b / sigma), equation (13)."""

SIGMA = 0.3
"""Range of the repulsion between people, metres, equation (13)."""

U0 = 10.0
"""Strength of the repulsion of walls, m^2/s^2: U(r) = U0 exp(-r / R), equation (13)."""

R = 0.1
"""Range of the repulsion of walls, metres. The paper has 0.2: with that the jambs of a door of 0.9
m push a person back harder than the desired velocity pulls."""

STEP_TIME = 2.0
"""Time delta t of the step that another person is expected to take, seconds, equation (4)."""

COS_SIGHT = math.cos(math.radians(100.0))
"""Cosine of half the angle of sight, which is 200 degrees, equation (7)."""

UNSEEN_WEIGHT = 0.5
"""Weight c of what lies outside the angle of sight, equation (7)."""


@kernel
def social_force(
    places: FloatArray,
    velocities: FloatArray,
    wishes: FloatArray,
    radius: float,
    walls: Any,
    leaves: FloatArray,
    body: FloatArray,
    sees_robot: bool,
    seconds: float,
    out: FloatArray,
) -> None:
    """Write the velocities after a time step, equations (9) to (12).

    The nearest point of the robot's footprint repels like somebody who stands a radius behind it
    and moves with the robot. Of the walls, the nearest point counts and the nearest one on the
    other side.

    Args:
        places: positions of people, metres, shape (n, 2).
        velocities: now, m/s, shape (n, 2).
        wishes: desired velocities v0 e, m/s, shape (n, 2).
        radius: radius of a person, metres.
        walls: culled walls as `walls_near` takes them.
        leaves: shape (m, 4).
        body: the robot, see `nearest_on_body`.
        sees_robot: whether the robot counts.
        seconds: length of the step.
        out: shape (n, 2).
    """
    points = np.empty((MAX_WALL_PIECES, 2))
    for i in range(len(places)):
        x, y = places[i]
        force_x = (wishes[i, 0] - velocities[i, 0]) / RELAXATION_TIME  # (2)
        force_y = (wishes[i, 1] - velocities[i, 1]) / RELAXATION_TIME
        for j in range(len(places)):
            if j != i:
                rx, ry = x - places[j, 0], y - places[j, 1]
                fx, fy = _repulsion(rx, ry, velocities[j, 0], velocities[j, 1], wishes[i])
                force_x, force_y = force_x + fx, force_y + fy
        if sees_robot:
            near_x, near_y = nearest_on_body(x, y, body)
            distance = math.hypot(x - near_x, y - near_y)
            longer = (distance + radius) / max(distance, 1e-6)
            rx, ry = longer * (x - near_x), longer * (y - near_y)
            fx, fy = _repulsion(rx, ry, body[BODY_VX], body[BODY_VY], wishes[i])
            force_x, force_y = force_x + fx, force_y + fy
        count = walls_near(x, y, walls, leaves, points)
        fx, fy = _wall_repulsion(x, y, points, count)
        vx = velocities[i, 0] + seconds * (force_x + fx)  # (10)
        vy = velocities[i, 1] + seconds * (force_y + fy)
        limit = MAX_SPEED_FACTOR * math.hypot(wishes[i, 0], wishes[i, 1])
        speed = math.hypot(vx, vy)
        share = limit / speed if speed > limit else 1.0  # (11), (12)
        out[i, 0], out[i, 1] = share * vx, share * vy


@kernel
def _repulsion(rx: float, ry: float, vx: float, vy: float, wish: FloatArray) -> tuple[float, float]:
    """Force of somebody at -r, moving with v, on somebody with that wish: (3), (4), (7), (8).

    The equipotentials are ellipses with the other's next step s = v STEP as the line between the
    foci; b is their semi-minor axis.
    """
    sx, sy = STEP_TIME * vx, STEP_TIME * vy
    near, far = math.hypot(rx, ry), math.hypot(rx - sx, ry - sy)
    if near < 1e-6:
        return 0.0, 0.0
    total = near + far
    b = 0.5 * math.sqrt(max(total * total - sx * sx - sy * sy, 1e-6))
    away_x, away_y = rx / near, ry / near
    if far > 1e-6:
        away_x, away_y = away_x + (rx - sx) / far, away_y + (ry - sy) / far
    strength = V0 / SIGMA * math.exp(-b / SIGMA) * total / (4.0 * b)
    fx, fy = strength * away_x, strength * away_y
    ahead = -(fx * wish[0] + fy * wish[1])
    seen = ahead >= COS_SIGHT * math.hypot(fx, fy) * math.hypot(wish[0], wish[1])
    weight = 1.0 if seen else UNSEEN_WEIGHT
    return weight * fx, weight * fy


@kernel
def _wall_repulsion(x: float, y: float, points: FloatArray, count: int) -> tuple[float, float]:
    """Force of the nearest wall and of the nearest one on the other side, (5)."""
    fx = fy = first_x = first_y = 0.0
    for side in range(2):
        best, best_x, best_y = np.inf, 0.0, 0.0
        for k in range(count):
            dx, dy = x - points[k, 0], y - points[k, 1]
            distance = math.hypot(dx, dy)
            if distance < best and (side == 0 or dx * first_x + dy * first_y < 0.0):
                best, best_x, best_y = distance, dx, dy
        if best < np.inf and best > 1e-6:
            strength = U0 / R * math.exp(-best / R) / best
            fx, fy = fx + strength * best_x, fy + strength * best_y
            first_x, first_y = best_x, best_y
    return fx, fy
