"""Pictures of scans and scenes, in the frame of the scan: x to the right, y up."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from semnav_features.frames import FloatArray, Point, middle_of
from semnav_features.scan import Scan
from semnav_features.scene import Arc, CornerKind, Scene, Wall
from semnav_features.writing import replacing

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_POINTS, _WALL, _DOOR, _CORRIDOR, _ROBOT = "black", "#5b9bd5", "#1a9e3f", "#8e3bb8", "#d62728"
_ARC = "#e0a100"
_CORNERS: dict[CornerKind, dict[str, Any]] = {
    CornerKind.OUTER: dict(marker="^", markerfacecolor="#e8590c", label="outer corner"),
    CornerKind.INNER: dict(marker="s", markerfacecolor="#1c7ed6", label="inner corner"),
    CornerKind.POTENTIAL: dict(marker="o", markerfacecolor="none", label="potential corner"),
}
_MARGIN = 0.6
_TICK = 0.2


def draw_scene(ax: Axes, scan: Scan, scene: Scene) -> None:
    """Draw a scan and its scene, with the scanner at the origin.

    A wall's tick stands on its free side, to the left of its direction; a door's number is its
    width in metres. A cross marks the centre of an arc.

    Args:
        ax: where to draw; its limits are set to show the scene.
        scan: the scan, drawn as points.
        scene: in the frame of the scan, metres.
    """
    points = _points(scan)
    ax.plot(*points.T, ".", color=_POINTS, markersize=1.5, zorder=2.5, label="beams")
    _draw_walls(ax, scene)
    _draw_arcs(ax, scene)
    _draw_corridors(ax, scene)
    _draw_doors(ax, scene)
    for kind, style in _CORNERS.items():
        corners = np.array([c.point for c in scene.corners if c.kind is kind]).reshape(-1, 2)
        ax.plot(*corners.T, linestyle="", markersize=5, markeredgecolor="0.15", **style)
    ax.plot(0, 0, marker=(3, 0, -90), markersize=9, color=_ROBOT, linestyle="", label="scanner")
    _frame(ax, points, scene)


def save_page(
    path: str | os.PathLike[str], scenes: Sequence[tuple[str, Scan, Scene]], columns: int = 3
) -> None:
    """Write a page of scans with their scenes; the suffix of the path chooses PNG, PDF or SVG.

    Args:
        path: the file to write.
        scenes: (title, scan, scene) of each panel, at least one; 6 to 12 are legible.
        columns: panels in a row.

    Raises:
        ValueError: nothing to draw, or a suffix that is not a picture's.
    """
    from matplotlib.figure import Figure

    check_suffix(path)
    if not scenes:
        raise ValueError("no scans to draw; a page needs at least one")
    columns = min(columns, len(scenes))
    rows = math.ceil(len(scenes) / columns)
    figure = Figure(figsize=(4.6 * columns, 4.2 * rows + 0.5), layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False).ravel()
    for ax, (title, scan, scene) in zip(axes, scenes, strict=False):
        draw_scene(ax, scan, scene)
        ax.set_title(title, fontsize=10)
    for ax in axes[len(scenes) :]:
        ax.set_axis_off()
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(
        handles, labels, loc="outside lower center", ncols=min(5, 2 * columns), fontsize=9
    )
    with replacing(path) as part:
        figure.savefig(part, dpi=110)


def check_suffix(path: str | os.PathLike[str]) -> None:
    """Refuse a path whose suffix is not that of a picture, or that is a folder.

    Raises:
        ValueError: names the path, and the suffixes that would do.
    """
    suffix = os.path.splitext(path)[1].lower()
    if suffix not in (".png", ".pdf", ".svg"):
        raise ValueError(
            f"{os.fspath(path)!r} is no picture's name; it must end in .png, .pdf or .svg"
        )
    if os.path.isdir(path):
        raise ValueError(f"{os.fspath(path)!r} is a folder; give the name of a picture")


def _points(scan: Scan) -> FloatArray:
    ranges, angles = scan.ranges[scan.valid], scan.angles[scan.valid]
    return np.stack((ranges * np.cos(angles), ranges * np.sin(angles)), axis=-1)


def _draw_walls(ax: Axes, scene: Scene) -> None:
    ends = [(wall.start, wall.end) for wall in scene.walls]
    ax.plot(*_polyline(ends), color=_WALL, linewidth=2.5, label="wall (tick: free side)")
    ax.plot(*_polyline([_tick(wall) for wall in scene.walls]), color=_WALL, linewidth=1)


def _draw_arcs(ax: Axes, scene: Scene) -> None:
    gap = np.full((1, 2), math.nan)
    curves = [part for arc in scene.arcs for part in (_curve(arc), gap)]
    ax.plot(*np.concatenate([gap, *curves]).T, color=_ARC, linewidth=2.5, label="arc (+ centre)")
    centres = np.array([arc.centre for arc in scene.arcs]).reshape(-1, 2)
    ax.plot(*centres.T, "+", color=_ARC, markersize=6)


def _curve(arc: Arc) -> FloatArray:
    """Points along an arc, one for every few degrees."""
    x, y = arc.centre
    begin = math.atan2(arc.start[1] - y, arc.start[0] - x)
    sense = -1.0 if arc.convex else 1.0
    turns = begin + sense * np.linspace(0.0, arc.extent, 2 + int(arc.extent / 0.05))
    return np.stack((x + arc.radius * np.cos(turns), y + arc.radius * np.sin(turns)), axis=1)


def _draw_doors(ax: Axes, scene: Scene) -> None:
    from matplotlib.patheffects import withStroke

    ends = [(door.start, door.end) for door in scene.doors]
    ax.plot(
        *_polyline(ends),
        color=_DOOR,
        linewidth=5,
        solid_capstyle="butt",
        label="door (width, m)",
    )
    for door in scene.doors:
        ax.annotate(
            f"{door.width:.2f}",
            door.midpoint,
            xytext=(5, 5),
            textcoords="offset points",
            color=_DOOR,
            fontsize=8,
            fontweight="bold",
            clip_on=True,
            path_effects=[withStroke(linewidth=2, foreground="white")],
        )


def _draw_corridors(ax: Axes, scene: Scene) -> None:
    ends = [(corridor.start, corridor.end) for corridor in scene.corridors]
    ax.plot(*_polyline(ends), color=_CORRIDOR, linewidth=0.8, linestyle=":")
    middles = np.array([corridor.midpoint for corridor in scene.corridors]).reshape(-1, 2)
    ax.plot(*middles.T, "X", color=_CORRIDOR, markersize=7, label="corridor midpoint")


def _tick(wall: Wall) -> tuple[Point, Point]:
    x, y = middle_of(wall.start, wall.end)
    left = wall.heading + math.pi / 2
    return (x, y), (x + _TICK * math.cos(left), y + _TICK * math.sin(left))


def _polyline(ends: Sequence[tuple[Point, Point]]) -> tuple[FloatArray, FloatArray]:
    """Coordinates of all pieces as one line, NaN between them."""
    gap = (math.nan, math.nan)
    points = np.array([(start, end, gap) for start, end in ends]).reshape(-1, 2)
    return points[:, 0], points[:, 1]


def _frame(ax: Axes, points: FloatArray, scene: Scene) -> None:
    """Limit the axes to the scene and the scanner."""
    shown = [end for w in scene.walls for end in (w.start, w.end)]
    shown += [end for d in scene.doors for end in (d.start, d.end)]
    shown += [end for a in scene.arcs for end in (a.start, a.end)]
    corners = np.array([(0.0, 0.0), *(shown or points.tolist())])
    low, high = corners.min(axis=0), corners.max(axis=0)
    (x, y), half = (low + high) / 2, (high - low).max() / 2 + _MARGIN
    ax.set(xlim=(x - half, x + half), ylim=(y - half, y + half), aspect="equal")
    ax.grid(color="0.92", linewidth=0.6)
    ax.set_axisbelow(True)
    ax.tick_params(labelsize=7)
