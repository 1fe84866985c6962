"""Clouds of a door, drawn without a simulator."""

from __future__ import annotations

import math

import numpy as np

from semnav_features.clouds import PointCloud
from semnav_features.elements import Door

DOOR = Door((2.0, 0.45), (2.0, -0.45))
"""Two metres ahead; the robot is to the left of start-end."""


def door_cloud(
    rng: np.random.Generator,
    width: float = 0.9,
    sigma: float = 0.005,
    jambs: tuple[bool, bool] = (True, True),
) -> PointCloud:
    """A wall with a door two metres ahead, its frame, the floor, and the room behind.

    The frame is 0.10 m wide and 0.12 m deep, as high as the cameras see: 1 m. Where a jamb is left
    out, nothing is seen of the wall on its side.
    """
    half, parts = 0.5 * width, []
    for side, shown in zip((1.0, -1.0), jambs, strict=True):
        if shown:
            wall = rng.uniform((half + 0.1, 0.0), (half + 0.8, 1.0), (600, 2))
            face = rng.uniform((half, 0.0), (half + 0.1, 1.0), (200, 2))
            reveal = rng.uniform((-0.06, 0.0), (0.06, 1.0), (200, 2))
            parts.append(np.column_stack((np.full(600, 2.0), side * wall[:, 0], wall[:, 1])))
            parts.append(np.column_stack((np.full(200, 1.94), side * face[:, 0], face[:, 1])))
            parts.append(
                np.column_stack((2.0 + reveal[:, 0], np.full(200, side * half), reveal[:, 1]))
            )
    across, high = rng.uniform((-2.0, 0.0), (2.0, 1.2), (3000, 2)).T
    behind = np.column_stack((np.full(3000, 4.0), across, high))
    crossing = np.abs(across / 2.0) < half - 0.02  # of the line from the origin to there
    floor = rng.uniform((0.3, -1.0), (1.9, 1.0), (800, 2))
    parts += [behind[crossing], np.column_stack((floor, np.zeros(800)))]
    points = np.concatenate(parts)
    return PointCloud(points + rng.normal(0.0, sigma, points.shape))


def turned(points: np.ndarray, angle: float, shift: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """Points, (n, 2) or (n, 3), turned about the z axis and moved."""
    c, s = math.cos(angle), math.sin(angle)
    moved = np.array(points, dtype=float)
    moved[:, :2] = points[:, :2] @ np.array([[c, s], [-s, c]]) + shift
    return moved


def turned_door(door: Door, angle: float, shift: tuple[float, float] = (0.0, 0.0)) -> Door:
    start, end = turned(np.array([door.start, door.end]), angle, shift).tolist()
    return Door((start[0], start[1]), (end[0], end[1]))
