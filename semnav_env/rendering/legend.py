"""The legend of the picture, drawn with the same marks as the map."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from semnav_env.rendering import marks, palette
from semnav_env.rendering.camera import Viewport
from semnav_env.rendering.canvas import Canvas
from semnav_env.rendering.frame import Frame
from semnav_env.rendering.picture_words import label
from semnav_env.world.maps.floor_plan import Material
from semnav_features.frames import Point
from semnav_features.scene import CornerKind

Entry: TypeAlias = tuple[str, Callable[[Canvas, Point], None]]
"""Name of a symbol and the function that draws it."""

ROW_HEIGHT = 20.0
"""Height of a row, units of the page."""

COLUMN_WIDTH = 130.0
"""Width of a column, units of the page."""

ICON_HALF_WIDTH = 13.0
"""Half the width of a symbol's place, units of the page."""

LEGEND_HEIGHT = 196.0
"""Height of the legend with its heading and nine rows, to the end of the page, units."""


def draw_legend(canvas: Canvas, left: float, top: float, frame: Frame) -> None:
    """Draw two columns of symbols with their names; `top` is the middle of the first row."""
    entries = legend_entries(frame)
    rows = -(-len(entries) // 2)
    for index, (name, draw) in enumerate(entries):
        x, y = left + COLUMN_WIDTH * (index // rows), top + ROW_HEIGHT * (index % rows)
        draw(canvas, (x + ICON_HALF_WIDTH, y))
        place = x + 2 * ICON_HALF_WIDTH + 7.0, y
        canvas.text(place, label(name, frame.language), palette.INK, 11.0)


def legend_entries(frame: Frame) -> tuple[Entry, ...]:
    """Entries of what every episode shows and what this one shows, the same in all its frames."""
    plan = frame.floor_plan
    made_of = {surface.material for surface in plan.surfaces}
    closed = not all(door.open for door in plan.doors)
    shown = (
        any(s.assumed and s.material is Material.WALL for s in plan.surfaces),
        Material.GLASS in made_of,
        Material.LEAF in made_of or closed or len(frame.leaves) > 0,
        Material.FURNITURE in made_of,
        len(frame.people) > 0 or Material.PERSON in made_of,
        len(frame.cloud) > 0,
        len(frame.cloud) > 0,
    )
    return _ENTRIES + tuple(
        entry for entry, is_shown in zip(_OPTIONAL_ENTRIES, shown, strict=True) if is_shown
    )


def _bar(at: Point) -> list[Point]:
    return [(at[0] - ICON_HALF_WIDTH + 3.0, at[1]), (at[0] + ICON_HALF_WIDTH - 3.0, at[1])]


def _wall_seen(canvas: Canvas, at: Point) -> None:
    place = Viewport(
        at[0] - ICON_HALF_WIDTH - 3.0, at[1] - ROW_HEIGHT / 2, 2 * ICON_HALF_WIDTH + 6.0, ROW_HEIGHT
    )
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


def _cloud(canvas: Canvas, at: Point) -> None:
    marks.cloud(canvas, [(at[0] + 2.5 * k, at[1] + (-1) ** k) for k in range(-4, 5)])


def _flag(canvas: Canvas, at: Point) -> None:
    marks.flag(canvas, (at[0] - 4.0, at[1] + 6.0), height=15.0)


def _furniture(canvas: Canvas, at: Point) -> None:
    (x1, y), (x2, _) = _bar(at)
    marks.furniture(canvas, [(x1, y - 5), (x2, y - 5), (x2, y + 5), (x1, y + 5), (x1, y - 5)])


_ENTRIES: tuple[Entry, ...] = (
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
)
_OPTIONAL_ENTRIES: tuple[Entry, ...] = (
    ("assumed wall", lambda canvas, at: marks.wall_assumed(canvas, _bar(at))),
    ("glass", _glass),
    ("door leaf", lambda canvas, at: marks.leaf(canvas, _bar(at), 0.0)),
    ("furniture", _furniture),
    ("person", lambda canvas, at: marks.person(canvas, at, 7.0)),
    ("depth points", _cloud),
    ("jamb found", lambda canvas, at: marks.jamb(canvas, at)),
)
