"""Numba kernels that tell what looks of a detector show and what they cost."""

from __future__ import annotations

import math

import numpy as np

from semnav_agents.searching.outlines import Mask, crossed
from semnav_features.frames import FloatArray, Pose
from semnav_features.kernels.compiling import kernel

LOOK_RAYS = 120
"""Rays that tell which cells a look shows, a degree apart."""


@kernel
def fits(
    pose: Pose,
    half: tuple[float, float],
    room: FloatArray,
    west: float,
    south: float,
    spacing: float,
) -> bool:
    """Whether a body is free at a pose; its corners may touch.

    The middles of the circles of its width at its middle and its ends must be farther than half its
    width from everything solid.
    """
    rows, columns = room.shape
    for end in range(-1, 2):
        along = end * (half[0] - half[1])
        column = round((pose[0] + along * math.cos(pose[2]) - west) / spacing)
        row = round((pose[1] + along * math.sin(pose[2]) - south) / spacing)
        if not (0 <= row < rows and 0 <= column < columns) or room[row, column] <= half[1]:
            return False
    return True


@kernel
def seconds_to_look(
    eyes: FloatArray,
    headings: FloatArray,
    back: Pose,
    half: tuple[float, float],
    seconds: FloatArray,
    room: FloatArray,
    west: float,
    south: float,
    spacing: float,
) -> FloatArray:
    """Seconds that a look of the detector from a place in a direction costs, shape (n, headings).

    Infinite where the body does not fit.

    Args:
        eyes: places of the detector, shape (n, 2).
        headings: of the detector, radians.
        back: pose of the robot in the frame of the detector.
        half: half of length and width of the body, metres.
        seconds: that a look from each cell costs.
        room: distance of each cell from everything solid, metres.
        west: x of the first column.
        south: y of the first row.
        spacing: of the cells, metres.
    """
    rows, columns = seconds.shape
    costs = np.full((len(eyes), len(headings)), np.inf)
    for j in range(len(headings)):
        c, s = math.cos(headings[j]), math.sin(headings[j])
        for k in range(len(eyes)):
            x, y = eyes[k, 0] + c * back[0] - s * back[1], eyes[k, 1] + s * back[0] + c * back[1]
            column, row = round((x - west) / spacing), round((y - south) / spacing)
            if not (0 <= row < rows and 0 <= column < columns) or seconds[row, column] == np.inf:
                continue
            if fits((x, y, headings[j] + back[2]), half, room, west, south, spacing):
                costs[k, j] = seconds[row, column]
    return costs


@kernel
def ray_gains(
    places: FloatArray,
    wanted: Mask,
    outline: Mask,
    near: Mask,
    west: float,
    south: float,
    spacing: float,
    rays: int,
    view_range: float,
) -> FloatArray:
    """Area of wanted cells that rays from some places show, m^2, shape (places, rays).

    A ray stands for its sector of the circle: at a distance r a step dr shows r dr dphi.
    """
    gains = np.zeros((len(places), rays))
    rows, columns = wanted.shape
    for k in range(len(places)):
        for j in range(rays):
            angle = 2.0 * math.pi * j / rays
            dx, dy = math.cos(angle), math.sin(angle)
            for i in range(1, int(view_range / spacing)):
                away = i * spacing
                x = (places[k, 0] + away * dx - west) / spacing
                y = (places[k, 1] + away * dy - south) / spacing
                column, row = round(x), round(y)
                if not (0 <= row < rows and 0 <= column < columns):
                    break
                if near[row, column] and crossed(outline, x, y, dx, dy):
                    break
                if wanted[row, column]:
                    gains[k, j] += away * spacing * 2.0 * math.pi / rays
    return gains


@kernel
def mark_wanted(
    eye: Pose,
    half: float,
    wanted: Mask,
    outline: Mask,
    near: Mask,
    west: float,
    south: float,
    spacing: float,
    view_range: float,
    seen: Mask,
) -> None:
    """Mark the wanted cells that a look shows, up to an angle `half` to each side of it."""
    rows, columns = wanted.shape
    for j in range(LOOK_RAYS):
        angle = eye[2] + half * (2.0 * j / (LOOK_RAYS - 1) - 1.0)
        dx, dy = math.cos(angle), math.sin(angle)
        for i in range(1, int(view_range / spacing)):
            x = (eye[0] + i * spacing * dx - west) / spacing
            y = (eye[1] + i * spacing * dy - south) / spacing
            column, row = round(x), round(y)
            if not (0 <= row < rows and 0 <= column < columns):
                break
            if near[row, column] and crossed(outline, x, y, dx, dy):
                break
            if wanted[row, column]:
                seen[row, column] = True
