"""Pictures of the poses before a door; the only file of this folder that imports matplotlib."""

from __future__ import annotations

import math
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_env.approach.plan import ApproachPlan
from semnav_env.approach.poses import CandidatePose, body_at, ellipse_at
from semnav_env.approach.settings import ApproachSettings
from semnav_env.robots import RobotSpec
from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.draw import draw_floor_plan
from semnav_features.frames import Pose
from semnav_features.plot import check_suffix
from semnav_features.writing import replacing

SAFE, REFUSED, BEST, SQUARE = "tab:green", "tab:red", "tab:blue", "tab:orange"
"""Colours of safe poses, of refused ones, of the best pose, and of the free-space square."""

START = "0.3"
"""Colour of the body where the robot starts."""

ARROW_LENGTH = 0.16
"""Length of the arrow that shows a heading, metres."""

VIEW_MARGIN = 2.2
"""Distance from the middle of the door to the edge of the picture, metres."""


def draw_square(ax: Axes, plan: ApproachPlan) -> None:
    """Draw the free-space square before the door."""
    ax.plot(*np.array(plan.square.exterior.coords).T, color=SQUARE, lw=1.8)


def draw_poses(ax: Axes, poses: Iterable[CandidatePose], size: float = 1.0) -> None:
    """Draw candidate poses as arrows, green where they are safe and red where not."""
    for each in poses:
        x, y, heading = each.pose
        step = size * ARROW_LENGTH * math.cos(heading), size * ARROW_LENGTH * math.sin(heading)
        colour = SAFE if each.is_safe else REFUSED
        ax.arrow(x, y, *step, color=colour, head_width=0.06 * size, lw=0.8, zorder=4)


def draw_ellipse(ax: Axes, pose: Pose, settings: ApproachSettings, colour: str = SAFE) -> None:
    """Draw the ellipse around a pose, which must be free."""
    ax.plot(*np.array(ellipse_at(pose, settings).exterior.coords).T, color=colour, lw=1.0)


def draw_body(ax: Axes, pose: Pose, robot: RobotSpec, colour: str = BEST) -> None:
    """Draw the rectangle of a body."""
    ax.plot(*np.array(body_at(pose, robot).exterior.coords).T, color=colour, lw=1.8, zorder=5)


def save_approach(
    floor_plan: FloorPlan,
    door: str,
    plan: ApproachPlan,
    robot: RobotSpec,
    path: Path,
    start: Pose | None,
) -> None:
    """Write a picture of the poses before a door; the suffix of `path` says the format.

    Args:
        floor_plan: with the door.
        door: its name.
        plan: the poses.
        robot: the body; it is drawn at the best pose and at the start.
        path: file to write.
        start: where the robot is, if that is known.

    Raises:
        ValueError: another suffix, or a folder.
    """
    check_suffix(path)
    figure = Figure(figsize=(7.0, 7.0), layout="constrained")
    FigureCanvasAgg(figure)
    ax = figure.add_subplot()
    draw_floor_plan(floor_plan, ax, names=False)
    draw_square(ax, plan)
    draw_poses(ax, plan.ranked)
    named = {SQUARE: "square to be free", SAFE: "safe pose", REFUSED: "refused pose"}
    if plan.best is not None:
        draw_ellipse(ax, plan.best, ApproachSettings.for_robot(robot), BEST)
        draw_body(ax, plan.best, robot)
        named[BEST] = "best pose: body and ellipse"
    if start is not None:
        draw_body(ax, start, robot, START)
        named[START] = "start"
    for colour, name in named.items():
        ax.plot([], [], color=colour, lw=2.0, label=name)
    ax.legend(loc="upper right", fontsize=8)
    x, y = plan.side.middle
    view = VIEW_MARGIN
    ax.set(xlim=(x - view, x + view), ylim=(y - view, y + view))
    counts = f"{len(plan.safe)} of {len(plan.ranked)} poses are safe"
    ax.set_title(f"{floor_plan.name}, door {door}, {robot.name}: {counts}")
    with replacing(path) as part:
        figure.savefig(part, dpi=100)
