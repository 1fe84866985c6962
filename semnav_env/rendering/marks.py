"""Symbols of the picture, drawn alike on the map and in the legend; positions are on the page."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from semnav_env.rendering import palette
from semnav_env.rendering.canvas import Canvas, ShapeCanvas
from semnav_features.frames import FloatArray, Point, middle_of
from semnav_features.scene import CornerKind

BADGE_RADIUS = 9.0
"""Radius of the badge that numbers a goal, units of the page."""


def glass(canvas: ShapeCanvas, line: ArrayLike, thick: float) -> None:
    """Glass, which the lidar does not see."""
    canvas.stroke(line, palette.GLASS, thick)
    canvas.stroke(line, palette.WHITE, thick / 3)


def wall_seen(canvas: ShapeCanvas, line: ArrayLike) -> None:
    """An extracted wall; to be drawn with the highlighter."""
    canvas.stroke(line, palette.WALL_SEEN, 9.0)


def wall_assumed(canvas: ShapeCanvas, line: ArrayLike) -> None:
    """A wall that the plan's drawing does not show."""
    canvas.dashes(line, palette.ASSUMED, 1.6)


def furniture(canvas: ShapeCanvas, line: ArrayLike) -> None:
    """A piece of furniture, filled where its outline is closed."""
    points = np.asarray(line)
    if np.array_equal(points[0], points[-1]):
        canvas.polygon(points, palette.FURNITURE)
    canvas.stroke(points, palette.ASSUMED, 1.5)


def wall_remembered(canvas: ShapeCanvas, line: ArrayLike) -> None:
    """A wall of the memory."""
    canvas.dashes(line, palette.WALL_REMEMBERED, 1.6, dash=4.0, gap=3.0)


def door_seen(canvas: ShapeCanvas, line: ArrayLike) -> None:
    """A door in view now: a solid bar between its jambs."""
    canvas.stroke(line, palette.DOOR, 5.0)
    canvas.discs(line, 4.0, palette.DOOR)


def door_remembered(canvas: ShapeCanvas, line: ArrayLike) -> None:
    """A door of the memory: an outlined bar, larger than that of a door in view."""
    canvas.stroke(line, palette.DOOR, 11.0)
    canvas.stroke(line, palette.WHITE, 8.0)


def badge(canvas: Canvas, at: Point, number: int) -> None:
    """A door's number."""
    canvas.discs([at], BADGE_RADIUS + 1.5, palette.WHITE)
    canvas.discs([at], BADGE_RADIUS, palette.DOOR)
    canvas.text(at, str(number), palette.WHITE, 12.0, bold=True, centred=True)


def corner(canvas: ShapeCanvas, at: Point, kind: CornerKind) -> None:
    """A corner: a triangle for an outer one, a square for an inner one, hollow if potential."""
    if kind is CornerKind.OUTER:
        canvas.polygon(regular(at, 3, 7.5), palette.WHITE)
        canvas.polygon(regular(at, 3, 5.5), palette.OUTER_CORNER)
    elif kind is CornerKind.INNER:
        canvas.polygon(regular(at, 4, 6.5, math.pi / 4), palette.WHITE)
        canvas.polygon(regular(at, 4, 5.0, math.pi / 4), palette.INNER_CORNER)
    else:
        canvas.discs([at], 3.6, palette.WHITE)
        canvas.ring(at, 3.2, palette.POTENTIAL_CORNER, 1.4)


def corridor(canvas: ShapeCanvas, start: Point, end: Point) -> None:
    """A probe across a corridor with the midpoint where a robot would pass."""
    middle = middle_of(start, end)
    canvas.dashes([start, end], palette.CORRIDOR_MARK, 1.0, dash=2.0, gap=3.0)
    canvas.polygon(regular(middle, 4, 7.0), palette.WHITE)
    canvas.polygon(regular(middle, 4, 5.5), palette.CORRIDOR_MARK)


def trail(canvas: ShapeCanvas, line: ArrayLike) -> None:
    """The path of the robot so far."""
    canvas.stroke(line, palette.TRAIL, 1.8)


def route(canvas: ShapeCanvas, line: ArrayLike) -> None:
    """The true route, which the robot does not know."""
    canvas.dashes(line, palette.ROUTE, 2.0, dash=9.0, gap=6.0)


def hits(canvas: ShapeCanvas, points: ArrayLike) -> None:
    """The points at which beams ended."""
    canvas.discs(points, 1.3, palette.HIT)


def cloud(canvas: ShapeCanvas, points: ArrayLike) -> None:
    """Points that depth cameras saw."""
    canvas.discs(points, 0.9, palette.CLOUD)


def jamb(canvas: ShapeCanvas, at: Point) -> None:
    """A door jamb that was found in a cloud."""
    canvas.discs([at], 6.0, palette.WHITE)
    canvas.discs([at], 4.5, palette.JAMB)


def leaf(canvas: ShapeCanvas, line: ArrayLike, scale: float) -> None:
    """The leaf of a door that can swing; `scale` is in units of the page per metre."""
    canvas.stroke(line, palette.LEAF, max(2.2, 0.07 * scale))


def person(canvas: ShapeCanvas, at: Point, radius: float) -> None:
    """A person seen from above."""
    canvas.discs([at], radius + 1.5, palette.WHITE)
    canvas.discs([at], radius, palette.PERSON)
    canvas.discs([at], 0.5 * radius, palette.PERSON_HEAD)


def flag(canvas: ShapeCanvas, at: Point, height: float = 24.0) -> None:
    """A goal to stand at; `at` is the foot of its pole."""
    x, y = at
    cloth = [(x, y - height), (x + 0.62 * height, y - 0.76 * height), (x, y - 0.52 * height)]
    canvas.stroke([at, (x, y - height)], palette.WHITE, 4.5)
    canvas.polygon(cloth, palette.GOAL)
    canvas.stroke([at, (x, y - height)], palette.INK, 2.0)
    canvas.discs([at], 3.4, palette.WHITE)
    canvas.discs([at], 2.6, palette.GOAL)


def stop_sign(canvas: ShapeCanvas, at: Point, height: float = 30.0) -> None:
    """A place to stand still at; `at` is the foot of the pole."""
    top = at[0], at[1] - height
    canvas.stroke([at, top], palette.WHITE, 4.5)
    canvas.stroke([at, top], palette.INK, 2.0)
    for radius, colour in ((11.5, palette.WHITE), (10.0, palette.GOAL)):
        canvas.polygon(regular(top, 8, radius, math.pi / 8), colour)
    canvas.stroke([(top[0] - 5.0, top[1]), (top[0] + 5.0, top[1])], palette.WHITE, 3.0)


def arrow(canvas: ShapeCanvas, start: Point, end: Point, colour: palette.Colour) -> None:
    """A straight arrow."""
    (x1, y1), (x2, y2) = start, end
    length = math.hypot(x2 - x1, y2 - y1)
    if length < 1.0:
        return
    ux, uy = (x2 - x1) / length, (y2 - y1) / length
    neck = x2 - 8.0 * ux, y2 - 8.0 * uy
    head = [
        (x2, y2),
        *((x2 - 11 * ux - s * 5.5 * uy, y2 - 11 * uy + s * 5.5 * ux) for s in (1, -1)),
    ]
    for grow, tint in ((2.5, palette.WHITE), (0.0, colour)):
        canvas.stroke([start, neck], tint, 2.6 + grow)
        canvas.stroke([*head, head[0]], tint, 0.6 + grow)
        canvas.polygon(head, tint)


def regular(at: Point, corners: int, radius: float, turned: float = 0.0) -> FloatArray:
    """A regular polygon with one corner up, shape (corners, 2)."""
    angles = turned - math.pi / 2 + 2 * math.pi * np.arange(corners) / corners
    return np.stack((at[0] + radius * np.cos(angles), at[1] + radius * np.sin(angles)), axis=-1)
