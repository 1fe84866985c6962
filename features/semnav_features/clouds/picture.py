"""A picture of a cloud with the door that was found in it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import numpy as np

from semnav_features.clouds.detected_door import DetectedDoor, frame_of
from semnav_features.clouds.point_cloud import PointCloud
from semnav_features.elements import Door
from semnav_features.frames import FloatArray, Point, points_to_local
from semnav_features.plot import check_suffix
from semnav_features.writing import replacing

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_POINT, _FOUND, _EXPECTED, _INFERRED = "0.55", "#d62728", "#7b2fa0", "#ff9896"

DEPTH = 0.4
"""Largest distance from the wall of the points in the front view, metres."""

HEIGHTS = 1.2, 2.1
"""Least and largest height that the front view shows, metres: as much as the cloud has."""


def draw_front(ax: Axes, cloud: PointCloud, expected: Door, found: DetectedDoor | None) -> None:
    """Draw the door from the front, as Mes 2021 does in figures 8.1 to 8.4.

    Found jambs are red (pale if placed by the width of the door), and the expected door is purple.

    Args:
        ax: where to draw.
        cloud: robot frame.
        expected: where the door should be.
        found: what a detector found.
    """
    side = np.sign(points_to_local(frame_of(expected), np.zeros((1, 2)))[0, 1])
    door = expected if side > 0 else Door(expected.end, expected.start)
    frame = frame_of(door)
    along, across = points_to_local(frame, cloud.points_robot[:, :2]).T
    near = (np.abs(across) < DEPTH) & (np.abs(along) < 1.3)
    ax.plot(-along[near], cloud.points_robot[near, 2], ".", color=_POINT, markersize=1.0)

    def post(jamb: Point, colour: str, style: str, width: float) -> None:
        x = -float(points_to_local(frame, np.array([jamb]))[0, 0])
        ax.plot((x, x), (0.0, 1.0), style, color=colour, linewidth=width)

    for jamb in (expected.start, expected.end):
        post(jamb, _EXPECTED, ":", 1.5)
    if found is not None:
        for jamb, seen in ((found.start, found.start_seen), (found.end, found.end_seen)):
            post(jamb, _FOUND if seen else _INFERRED, "-", 3.0)
    top = np.clip(cloud.points_robot[near, 2].max(initial=0.0), *HEIGHTS)
    ax.set(xlim=(-1.3, 1.3), ylim=(-0.1, top), aspect="equal")
    ax.tick_params(labelsize=7)


def draw_above(ax: Axes, cloud: PointCloud, found: DetectedDoor | None) -> None:
    """Draw cloud, robot and jambs from above: x to the right, y up, coloured by height."""
    points: FloatArray = cloud.points_robot[cloud.points_robot[:, 2] > 0.1]
    order = np.argsort(points[:, 2])
    x, y, z = points[order].T
    ax.scatter(x, y, c=z, s=0.4, cmap="viridis", vmin=0.0, vmax=2.0)
    ax.plot(0, 0, marker=(3, 0, -90), markersize=10, color="black")
    if found is not None:
        for jamb, seen in ((found.start, found.start_seen), (found.end, found.end_seen)):
            ax.plot(*jamb, "o", color=_FOUND if seen else _INFERRED, markersize=6)
    ax.set(xlim=(-2.5, 2.5), ylim=(-2.5, 2.5), aspect="equal")
    ax.tick_params(labelsize=7)


def save_cloud(
    path: str | os.PathLike[str], cloud: PointCloud, expected: Door, found: DetectedDoor | None
) -> None:
    """Write a picture of a cloud from above and from the front of a door.

    Args:
        path: the file to write; its suffix chooses PNG, PDF or SVG.
        cloud: robot frame.
        expected: where the door should be.
        found: what a detector found.

    Raises:
        ValueError: a suffix that is not a picture's.
    """
    from matplotlib.figure import Figure

    check_suffix(path)
    figure = Figure(figsize=(9.0, 4.2), layout="constrained")
    above, front = figure.subplots(1, 2)
    draw_above(above, cloud, found)
    draw_front(front, cloud, expected, found)
    with replacing(path) as part:
        figure.savefig(part, dpi=110)
