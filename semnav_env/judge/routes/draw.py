"""Pictures of routes; the only file of the routes that imports matplotlib."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_env.judge.routes.route import Route
from semnav_env.world.maps.draw import draw_floor_plan, leave_out_overlapping
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import Pose
from semnav_features.plot import check_suffix
from semnav_features.writing import replacing

ROUTE_COLOURS = ("tab:red", "tab:blue", "tab:purple", "tab:olive", "tab:cyan")
"""Colours of routes, in turn."""

LONGEST_SIDE = 12.0
"""Longest side of a picture, inches."""


def draw_routes(
    floor_plan: FloorPlan, routes: Sequence[tuple[Route, str]], ax: Axes, names: bool = True
) -> None:
    """Draw routes into a plan, each with its text.

    Args:
        floor_plan: the floor plan.
        routes: each with its text, the label of its line.
        ax: axes to draw on.
        names: whether to write the names of doors and regions.
    """
    draw_floor_plan(floor_plan, ax, names)
    for k, (route, text) in enumerate(routes):
        colour = ROUTE_COLOURS[k % len(ROUTE_COLOURS)]
        ax.plot(*route.points.T, color=colour, lw=2.0, label=text)
        _draw_arrow(ax, route.start, colour)
        _draw_arrow(ax, route.poses[-1].tolist(), colour)
        ax.plot(*route.start[:2], "o", color=colour, ms=7)


def save_routes(
    floor_plan: FloorPlan, routes: Sequence[tuple[Route, str]], path: Path, names: bool = True
) -> None:
    """Write a picture of routes; the suffix of `path` says the format (png, svg, pdf).

    Raises:
        ValueError: another suffix, or a folder.
    """
    check_suffix(path)
    west, south, east, north = floor_plan.boundary.bounds
    inch = LONGEST_SIDE / max(east - west, north - south)
    size = (east - west) * inch + 1.0, (north - south) * inch + 1.0 + 0.3 * len(routes)
    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    ax = figure.add_subplot()
    draw_routes(floor_plan, routes, ax, names)
    figure.legend(loc="outside lower center", frameon=False)
    leave_out_overlapping(ax)
    with replacing(path) as part:
        figure.savefig(part, dpi=100)


def _draw_arrow(ax: Axes, pose: Pose, colour: str) -> None:
    x, y, heading = pose
    tip = x + 0.7 * math.cos(heading), y + 0.7 * math.sin(heading)
    ax.annotate("", tip, (x, y), arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 2.0})
