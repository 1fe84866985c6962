"""Pictures of driven episodes; the only file of the metrics that imports matplotlib."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from semnav_env.judge import place
from semnav_env.judge.metrics.final_belief import FinalBelief
from semnav_env.judge.metrics.motion import footprints
from semnav_env.judge.metrics.recording import Recording
from semnav_env.mind.grounding.goal import Goal
from semnav_env.robots import RobotSpec
from semnav_env.world.dynamics.leaves import swinging_leaves
from semnav_env.world.maps.draw import draw_floor_plan
from semnav_env.world.maps.floor_plan import FloorPlan
from semnav_features.frames import FloatArray
from semnav_features.writing import replacing

ROUTE_COLOUR = "#1a7f37"
"""Colour of the true route."""

PATH_COLOUR = "#1f4fd8"
"""Colour of the driven path and of the bodies on it."""

CONTACT_COLOUR = "#d62728"
"""Colour of the marks where something was touched."""

GOAL_COLOUR = "#8e3bb8"
"""Colour of the numbered goals."""

REMEMBERED_COLOUR = "#00a6a6"
"""Colour of the doors that the robot remembered, and of its agent's own goal."""

PERSON_COLOUR = "#e07b00"
"""Colour of people and of their paths."""

LEAF_COLOUR = "saddlebrown"
"""Colour of the leaves of doors that open and close."""

BODY_INTERVAL = 1.0
"""Time between the bodies that are drawn, seconds."""

TRAIL_LENGTH = 3.0
"""Length of the drawn last part of each person's path, metres."""

VIEW_MARGIN = 2.5
"""Margin around path and route that is shown, metres."""

LONGEST_SIDE = 10.0
"""Longest side of a picture, inches."""

LEAST_SIDE = 5.0
"""Shortest side of a picture, inches."""


def save_episode(
    path: str | Path,
    floor_plan: FloorPlan,
    recording: Recording,
    robot: RobotSpec,
    route: FloatArray,
    goals: Sequence[Goal] = (),
    title: str = "",
    belief: FinalBelief | None = None,
) -> None:
    """Write a picture of an episode: the plan, the true route, the driven path, contacts, goals.

    Doors that open and close, and people, are drawn where they were at the end; people with the
    last metres of their way.

    Args:
        path: the file; its suffix says the format (png, svg, pdf).
        floor_plan: the plan with the furniture of the episode.
        recording: recording of the episode.
        robot: its body is drawn once a second.
        route: the true route, shape (k, 2).
        goals: goals of the clauses, drawn with numbers.
        title: above it, wrapped.
        belief: what the robot remembered, and where its agent was driving to, at the end.
    """
    low, high = _extent(floor_plan, np.vstack((recording.path, route)))
    width, height = high - low
    inch = LONGEST_SIDE / max(width, height)
    size = max(LEAST_SIDE, width * inch) + 1.0, max(LEAST_SIDE, height * inch) + 1.6
    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    ax = figure.add_subplot()
    hung = recording.leaves is not None and len(recording.leaves)
    draw_floor_plan(swinging_leaves(floor_plan)[1] if hung else floor_plan, ax, names=False)
    draw_episode(ax, recording, robot, route, goals)
    if belief is not None:
        draw_belief(ax, belief)
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    _name_doors(ax, floor_plan, low, high)
    figure.suptitle("\n".join(textwrap.wrap(title, int(10 * size[0]))), fontsize=10)
    figure.legend(loc="outside lower center", ncols=4, fontsize=9)
    with replacing(path) as part:
        figure.savefig(part, dpi=90)


def draw_episode(
    ax: Axes,
    recording: Recording,
    robot: RobotSpec,
    route: FloatArray,
    goals: Sequence[Goal] = (),
) -> None:
    """Draw true route, driven path, bodies, contacts, goals and moving things onto a plan."""
    _draw_moved(ax, recording)
    ax.plot(*route.T, "--", color=ROUTE_COLOUR, linewidth=1.8, label="true route", zorder=4)
    _draw_bodies(ax, recording, robot)
    ax.plot(*recording.path.T, color=PATH_COLOUR, linewidth=1.8, label="driven", zorder=5)
    touched = recording.path[recording.contacts > 0]
    if len(touched):
        ax.plot(*touched.T, "x", color=CONTACT_COLOUR, markersize=6, label="in contact", zorder=6)
    for number, goal in enumerate(goals, start=1):
        x, y = place(goal)
        label = "true goals" if number == 1 else None
        ax.plot(x, y, "o", color=GOAL_COLOUR, markersize=14, alpha=0.8, label=label, zorder=7)
        ax.text(x, y, str(number), color="white", size=8, ha="center", va="center", zorder=8)


def draw_belief(ax: Axes, belief: FinalBelief) -> None:
    """Draw the doors that a robot remembered at the end, and the last goal of its agent."""
    for number, door in enumerate(belief.doors):
        label = "remembered doors" if number == 0 else None
        ends = zip(door.start, door.end, strict=True)
        ax.plot(*ends, color=REMEMBERED_COLOUR, linewidth=4.0, alpha=0.8, label=label, zorder=6)
    ax.plot(
        *belief.goal,
        "*",
        color=REMEMBERED_COLOUR,
        markersize=16,
        markeredgecolor="black",
        label="the robot's own goal at the end",
        zorder=10,
    )


def _draw_moved(ax: Axes, recording: Recording) -> None:
    """Draw leaves and people as they were at the end, with the last part of the people's ways."""
    for x1, y1, x2, y2 in () if recording.leaves is None else recording.leaves.tolist():
        ax.plot((x1, x2), (y1, y2), color=LEAF_COLOUR, linewidth=1.5)
    if recording.people is None:
        return
    for number, way in enumerate(recording.people.swapaxes(0, 1)):
        tail = _tail(way[:, :2])
        ax.plot(*tail.T, color=PERSON_COLOUR, linewidth=1.2, alpha=0.7, zorder=5)
        label = "people" if number == 0 else None
        person = Circle(tail[-1].tolist(), way[-1, 2], color=PERSON_COLOUR, alpha=0.8, label=label)
        person.set_zorder(6)
        ax.add_patch(person)


def _tail(way: FloatArray) -> FloatArray:
    """The last part of a path, at most `TRAIL_LENGTH` long."""
    steps = np.linalg.norm(np.diff(way, axis=0), axis=1)
    left = np.append(np.cumsum(steps[::-1])[::-1], 0.0)
    return way[left <= TRAIL_LENGTH]


def _draw_bodies(ax: Axes, recording: Recording, robot: RobotSpec) -> None:
    every = max(1, round(BODY_INTERVAL / recording.period))
    rows = sorted({*range(0, len(recording.poses), every), recording.steps})
    bodies = footprints(recording.poses[rows], robot)
    corners = shapely.get_coordinates(bodies).reshape(len(rows), -1, 2)
    faces = PolyCollection(
        list(corners), facecolor="none", edgecolor=PATH_COLOUR, linewidth=0.4, alpha=0.5
    )
    ax.add_collection(faces)
    ax.fill(*corners[-1].T, color=PATH_COLOUR, alpha=0.4, zorder=5)
    x, y, heading = recording.poses[-1]
    nose = robot.length / 2 * np.array((np.cos(heading), np.sin(heading)))
    ax.annotate("", (x + nose[0], y + nose[1]), (x, y), arrowprops={"arrowstyle": "->"}, zorder=6)


def _extent(floor_plan: FloorPlan, points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """The part of a plan to show: around some points, not beyond the plan."""
    west, south, east, north = floor_plan.boundary.bounds
    low = np.maximum(points.min(axis=0) - VIEW_MARGIN, (west - 0.3, south - 0.3))
    high = np.minimum(points.max(axis=0) + VIEW_MARGIN, (east + 0.3, north + 0.3))
    return low, high


def _name_doors(ax: Axes, floor_plan: FloorPlan, low: FloatArray, high: FloatArray) -> None:
    for door in floor_plan.doors:
        if (door.midpoint > low).all() and (door.midpoint < high).all():
            ax.annotate(
                door.name,
                door.midpoint,
                size=7,
                zorder=9,
                xytext=(8, 5),
                textcoords="offset points",
            )
