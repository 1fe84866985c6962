"""What the symbols mean, drawn with the same marks as on the map."""

from __future__ import annotations

from collections.abc import Callable

from semnav_env.features.frames import Point
from semnav_env.features.scene import CornerKind
from semnav_env.rendering import marks, palette
from semnav_env.rendering.camera import Viewport
from semnav_env.rendering.canvas import Canvas

ROW = 20.0
COLUMN = 130.0
ICON = 13.0
"""Half the width of a symbol's place."""

LEGEND_HEIGHT = 196.0
"""With its heading, up to the end of the page."""


def draw_legend(canvas: Canvas, left: float, top: float) -> None:
    """Two columns of symbols and their names; `top` is the middle of the first row."""
    rows = -(-len(_ENTRIES) // 2)
    for index, (name, draw) in enumerate(_ENTRIES):
        x, y = left + COLUMN * (index // rows), top + ROW * (index % rows)
        draw(canvas, (x + ICON, y))
        canvas.text((x + 2 * ICON + 7.0, y), name, palette.INK, 11.0)


def _bar(at: Point) -> list[Point]:
    return [(at[0] - ICON + 3.0, at[1]), (at[0] + ICON - 3.0, at[1])]


def _wall_seen(canvas: Canvas, at: Point) -> None:
    place = Viewport(at[0] - ICON - 3.0, at[1] - ROW / 2, 2 * ICON + 6.0, ROW)
    with canvas.within(place), canvas.highlighter():
        marks.wall_seen(canvas, _bar(at))
    canvas.stroke(_bar(at), palette.WALL, 2.4)


def _glass(canvas: Canvas, at: Point) -> None:
    marks.glass(canvas, _bar(at), 4.0)


def _door_remembered(canvas: Canvas, at: Point) -> None:
    marks.door_remembered(canvas, _bar(at))


def _badge(canvas: Canvas, at: Point) -> None:
    marks.badge(canvas, at, 1)


def _corner(kind: CornerKind) -> Callable[[Canvas, Point], None]:
    return lambda canvas, at: marks.corner(canvas, at, kind)


def _corridor(canvas: Canvas, at: Point) -> None:
    (start, end) = _bar(at)
    marks.corridor(canvas, start, end)


def _hits(canvas: Canvas, at: Point) -> None:
    marks.hits(canvas, [(at[0] + 4.0 * k, at[1] + 1.5 * (-1) ** k) for k in (-2, -1, 0, 1, 2)])


def _flag(canvas: Canvas, at: Point) -> None:
    marks.flag(canvas, (at[0] - 4.0, at[1] + 6.0), height=15.0)


_ENTRIES: tuple[tuple[str, Callable[[Canvas, Point], None]], ...] = (
    ("wall", _wall_seen),
    ("door", lambda canvas, at: marks.door_seen(canvas, _bar(at))),
    ("outer corner", _corner(CornerKind.OUTER)),
    ("inner corner", _corner(CornerKind.INNER)),
    ("potential corner", _corner(CornerKind.POTENTIAL)),
    ("corridor", _corridor),
    ("lidar hit", _hits),
    ("wall in memory", lambda canvas, at: marks.wall_remembered(canvas, _bar(at))),
    ("door in memory", _door_remembered),
    ("door number", _badge),
    ("goal", _flag),
    ("path so far", lambda canvas, at: marks.trail(canvas, _bar(at))),
    ("true route", lambda canvas, at: marks.route(canvas, _bar(at))),
    ("glass", _glass),
)
