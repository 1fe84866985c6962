"""Optimal reciprocal collision avoidance (ORCA): each of two people does half of the evasion.

J. van den Berg, S. J. Guy, M. Lin and D. Manocha, Reciprocal n-body collision avoidance, Robotics
Research, Springer Tracts in Advanced Robotics 70 (2011) 3. A half-plane of velocities is kept as
(normal_x, normal_y, offset): allowed is normal . v >= offset.
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

PEOPLE_HORIZON = 2.5
"""Time for which no two people will meet, seconds; tau in the paper."""

WALL_HORIZON = 0.5
"""Time for which a person will meet no wall, seconds; shorter than for people, or nobody would walk
through a door."""

BISECTIONS = 16
"""Bisections that find how far half-planes must be moved back where they leave no velocity: 16 find
it to a 65,000th of the interval."""


@kernel
def orca(
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
    """Write the velocities for a time step: the allowed ones nearest to those desired (5.1).

    The robot does not evade: people evade it alone. A wall forbids velocities that would bring its
    nearest point within a radius in `WALL_HORIZON`. Where no velocity is left, the half-planes of
    people and the robot, not those of walls, are moved back evenly until one is (5.3).

    The arguments are those of `social_force`.
    """
    points = np.empty((MAX_WALL_PIECES, 2))
    planes = np.empty((MAX_WALL_PIECES + len(places) + 1, 3))
    for i in range(len(places)):
        x, y = places[i]
        hard = count = walls_near(x, y, walls, leaves, points)
        for k in range(hard):
            _static_half_plane(x - points[k, 0], y - points[k, 1], radius, WALL_HORIZON, planes[k])
        if sees_robot:
            near_x, near_y = nearest_on_body(x, y, body)
            _static_half_plane(x - near_x, y - near_y, radius, PEOPLE_HORIZON, planes[count])
            planes[count, 2] += planes[count, 0] * body[BODY_VX] + planes[count, 1] * body[BODY_VY]
            count += 1
        for j in range(len(places)):
            if j != i:
                between = places[j] - places[i]
                relative = velocities[i] - velocities[j]
                _reciprocal_half_plane(
                    between, relative, velocities[i], 2.0 * radius, seconds, planes[count]
                )
                count += 1
        limit = MAX_SPEED_FACTOR * math.hypot(wishes[i, 0], wishes[i, 1])
        _least_violating(planes[:count], hard, wishes[i], limit, out[i])


@kernel
def _static_half_plane(
    dx: float, dy: float, radius: float, horizon: float, plane: FloatArray
) -> None:
    """Write the half-plane of a thing at rest whose nearest point is at -d from a person."""
    distance = max(math.hypot(dx, dy), 1e-9)
    plane[0], plane[1] = dx / distance, dy / distance
    plane[2] = -max(distance - radius, 0.0) / horizon


@kernel
def _reciprocal_half_plane(
    between: FloatArray,
    relative: FloatArray,
    velocity: FloatArray,
    reach: float,
    seconds: float,
    plane: FloatArray,
) -> None:
    """Write the half-plane ORCA of A and B (section 4): half of u, the least change out of VO.

    VO is the cone of the disc at x = p_B - p_A with the sum of the radii, cut off by
    the disc shrunk by the horizon; u leads from the relative velocity to the nearest point of its
    border, where the outward normal is n.
    """
    px, py, vx, vy = between[0], between[1], relative[0], relative[1]
    distance = math.hypot(px, py)
    horizon = PEOPLE_HORIZON if distance > reach else seconds
    wx, wy = vx - px / horizon, vy - py / horizon
    w = math.hypot(wx, wy)
    towards = wx * px + wy * py
    if distance <= reach or (towards < 0.0 and towards * towards > reach * reach * w * w):
        w = max(w, 1e-9)
        nx, ny = wx / w, wy / w
        gap = reach / horizon - w
    else:
        sine = reach / distance
        cosine = math.sqrt(1.0 - sine * sine)
        side = 1.0 if px * wy - py * wx > 0.0 else -1.0
        leg_x = (px * cosine - side * py * sine) / distance
        leg_y = (py * cosine + side * px * sine) / distance
        nx, ny = -side * leg_y, side * leg_x
        gap = -(vx * nx + vy * ny)
    plane[0], plane[1] = nx, ny
    plane[2] = nx * velocity[0] + ny * velocity[1] + 0.5 * gap


@kernel
def _least_violating(
    planes: FloatArray, hard: int, wish: FloatArray, limit: float, out: FloatArray
) -> None:
    """Write the allowed velocity nearest to the wish, or the one that violates the least (5.3)."""
    if nearest_allowed(planes, hard, 0.0, wish, limit, out):
        return
    low, high = 0.0, max(planes[:, 2].max(), 0.0) + limit
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        if nearest_allowed(planes, hard, middle, wish, limit, out):
            high = middle
        else:
            low = middle
    if not nearest_allowed(planes, hard, high, wish, limit, out):
        out[0] = out[1] = 0.0


@kernel
def nearest_allowed(
    planes: FloatArray, hard: int, slack: float, wish: FloatArray, limit: float, out: FloatArray
) -> bool:
    """The velocity within half-planes and speed limit that is nearest to the wish.

    One half-plane after the other is taken in; where it rules the best velocity out, the new best
    lies on its border (the incremental algorithm of de Berg et al., Computational Geometry,
    section 4.3, for a quadratic goal).

    Args:
        planes: shape (k, 3).
        hard: the first so many are not moved.
        slack: speed by which the others are moved back, m/s.
        wish: m/s.
        limit: largest speed, m/s.
        out: the velocity; of no meaning if there is none.

    Returns:
        Whether there is one.
    """
    speed = math.hypot(wish[0], wish[1])
    share = limit / speed if speed > limit else 1.0
    out[0], out[1] = share * wish[0], share * wish[1]
    for i in range(len(planes)):
        nx, ny = planes[i, 0], planes[i, 1]
        offset = planes[i, 2] - (slack if i >= hard else 0.0)
        if nx * out[0] + ny * out[1] >= offset - 1e-9:
            continue
        squared = limit * limit - offset * offset
        if squared < 0.0:
            return False
        high = math.sqrt(squared)
        low = -high
        for j in range(i):
            slope = planes[j, 1] * nx - planes[j, 0] * ny
            rest = planes[j, 2] - (slack if j >= hard else 0.0)
            rest -= offset * (planes[j, 0] * nx + planes[j, 1] * ny)
            if abs(slope) < 1e-12:
                if rest > 1e-9:
                    return False
            elif slope > 0.0:
                low = max(low, rest / slope)
            else:
                high = min(high, rest / slope)
        if low > high:
            return False
        along = min(max(wish[1] * nx - wish[0] * ny, low), high)
        out[0], out[1] = offset * nx - along * ny, offset * ny + along * nx
    return True
