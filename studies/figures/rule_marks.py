"""What the pictures of commands.md are made of: walls, doors, robots, goals and their labels."""

from __future__ import annotations

import math

from matplotlib.axes import Axes
from matplotlib.patches import Circle, Wedge

from semnav_env.language.references import Side
from semnav_env.mind.grounding import Goal, GoalKind, PassGoal, ReachGoal
from semnav_env.mind.grounding.counted_doors import doors_along
from semnav_features.corridor import Corridor
from semnav_features.frames import Point, Pose, compose
from semnav_features.scene import Scene

COLOURS = {Side.LEFT: "tab:blue", Side.RIGHT: "tab:orange", Side.AHEAD: "tab:purple"}
LETTERS = {Side.LEFT: "L", Side.RIGHT: "R", Side.AHEAD: "A"}


def draw_scene(ax: Axes, scene: Scene, colour: str = "black", doors: bool = True) -> None:
    for wall in scene.walls:
        ax.plot(*zip(wall.start, wall.end, strict=True), color=colour, lw=1.4)
    for door in scene.doors if doors else ():
        ax.plot(*zip(door.start, door.end, strict=True), color="tab:green", lw=3.0)


def draw_doors(ax: Axes, scene: Scene, seen: Corridor) -> None:
    draw_axis(ax, seen)
    for side in Side:
        for number, counted in enumerate(doors_along(scene, seen, side), 1):
            _badge(ax, counted.pose(0.5)[:2], side, number)


def _badge(ax: Axes, place: Point, side: Side, number: int) -> None:
    label(ax, place, f"{LETTERS[side]}{number}", COLOURS[side])


def label(ax: Axes, place: Point, text: str, colour: str) -> None:
    box = {"boxstyle": "round,pad=0.2", "fc": "white", "ec": colour, "alpha": 0.9}
    ax.text(
        *place,
        text,
        ha="center",
        va="center",
        color=colour,
        fontsize=8,
        bbox=box,
        zorder=5,
        clip_on=True,
    )


def draw_axis(ax: Axes, seen: Corridor) -> None:
    ends = seen.place(0.0)[:2], seen.place(min(seen.end, 30.0))[:2]
    ax.plot(*zip(*ends, strict=True), color="0.5", lw=1.0, ls=":")


def draw_robot(ax: Axes, pose: Pose) -> None:
    tip = compose(pose, (0.8, 0.0, 0.0))
    style = {"arrowstyle": "-|>", "color": "tab:red", "lw": 2.0}
    ax.annotate("", tip[:2], pose[:2], arrowprops=style)
    ax.plot(*pose[:2], "o", color="tab:red", ms=6)


def draw_goal(ax: Axes, goal: Goal) -> None:
    """The goal with its tolerances: the judge's, and within it the robot's own."""
    if isinstance(goal, ReachGoal):
        for share in (1.0, 0.5):
            _draw_tolerance(ax, goal, share)
    if isinstance(goal, PassGoal):
        ax.plot(*zip(goal.door.start, goal.door.end, strict=True), color="tab:purple", lw=6.0)
    draw_mark(ax, goal.pose, goal.kind)


def _draw_tolerance(ax: Axes, goal: ReachGoal, share: float) -> None:
    style = {"color": "tab:purple", "alpha": 0.12}
    ax.add_patch(Circle(goal.pose[:2], share * goal.distance_tolerance, **style))
    if goal.fixes_heading:
        spread = math.degrees(share * goal.heading_tolerance)
        middle = math.degrees(goal.pose[2])
        ax.add_patch(Wedge(goal.pose[:2], 0.9, middle - spread, middle + spread, **style))


def draw_mark(ax: Axes, pose: Pose, kind: GoalKind) -> None:
    tip = compose(pose, (0.8, 0.0, 0.0))
    style = {"arrowstyle": "->", "color": "tab:purple", "lw": 1.6}
    ax.annotate("", tip[:2], pose[:2], arrowprops=style)
    ax.plot(*pose[:2], "*", color="tab:purple", ms=11)
    beside = abs(math.sin(pose[2])) > 0.5
    x, y = (pose[0] + 0.35, pose[1]) if beside else (pose[0], pose[1] - 0.55)
    style = {"ha": "left" if beside else "center", "va": "center", "fontsize": 8}
    ax.text(x, y, kind.name, color="tab:purple", clip_on=True, **style)
