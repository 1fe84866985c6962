"""Draws the pictures of commands.md with the code that they explain.

Doors are numbered as `doors_along` counts them, junctions are those of `corridor_at`, and goals are
what `ground` returns, so the pictures cannot say anything else than the program does.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from semnav_env.language import parse
from semnav_env.mind.belief import BeliefTracker
from semnav_env.mind.grounding import ground
from semnav_env.robots import WHEELCHAIR
from semnav_env.world.lidar import Lidar
from semnav_env.world.maps import load_floor_plan
from semnav_features.corridor import corridor_at
from semnav_features.frames import Point, Pose, compose
from semnav_features.scene import Door, Scene, Wall
from studies.figures import IMAGES
from studies.figures.rule_marks import (
    draw_axis,
    draw_doors,
    draw_goal,
    draw_mark,
    draw_robot,
    draw_scene,
    label,
)

NORTH = math.pi / 2
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

CROPS = {
    "corridor": ((-0.5, 30.5), (6.5, 11.7)),
    "west": ((-0.3, 7.8), (6.9, 11.3)),
    "niches": ((-0.5, 12.8), (-1.5, 4.6)),
    "crossing": ((10.5, 19.5), (4.5, 13.5)),
    "T": ((8.5, 17.5), (-4.5, 4.5)),
    "bend": ((12.5, 21.5), (12.5, 21.5)),
    "arms": ((-0.5, 16.0), (-4.5, 4.5)),
    "dead end": ((22.5, 30.5), (5.5, 12.5)),
    "door end": ((5.0, 13.0), (-2.5, 4.5)),
    "rooms": ((-0.3, 8.5), (4.0, 11.5)),
    "far rooms": ((-0.3, 9.5), (5.5, 14.5)),
    "heidelberg": ((-2.0, 14.0), (-4.0, 6.0)),
}
"""What a panel shows: x and y from where to where, metres."""

Draw: TypeAlias = Callable[[Axes], None]
Panel: TypeAlias = tuple[str, str, Draw]
"""Title, crop, and what to draw."""


def main() -> None:
    """Draw rule_*.png, the pictures of commands.md."""
    start, crossing, bend = (1.3, 9.1, 0.0), (11.0, 9.1, 0.0), (15.0, 14.8, NORTH)
    arms, niche, far = (0.8, 0.0, 0.0), (6.0, 0.0, 0.0), (24.0, 9.1, 0.0)
    title = "counted from the arrow: L on the left, R on the right"
    _save("doors", (11.0, 3.2), (title, "corridor", _doors(OFFICE, start)))
    _save(
        "half",
        (9.0, 3.0),
        ("most of its opening is ahead: it is the first", "west", _doors(OFFICE, (2.5, 9.1, 0.0))),
        ("less than half is ahead: it does not count", "west", _doors(OFFICE, (2.9, 9.1, 0.0))),
    )
    title = "the door in the recess counts, the one in the arm does not"
    _save("sides", (8.0, 3.6), (title, "niches", _doors(NICHES, arms)))
    _save(
        "junctions",
        (10.0, 4.0),
        ("a crossing", "crossing", _junctions(OFFICE, crossing)),
        ("a T", "T", _junctions(ARMS, (10.0, 0.0, 0.0))),
        ("a bend", "bend", _junctions(OFFICE, bend)),
    )
    wall, room, doorway = (5.4, 9.1, 0.0), (6.7, 13.2, NORTH), (2.675, 10.2, -NORTH)
    behind, opposite = "go through the door behind you", "go through the door opposite"
    _save(
        "behind",
        (10.0, 4.6),
        ("behind, in a hallway", "far rooms", _goal(OFFICE, wall, behind)),
        ("behind, in a room", "far rooms", _goal(OFFICE, room, behind)),
        ("opposite", "far rooms", _goal(OFFICE, doorway, opposite)),
    )
    left, second = "turn left at the intersection", "turn right at the second intersection"
    _save(
        "turns",
        (10.0, 3.6),
        (left, "arms", _goal(ARMS, arms, left)),
        (second, "arms", _goal(ARMS, arms, second)),
    )
    end = "go to the end of the hallway"
    _save(
        "end",
        (10.0, 3.6),
        ("a dead end", "dead end", _goal(OFFICE, far, end)),
        ("a bend (and a T)", "bend", _goal(OFFICE, bend, end)),
        ("a door across the hallway", "door end", _goal(NICHES, niche, end)),
    )
    door = "the second door on the right"
    _save(
        "goals",
        (10.0, 4.2),
        ("through: PASS", "rooms", _goal(OFFICE, start, f"go through {door}")),
        ("to: REACH", "rooms", _goal(OFFICE, start, f"go to {door}")),
        ("a turn: REACH", "crossing", _goal(OFFICE, crossing, left)),
    )
    _save(
        "seek",
        (10.0, 4.6),
        ("after 1 m the third door has not been seen", "heidelberg", _perceived(1.0)),
        ("after 5 m it has", "heidelberg", _perceived(5.0)),
    )


def _doors(scene: Scene, begin: Pose) -> Draw:
    """The doors as they are counted from a pose."""

    def draw(ax: Axes) -> None:
        draw_scene(ax, scene)
        draw_doors(ax, scene, corridor_at(scene, begin))
        draw_robot(ax, begin)
        for door in OFFICE_PLAN.doors if scene is OFFICE else ():
            if not door.open:
                label(ax, (door.midpoint[0], door.midpoint[1] - 0.5), "closed", "tab:red")

    return draw


def _junctions(scene: Scene, begin: Pose) -> Draw:
    """What kind of junction lies ahead of a pose, and where it leads."""

    def draw(ax: Axes) -> None:
        seen = corridor_at(scene, begin)
        draw_scene(ax, scene)
        draw_axis(ax, seen)
        draw_robot(ax, begin)
        for junction in seen.junctions:
            ways = {"left": junction.left, "right": junction.right, "ahead": junction.ahead}
            name = "corner" if junction.is_corner else "intersection"
            text = f"{name}\n{', '.join(way for way, there in ways.items() if there)}"
            label(ax, seen.place(junction.centre)[:2], text, "tab:red")

    return draw


def _goal(scene: Scene, begin: Pose, text: str) -> Draw:
    """The goal of a clause."""

    def draw(ax: Axes) -> None:
        (clause,) = parse(text).clauses
        goal = ground(clause, scene, begin, complete=True)
        draw_scene(ax, scene)
        draw_robot(ax, begin)
        draw_goal(ax, goal)
        if goal.corridor is not None:
            draw_axis(ax, goal.corridor)

    return draw


def _perceived(metres: float) -> Draw:
    """What a robot has understood after so many metres of the Heidelberg hallway."""

    def draw(ax: Axes) -> None:
        start = (-2.5, -0.3, 0.24)
        lidar = Lidar(HEIDELBERG_PLAN, mount=WHEELCHAIR.lidar_mount)
        tracker = BeliefTracker(lidar.spec, lidar.mount)
        tracker.begin(parse("go through the third door on the right"))
        for step, along in enumerate(np.arange(0.0, metres, 0.05)):
            odometry = (float(along), 0.0, 0.0)
            ranges = lidar.ranges(compose(start, odometry), (0, 0, step))
            belief = tracker.update(ranges, odometry, (0.75, 0.0, 0.0))
        page = (0.0, 0.0, start[2])
        scene, goal = belief.scene.placed(page), belief.goal
        draw_scene(ax, HEIDELBERG_PLAN.scene.seen_from(start).placed(page), "0.8", doors=False)
        draw_scene(ax, scene, "tab:red")
        draw_doors(ax, scene, corridor_at(scene, page))
        draw_robot(ax, compose(page, odometry))
        draw_mark(ax, compose(page, goal.pose), goal.kind)

    return draw


def _save(name: str, size: tuple[float, float], *panels: Panel) -> None:
    figure = Figure(figsize=size)
    FigureCanvasAgg(figure)
    axes = figure.subplots(1, len(panels), squeeze=False)[0]
    for ax, (title, crop, draw) in zip(axes, panels, strict=True):
        draw(ax)
        ax.set_title(title, fontsize=9)
        ax.set_xlim(*CROPS[crop][0])
        ax.set_ylim(*CROPS[crop][1])
        ax.set_aspect("equal")
        ax.axis("off")
    figure.subplots_adjust(wspace=0.1)
    path = IMAGES / f"rule_{name}.png"
    figure.savefig(path, dpi=100, bbox_inches="tight", pad_inches=0.1)
