"""The symbols of the picture, drawn alike on the map and in the legend. Positions on the page."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from semnav_env.features.frames import FloatArray, Point
from semnav_env.features.scene import CornerKind
from semnav_env.rendering import palette
from semnav_env.rendering.canvas import Canvas, ShapeCanvas

BADGE_RADIUS = 9.0
"""Radius of the badge that numbers a goal, units of the page."""


def glass(sheet: ShapeCanvas, line: ArrayLike, thick: float) -> None:
    """What the lidar does not see."""
    sheet.stroke(line, palette.GLASS, thick)
    sheet.stroke(line, palette.WHITE, thick / 3)


def wall_seen(sheet: ShapeCanvas, line: ArrayLike) -> None:
    """An extracted wall; to be drawn with the highlighter."""
    sheet.stroke(line, palette.WALL_SEEN, 9.0)


def wall_assumed(sheet: ShapeCanvas, line: ArrayLike) -> None:
    """A wall that the plan's drawing does not show."""
    sheet.dashes(line, palette.ASSUMED, 1.6)


def furniture(sheet: ShapeCanvas, line: ArrayLike) -> None:
    """Filled where it is closed."""
    points = np.asarray(line)
    if np.array_equal(points[0], points[-1]):
        sheet.polygon(points, palette.FURNITURE)
    sheet.stroke(points, palette.ASSUMED, 1.5)


def wall_remembered(sheet: ShapeCanvas, line: ArrayLike) -> None:
    """A wall of the memory."""
    sheet.dashes(line, palette.WALL_REMEMBERED, 1.6, dash=4.0, gap=3.0)


def door_seen(sheet: ShapeCanvas, line: ArrayLike) -> None:
    """A door in view now: a solid bar between its jambs."""
    sheet.stroke(line, palette.DOOR, 5.0)
    sheet.discs(line, 4.0, palette.DOOR)


def door_remembered(sheet: ShapeCanvas, line: ArrayLike) -> None:
    """A door of the memory: an outlined bar, larger than that of a door in view."""
    sheet.stroke(line, palette.DOOR, 11.0)
    sheet.stroke(line, palette.WHITE, 8.0)


def badge(canvas: Canvas, at: Point, number: int) -> None:
    """A door's number."""
    canvas.discs([at], BADGE_RADIUS + 1.5, palette.WHITE)
    canvas.discs([at], BADGE_RADIUS, palette.DOOR)
    canvas.text(at, str(number), palette.WHITE, 12.0, bold=True, centred=True)


def corner(sheet: ShapeCanvas, at: Point, kind: CornerKind) -> None:
    """Outer corners are triangles, inner ones squares, potential ones hollow."""
    if kind is CornerKind.OUTER:
        sheet.polygon(regular(at, 3, 7.5), palette.WHITE)
        sheet.polygon(regular(at, 3, 5.5), palette.OUTER_CORNER)
    elif kind is CornerKind.INNER:
        sheet.polygon(regular(at, 4, 6.5, math.pi / 4), palette.WHITE)
        sheet.polygon(regular(at, 4, 5.0, math.pi / 4), palette.INNER_CORNER)
    else:
        sheet.discs([at], 3.6, palette.WHITE)
        sheet.ring(at, 3.2, palette.POTENTIAL_CORNER, 1.4)


def corridor(sheet: ShapeCanvas, start: Point, end: Point) -> None:
    """The probe across a corridor, and where a robot would pass."""
    middle = (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
    sheet.dashes([start, end], palette.CORRIDOR_MARK, 1.0, dash=2.0, gap=3.0)
    sheet.polygon(regular(middle, 4, 7.0), palette.WHITE)
    sheet.polygon(regular(middle, 4, 5.5), palette.CORRIDOR_MARK)


def trail(sheet: ShapeCanvas, line: ArrayLike) -> None:
    """Where the robot has been."""
    sheet.stroke(line, palette.TRAIL, 1.8)


def route(sheet: ShapeCanvas, line: ArrayLike) -> None:
    """The true route, which the robot does not know."""
    sheet.dashes(line, palette.ROUTE, 2.0, dash=9.0, gap=6.0)


def hits(sheet: ShapeCanvas, points: ArrayLike) -> None:
    """Where beams ended."""
    sheet.discs(points, 1.3, palette.HIT)


def leaf(sheet: ShapeCanvas, line: ArrayLike, scale: float) -> None:
    """The leaf of a door that can swing; `scale` is in units of the page per metre."""
    sheet.stroke(line, palette.LEAF, max(2.2, 0.07 * scale))


def person(sheet: ShapeCanvas, at: Point, radius: float) -> None:
    """Somebody seen from above."""
    sheet.discs([at], radius + 1.5, palette.WHITE)
    sheet.discs([at], radius, palette.PERSON)
    sheet.discs([at], 0.5 * radius, palette.PERSON_HEAD)


def flag(sheet: ShapeCanvas, at: Point, height: float = 24.0) -> None:
    """A goal to stand at; `at` is the foot of its pole."""
    x, y = at
    cloth = [(x, y - height), (x + 0.62 * height, y - 0.76 * height), (x, y - 0.52 * height)]
    sheet.stroke([at, (x, y - height)], palette.WHITE, 4.5)
    sheet.polygon(cloth, palette.GOAL)
    sheet.stroke([at, (x, y - height)], palette.INK, 2.0)
    sheet.discs([at], 3.4, palette.WHITE)
    sheet.discs([at], 2.6, palette.GOAL)


def stop_sign(sheet: ShapeCanvas, at: Point, height: float = 30.0) -> None:
    """Where to stand still; `at` is the foot of the pole."""
    top = at[0], at[1] - height
    sheet.stroke([at, top], palette.WHITE, 4.5)
    sheet.stroke([at, top], palette.INK, 2.0)
    for radius, colour in ((11.5, palette.WHITE), (10.0, palette.GOAL)):
        sheet.polygon(regular(top, 8, radius, math.pi / 8), colour)
    sheet.stroke([(top[0] - 5.0, top[1]), (top[0] + 5.0, top[1])], palette.WHITE, 3.0)


def arrow(sheet: ShapeCanvas, start: Point, end: Point, colour: palette.Colour) -> None:
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
        sheet.stroke([start, neck], tint, 2.6 + grow)
        sheet.stroke([*head, head[0]], tint, 0.6 + grow)
        sheet.polygon(head, tint)


def regular(at: Point, corners: int, radius: float, turned: float = 0.0) -> FloatArray:
    """A regular polygon with one corner up, shape (corners, 2)."""
    angles = turned - math.pi / 2 + 2 * math.pi * np.arange(corners) / corners
    return np.stack((at[0] + radius * np.cos(angles), at[1] + radius * np.sin(angles)), axis=-1)
