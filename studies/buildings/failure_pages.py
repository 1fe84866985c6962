"""Pages of scans in which a door was missed or a false one found."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import points_to_local
from semnav_features.scene import Door
from studies.buildings.buildings import FloorLook

PAGE_COLUMNS = 5
"""Panels beside each other on a page."""

VIEW_MARGIN = 2.0
"""What is shown around a door, metres."""


class Failure(NamedTuple):
    """A door that was missed or is false, in the lidar frame, and the scan it is about."""

    look: FloorLook
    door: Door


def save_failures(path: Path, plan: FloorPlan, failures: Sequence[Failure], title: str) -> None:
    """Draw each failure with its scan: doors green, what was found red, the failure thick.

    Args:
        path: the picture to write.
        plan: the building.
        failures: at least one.
        title: of the page.
    """
    rows = -(-len(failures) // PAGE_COLUMNS)
    figure = Figure(figsize=(3.0 * PAGE_COLUMNS, 3.2 * rows + 0.5), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(rows, PAGE_COLUMNS, squeeze=False).ravel()
    for ax, failure in zip(axes, failures, strict=False):
        draw_failure(ax, plan, failure)
    for ax in axes[len(failures) :]:
        ax.set_axis_off()
    figure.suptitle(title)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=80)


def draw_failure(ax: Axes, plan: FloorPlan, failure: Failure) -> None:
    """Draw a failure with its scan: doors green, what was found red, the failure thick."""
    look, door = failure
    walls = points_to_local(look.pose, plan.segments.reshape(-1, 2, 2))
    near = (np.hypot(*(walls - door.midpoint).transpose(2, 0, 1)) < 3.0 * VIEW_MARGIN).any(axis=1)
    ax.plot(*walls[near].transpose(2, 1, 0), color="lightgrey", linewidth=1.0)
    scan = look.scan
    hits = scan.valid & (scan.ranges < scan.range_max)
    ranges, angles = scan.ranges[hits], scan.angles[hits]
    ax.plot(ranges * np.cos(angles), ranges * np.sin(angles), "k.", markersize=2.0)
    for doors, colour in ((look.doors, "green"), (look.found, "red")):
        for each in doors:
            width = 4.0 if each is door else 1.5
            ax.plot(
                *zip(each.start, each.end, strict=True), color=colour, linewidth=width, alpha=0.6
            )
    ax.plot(0.0, 0.0, marker=(3, 0, -90), markersize=8, color="blue")
    x, y = door.midpoint
    ax.set_xlim(x - VIEW_MARGIN, x + VIEW_MARGIN)
    ax.set_ylim(y - VIEW_MARGIN, y + VIEW_MARGIN)
    ax.set_aspect("equal")
    ax.set_title(f"{door.name or ''} {door.width:.2f} m, {np.hypot(x, y):.1f} m away", fontsize=8)
    ax.tick_params(labelsize=6)
