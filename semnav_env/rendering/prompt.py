"""The field over the map in which a command is typed."""

from __future__ import annotations

from semnav_env.rendering import palette
from semnav_env.rendering.camera import Viewport
from semnav_env.rendering.canvas import Canvas
from semnav_env.rendering.text import wrap

TEXT_SIZE, LINE_HEIGHT = 14.0, 21.0
"""Size of the text and height of its lines, units of the page."""

PADDING, GAP = 12.0, 14.0
"""Distance of the text from the edge of the field, and of the field from that of the map, units."""

MAX_LINES = 4
"""The most lines that are shown."""


def draw_prompt(canvas: Canvas, view: Viewport, text: str) -> None:
    """Draw the field at the top of the map, as high as its text."""
    width = view.width - 2 * GAP
    lines = wrap(
        text, width - 2 * PADDING, lambda line: canvas.text_width(line, TEXT_SIZE), MAX_LINES
    )
    height = LINE_HEIGHT * len(lines) + PADDING
    field = Viewport(view.left + GAP, view.top + GAP, width, height)
    canvas.box(field, palette.ACTIVE_EDGE, 7.0)
    inner = Viewport(field.left + 2.0, field.top + 2.0, width - 4.0, height - 4.0)
    canvas.box(inner, palette.WHITE, 5.0)
    for k, line in enumerate(lines):
        y = field.top + PADDING / 2 + LINE_HEIGHT * (k + 0.5)
        canvas.text((field.left + PADDING, y), line, palette.INK, TEXT_SIZE)
