"""Draws the situations of tests/support/rules.json.

Beside what a row means stands the row's name; the arrows are where its command is given. Rows that
are answered with an error stand in the title.
"""

from __future__ import annotations

import math
from collections import defaultdict

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_env.world.maps import FloorPlan, Material
from semnav_features.frames import Point, Pose
from studies.figures import IMAGES
from tests.support.situations import ROWS, TABLE, Row, situation

PAGE_COLUMNS = 3
"""Panels beside each other on a page."""

LABEL_OFFSET = 0.6
"""From a door to its label, metres."""
PAGES = {"rule_rows_doors": "DCFWJ", "rule_rows_facing": "KO", "rule_rows_places": "BRNE"}


def draw_page(name: str, letters: str) -> None:
    """All drawn situations that have rows of these letters."""
    rows = [row for row in ROWS if row.id[0] in letters]
    drawn = [key for key, given in TABLE["situations"].items() if "plan" not in given]
    keys = [key for key in drawn if any(row.situation == key for row in rows)]
    count = math.ceil(len(keys) / PAGE_COLUMNS)
    figure = Figure(figsize=(13.0, 2.0 * count), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(count, PAGE_COLUMNS).flat
    for ax, key in zip(axes, keys, strict=False):
        draw_situation(ax, key, [row for row in rows if row.situation == key])
    for ax in axes:
        ax.axis("off")
    figure.savefig(IMAGES / f"{name}.png", dpi=90)


def draw_situation(ax: Axes, key: str, rows: list[Row]) -> None:
    """One situation with the names of its rows."""
    plan, labels, refused = situation(key), defaultdict(list), []
    _draw_plan(ax, plan)
    for row in rows:
        _draw_arrow(ax, row.begin)
        if isinstance(row.expected, tuple):
            labels[row.expected].append(row.id)
        elif " " in row.expected:
            refused.append(row.id)
        else:
            x, y = plan.door(row.expected).midpoint
            labels[x, y + math.copysign(LABEL_OFFSET, y)].append(row.id)
    for place, names in labels.items():
        _label(ax, place, " ".join(names))
    error = f" (refused: {', '.join(refused)})" if refused else ""
    ax.set_title(key + error, fontsize=9)
    if "walls" not in TABLE["situations"][key]:
        ax.set_ylim(-3.2, 3.2)
    ax.set_aspect("equal")
    ax.axis("off")


def _draw_plan(ax: Axes, plan: FloorPlan) -> None:
    for surface in plan.surfaces:
        colour = "saddlebrown" if surface.material is Material.LEAF else "black"
        ax.plot(*zip(*surface.points, strict=True), color=colour, lw=1.4)
    for door in plan.doors:
        colour = "tab:green" if door.open else "tab:red"
        ax.plot(*zip(door.start, door.end, strict=True), color=colour, lw=3.0)


def _draw_arrow(ax: Axes, begin: Pose) -> None:
    x, y, heading = begin
    tip = x + math.cos(heading), y + math.sin(heading)
    ax.annotate("", tip, (x, y), arrowprops={"arrowstyle": "-|>", "color": "tab:blue"})
    ax.plot(x, y, "o", color="tab:blue", ms=4)


def _label(ax: Axes, place: Point, text: str) -> None:
    box = {"boxstyle": "round,pad=0.15", "fc": "white", "ec": "tab:purple", "alpha": 0.85}
    style = {"ha": "center", "va": "center", "fontsize": 7, "color": "tab:purple"}
    ax.text(*place, text, bbox=box, zorder=5, **style)


def main() -> None:
    """Draw rule_rows_*.png, the situations of the table of rules."""
    for page, kinds in PAGES.items():
        draw_page(page, kinds)
