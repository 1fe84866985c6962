"""Draws the pictures of commands.md with the code that they explain: `python docs/draw_rules.py`.

Doors are numbered as `doors_along` counts them, junctions are those of `hallway`, and goals are
what `ground` returns, so the pictures cannot say anything else than the program does.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Wedge

from semnav_env.commands import parse
from semnav_env.commands.clauses import Side
from semnav_env.features import ExtractorSettings
from semnav_env.features.frames import Point, Pose, compose, relative
from semnav_env.features.hallway import Hallway, hallway
from semnav_env.features.scene import Door, Scene, Wall
from semnav_env.grounding import Goal, GoalKind, ground
from semnav_env.grounding.doors import doors_along
from semnav_env.lidar import Lidar
from semnav_env.maps import load_floor_plan
from semnav_env.perception import Perception
from semnav_env.robots import WHEELCHAIR

IMAGES = Path(__file__).parent / "images"
COLOURS = {Side.LEFT: "tab:blue", Side.RIGHT: "tab:orange", Side.AHEAD: "tab:purple"}
LETTERS = {Side.LEFT: "L", Side.RIGHT: "R", Side.AHEAD: "A"}
NORTH, WEST, SOUTH = math.pi / 2, math.pi, -math.pi / 2
OFFICE_PLAN = load_floor_plan("office_cross")
HEIDELBERG_PLAN = load_floor_plan("heidelberg_hallway")
OFFICE = OFFICE_PLAN.scene


def walls(*points: Point) -> tuple[Wall, ...]:
    return tuple(Wall(a, b) for a, b in pairwise(points))


ARMS = Scene(
    (
        *walls((0, 1), (7, 1), (7, 4), (9, 4), (9, 1), (12, 1), (12, 4), (14, 4), (14, -4)),
        *walls((14, -4), (12, -4), (12, -1), (5, -1), (5, -4), (3, -4), (3, -1), (0, -1), (0, 1)),
    )
)
"""An arm to the right, one to the left, and a T."""

NICHES = Scene(
    (
        *walls((0, 1), (2.5, 1), (2.5, 2), (2.8, 2)),
        *walls((3.7, 2), (4, 2), (4, 1), (7, 1), (7, 4), (7.5, 4)),
        *walls((8.5, 4), (9, 4), (9, 1), (12, 1), (12, 0.45)),
        *walls((12, -0.45), (12, -1), (0, -1), (0, 1)),
    ),
    (Door((2.8, 2), (3.7, 2)), Door((7.5, 4), (8.5, 4)), Door((12, 0.45), (12, -0.45))),
)
"""A recess and an arm, each with a door in its back, and a door in the end."""


def draw_rules() -> None:
    """Draw and save every picture."""
    _save("doors", [_counting_doors], (11.0, 3.2))
    _save("half", [_before_the_middle, _behind_the_middle], (9.0, 3.0))
    _save("sides", [_recess_and_arm], (8.0, 3.6))
    _save("junctions", [_crossing, _t_junction, _bend], (10.0, 4.0))
    _save("turns", [_turn_left, _turn_right_again], (10.0, 3.6))
    _save("end", [_end_of_corridor, _end_at_bend, _end_at_door], (10.0, 3.6))
    _save("goals", [_through, _to, _into_an_arm], (10.0, 4.2))
    _save("seek", [_seek_first, _seek_later], (10.0, 4.6))


def _counting_doors(ax: Axes) -> None:
    begin = (1.3, 9.1, 0.0)
    _draw_scene(ax, OFFICE)
    _draw_doors(ax, OFFICE, hallway(OFFICE, begin))
    _draw_robot(ax, begin)
    for door in OFFICE_PLAN.doors:
        if not door.open:
            _label(ax, (door.midpoint[0], door.midpoint[1] - 0.5), "closed", "tab:red")
    _crop(ax, "counted from the arrow: L on the left, R on the right", (-0.5, 30.5), (6.5, 11.7))


def _half(ax: Axes, x: float, title: str) -> None:
    begin = (x, 9.1, 0.0)
    _draw_scene(ax, OFFICE)
    _draw_doors(ax, OFFICE, hallway(OFFICE, begin))
    _draw_robot(ax, begin)
    ax.axvline(x, color="tab:red", lw=0.8, ls=":")
    _crop(ax, title, (-0.3, 7.8), (6.9, 11.3))


def _before_the_middle(ax: Axes) -> None:
    _half(ax, 2.5, "most of its opening is ahead: it is the first")


def _behind_the_middle(ax: Axes) -> None:
    _half(ax, 2.9, "less than half is ahead: the next one is the first")


def _recess_and_arm(ax: Axes) -> None:
    begin = (0.8, 0.0, 0.0)
    _draw_scene(ax, NICHES)
    _draw_doors(ax, NICHES, hallway(NICHES, begin))
    _draw_robot(ax, begin)
    _crop(
        ax, "the door in the recess counts, the one in the arm does not", (-0.5, 12.8), (-1.5, 4.6)
    )


def _junctions(ax: Axes, scene: Scene, begin: Pose, title: str) -> None:
    seen = hallway(scene, begin)
    _draw_scene(ax, scene)
    _draw_axis(ax, seen)
    _draw_robot(ax, begin)
    for junction in seen.junctions:
        ways = {"left": junction.left, "right": junction.right, "ahead": junction.ahead}
        name = "corner" if junction.is_corner else "intersection"
        text = f"{name}\n{', '.join(way for way, there in ways.items() if there)}"
        _label(ax, seen.place(junction.centre)[:2], text, "tab:red")
    ax.set_title(title)


def _crossing(ax: Axes) -> None:
    _junctions(ax, OFFICE, (11.0, 9.1, 0.0), "")
    _crop(ax, "a crossing", (10.5, 19.5), (4.5, 13.5))


def _t_junction(ax: Axes) -> None:
    _junctions(ax, ARMS, (10.0, 0.0, 0.0), "")
    _crop(ax, "a T", (8.5, 17.5), (-4.5, 4.5))


def _bend(ax: Axes) -> None:
    _junctions(ax, OFFICE, (15.0, 14.8, NORTH), "")
    _crop(ax, "a bend", (12.5, 21.5), (12.5, 21.5))


def _goal(ax: Axes, scene: Scene, begin: Pose, text: str, title: str = "") -> Goal:
    (clause,) = parse(text).clauses
    goal = ground(clause, scene, begin, complete=True)
    _draw_scene(ax, scene)
    _draw_robot(ax, begin)
    _draw_goal(ax, goal)
    if goal.hallway is not None:
        _draw_axis(ax, goal.hallway)
    ax.set_title(title or text)
    return goal


def _turn_left(ax: Axes) -> None:
    _goal(ax, ARMS, (0.8, 0.0, 0.0), "turn left at the intersection")


def _turn_right_again(ax: Axes) -> None:
    _goal(ax, ARMS, (0.8, 0.0, 0.0), "turn right at the second intersection")


def _end_of_corridor(ax: Axes) -> None:
    _goal(ax, OFFICE, (24.0, 9.1, 0.0), "go to the end of the hallway")
    _crop(ax, "a dead end", (22.5, 30.5), (5.5, 12.5))


def _end_at_bend(ax: Axes) -> None:
    _goal(ax, OFFICE, (15.0, 15.0, NORTH), "go to the end of the hallway")
    _crop(ax, "a bend (and a T)", (12.5, 20.5), (14.0, 21.0))


def _end_at_door(ax: Axes) -> None:
    _goal(ax, NICHES, (6.0, 0.0, 0.0), "go to the end of the hallway")
    _crop(ax, "a door across the hallway", (5.0, 13.0), (-2.5, 4.5))


def _through(ax: Axes) -> None:
    _goal(ax, OFFICE, (1.3, 9.1, 0.0), "go through the second door on the right")
    _crop(ax, "through: PASS", (-0.3, 8.5), (4.0, 11.5))


def _to(ax: Axes) -> None:
    _goal(ax, OFFICE, (1.3, 9.1, 0.0), "go to the second door on the right")
    _crop(ax, "to: REACH", (-0.3, 8.5), (4.0, 11.5))


def _into_an_arm(ax: Axes) -> None:
    _goal(ax, OFFICE, (11.0, 9.1, 0.0), "turn left at the intersection")
    _crop(ax, "a turn: REACH", (10.2, 19.0), (6.5, 14.0))


def _seek(ax: Axes, metres: float, title: str) -> None:
    """What a robot has understood after so many metres of the Heidelberg hallway."""
    start, heading = (-2.5, -0.3, 0.24), 0.24
    lidar = Lidar(HEIDELBERG_PLAN, mount=WHEELCHAIR.lidar_mount)
    perception = Perception(lidar, ExtractorSettings())
    perception.begin(parse("go through the third door on the right"))
    for step, along in enumerate(np.arange(0.0, metres + 0.05, 0.05)):
        pose = compose(start, (float(along), 0.0, 0.0))
        perception.sense(pose, relative(start, pose), (0.75, 0.0, 0.0), (0, 0, step))
    goal, scene = perception.follower.goal, perception.scene()
    origin = (0.0, 0.0, -heading)
    _draw_scene(ax, HEIDELBERG_PLAN.scene.seen_from(start).seen_from(origin), "0.8", doors=False)
    turned = scene.seen_from(origin)
    _draw_scene(ax, turned, "tab:red")
    _draw_doors(ax, turned, hallway(turned, (0.0, 0.0, heading)))
    _draw_robot(ax, relative(origin, relative(start, pose)))
    _draw_mark(ax, relative(origin, goal.pose), goal.kind)
    _crop(ax, f"{title}: {goal.because}", (-2.0, 14.0), (-4.0, 6.0))


def _seek_first(ax: Axes) -> None:
    _seek(ax, 1.0, "after 1 m")


def _seek_later(ax: Axes) -> None:
    _seek(ax, 5.0, "after 5 m")


def _draw_scene(ax: Axes, scene: Scene, colour: str = "black", doors: bool = True) -> None:
    for wall in scene.walls:
        ax.plot(*zip(wall.start, wall.end, strict=True), color=colour, lw=1.4)
    for door in scene.doors if doors else ():
        ax.plot(*zip(door.start, door.end, strict=True), color="tab:green", lw=3.0)


def _draw_doors(ax: Axes, scene: Scene, seen: Hallway) -> None:
    _draw_axis(ax, seen)
    for side in Side:
        for number, counted in enumerate(doors_along(scene, seen, side), 1):
            _badge(ax, counted.pose(0.5)[:2], side, number)


def _badge(ax: Axes, place: Point, side: Side, number: int) -> None:
    _label(ax, place, f"{LETTERS[side]}{number}", COLOURS[side])


def _label(ax: Axes, place: Point, text: str, colour: str) -> None:
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


def _draw_axis(ax: Axes, seen: Hallway) -> None:
    ends = seen.place(0.0)[:2], seen.place(min(seen.end, 30.0))[:2]
    ax.plot(*zip(*ends, strict=True), color="0.5", lw=1.0, ls=":")


def _draw_robot(ax: Axes, pose: Pose) -> None:
    tip = compose(pose, (0.8, 0.0, 0.0))
    style = {"arrowstyle": "-|>", "color": "tab:red", "lw": 2.0}
    ax.annotate("", tip[:2], pose[:2], arrowprops=style)
    ax.plot(*pose[:2], "o", color="tab:red", ms=6)


def _draw_goal(ax: Axes, goal: Goal) -> None:
    """The goal with its tolerances: the verifier's, and within it the robot's own."""
    if math.isfinite(goal.distance_tolerance):
        for share in (1.0, 0.5):
            _draw_tolerance(ax, goal, share)
    if goal.kind is GoalKind.PASS and goal.door is not None:
        ax.plot(*zip(goal.door.start, goal.door.end, strict=True), color="tab:purple", lw=6.0)
    _draw_mark(ax, goal.pose, goal.kind)


def _draw_tolerance(ax: Axes, goal: Goal, share: float) -> None:
    style = {"color": "tab:purple", "alpha": 0.12}
    ax.add_patch(Circle(goal.pose[:2], share * goal.distance_tolerance, **style))
    if goal.heading_tolerance < math.pi:
        spread = math.degrees(share * goal.heading_tolerance)
        middle = math.degrees(goal.pose[2])
        ax.add_patch(Wedge(goal.pose[:2], 0.9, middle - spread, middle + spread, **style))


def _draw_mark(ax: Axes, pose: Pose, kind: GoalKind) -> None:
    tip = compose(pose, (0.8, 0.0, 0.0))
    style = {"arrowstyle": "->", "color": "tab:purple", "lw": 1.6}
    ax.annotate("", tip[:2], pose[:2], arrowprops=style)
    ax.plot(*pose[:2], "*", color="tab:purple", ms=11)
    beside = abs(math.sin(pose[2])) > 0.5
    x, y = (pose[0] + 0.35, pose[1]) if beside else (pose[0], pose[1] - 0.55)
    style = {"ha": "left" if beside else "center", "va": "center", "fontsize": 8}
    ax.text(x, y, kind.name, color="tab:purple", clip_on=True, **style)


def _crop(ax: Axes, title: str, x: tuple[float, float], y: tuple[float, float]) -> None:
    ax.set_title(title)
    ax.set_xlim(*x)
    ax.set_ylim(*y)


def _save(name: str, panels: Sequence[object], size: tuple[float, float]) -> None:
    figure = Figure(figsize=size)
    FigureCanvasAgg(figure)
    axes = figure.subplots(1, len(panels), squeeze=False)[0]
    for ax, draw in zip(axes, panels, strict=True):
        draw(ax)
        ax.set_aspect("equal")
        ax.axis("off")
        ax.title.set_fontsize(9)
    figure.subplots_adjust(wspace=0.1)
    figure.savefig(IMAGES / f"rule_{name}.png", dpi=100, bbox_inches="tight", pad_inches=0.1)


if __name__ == "__main__":
    draw_rules()
