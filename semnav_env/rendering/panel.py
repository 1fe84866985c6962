"""The panel beside the map: the command, its active clause, and the state of the run."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from semnav_env.language.languages import language_of
from semnav_env.language.told import in_words_of
from semnav_env.rendering import palette
from semnav_env.rendering.camera import Viewport
from semnav_env.rendering.canvas import Canvas
from semnav_env.rendering.frame import Frame
from semnav_env.rendering.legend import LEGEND_HEIGHT, draw_legend
from semnav_env.rendering.picture_words import label
from semnav_env.rendering.text import wrap

PANEL_WIDTH = 284.0
"""Width of the panel, units of the page."""

PANEL_PADDING = 16.0
"""Distance from the panel's edge to its text, units."""

LINE_HEIGHT = 19.0
"""Height of a line of text, units."""

CLAUSE_INDENT = 30.0
"""Distance from the panel's text to the text of a clause, past its mark, units."""


@dataclass(frozen=True)
class Column:
    """A column of the page in which text is set."""

    canvas: Canvas
    left: float
    width: float

    def wrapped(self, text: str, size: float, bold: bool = False, most: int = 4) -> tuple[str, ...]:
        """The lines of a text in this column."""
        return wrap(text, self.width, lambda line: self.canvas.text_width(line, size, bold), most)

    def indented(self, by: float) -> Column:
        """The column with a larger left margin and a little more on the right."""
        return Column(self.canvas, self.left + by, self.width - by - 6.0)

    def heading(self, y: float, text: str) -> None:
        """Draw a small heading over a thin rule."""
        self.canvas.text((self.left, y), text, palette.MUTED, 10.0, bold=True)
        rule = self.left + self.canvas.text_width(text, 10.0, bold=True) + 8.0
        self.canvas.stroke([(rule, y), (self.left + self.width, y)], palette.HAIRLINE, 1.0)


@dataclass(frozen=True)
class PanelEntry:
    """The layout of a clause: its lines, and for the active one its interpretation below."""

    index: int
    lines: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def height(self) -> float:
        """Height with the space around it, units of the page."""
        return LINE_HEIGHT * len(self.lines) + 16.0 * len(self.notes) + 14.0


def draw_panel(canvas: Canvas, panel: Viewport, frame: Frame) -> None:
    """Draw the panel on a background of its own."""
    canvas.box(panel, palette.PANEL)
    canvas.stroke([(panel.left, 0.0), (panel.left, panel.height)], palette.HAIRLINE, 1.0)
    column = Column(canvas, panel.left + PANEL_PADDING, panel.width - 2 * PANEL_PADDING)
    with canvas.within(panel):
        _draw_title(column, frame)
        legend_top = panel.height - LEGEND_HEIGHT
        column.heading(legend_top, label("LEGEND", frame.language))
        draw_legend(canvas, column.left, legend_top + 22.0, frame)
        status_top = _draw_status(column, legend_top - 12.0, frame)
        _draw_command(column, 84.0, status_top - 12.0, frame)


def _draw_title(column: Column, frame: Frame) -> None:
    title = frame.floor_plan.name.replace("_", " ")
    (line,) = column.wrapped(title, 16.0, bold=True, most=1)
    column.canvas.text((column.left, 29.0), line, palette.INK, 16.0, bold=True)
    name = label(frame.robot.name, frame.language)
    column.canvas.text((column.left, 51.0), name, palette.MUTED, 12.5)


def _draw_status(column: Column, bottom: float, frame: Frame) -> float:
    """Draw the status upwards from the legend; returns the height at which it begins."""
    spaced = (re.sub(r" {2,}", " · ", text.strip()) for text in frame.status)
    lines = [line for text in spaced for line in column.wrapped(text, 12.5, most=3)][:7]
    top = bottom - 18.0 * len(lines) - (34.0 if frame.in_contact else 0.0)
    y = top
    if frame.in_contact:
        chip = Viewport(column.left, y, column.width, 24.0)
        column.canvas.box(chip, palette.CONTACT, 6.0)
        centre = column.left + column.width / 2, y + 12.0
        said = label("contact", frame.language)
        column.canvas.text(centre, said, palette.WHITE, 12.5, bold=True, centred=True)
        y += 34.0
    for line in lines:
        column.canvas.text((column.left, y + 9.0), line, palette.INK, 12.5)
        y += 18.0
    return top


def _draw_command(column: Column, top: float, bottom: float, frame: Frame) -> None:
    column.heading(top, label("COMMAND", frame.language))
    inner = column.indented(CLAUSE_INDENT)
    entries = [_entry(inner, frame, index) for index in _nearby(frame)]
    shown = _fitting(entries, frame.active_clause, bottom - top - 52.0)
    y = top + 18.0
    if shown and shown[0].index > 0:
        before = f"{shown[0].index} {label('before', frame.language)}"
        column.canvas.text((inner.left, y + 6.0), before, palette.MUTED, 11.0)
    y += 16.0 if shown and shown[0].index > 0 else 0.0
    for entry in shown:
        _draw_entry(column, inner, y, entry, frame)
        y += entry.height
    after = len(frame.command) - 1 - shown[-1].index if shown else 0
    if after > 0:
        more = f"{after} {label('more', frame.language)}"
        column.canvas.text((inner.left, y + 8.0), more, palette.MUTED, 11.0)


def _nearby(frame: Frame) -> range:
    """The clauses that could be shown together with the active one."""
    return range(
        max(0, frame.active_clause - 12), min(len(frame.command), frame.active_clause + 12)
    )


def _entry(inner: Column, frame: Frame, index: int) -> PanelEntry:
    active = index == frame.active_clause
    notes: tuple[str, ...] = ()
    if active and frame.goal is not None and frame.goal.because:
        told = in_words_of(language_of(frame.language), frame.goal.because)
        notes = inner.wrapped(told, 11.0, most=4)
    return PanelEntry(index, inner.wrapped(frame.command[index], 13.5, active), notes)


def _fitting(entries: Sequence[PanelEntry], active: int, room: float) -> list[PanelEntry]:
    """The clauses that fit, in order; those nearest to the active one have precedence."""
    shown: list[PanelEntry] = []
    for entry in sorted(entries, key=lambda entry: (abs(entry.index - active), -entry.index)):
        room -= entry.height
        if room < 0 and shown:
            break
        shown.append(entry)
    return sorted(shown, key=lambda entry: entry.index)


def _draw_entry(column: Column, inner: Column, y: float, entry: PanelEntry, frame: Frame) -> None:
    canvas, active = column.canvas, frame.active_clause
    if entry.index == active:
        ground = Viewport(column.left - 8.0, y, column.width + 16.0, entry.height - 3.0)
        canvas.box(ground, palette.ACTIVE_EDGE, 7.0)
        ground = Viewport(ground.left + 4.0, y, ground.width - 4.0, ground.height)
        canvas.box(ground, palette.ACTIVE, 5.0)
    at = column.left + 11.0, y + 15.0
    if entry.index == active and frame.failed:
        _draw_cross(canvas, at)
    else:
        relative = 1 if entry.index in frame.skipped else entry.index - active
        _draw_mark(canvas, at, relative, entry.index + 1)
    colour = palette.INK if entry.index == active else palette.MUTED
    y += 15.0
    for line in entry.lines:
        canvas.text((inner.left, y), line, colour, 13.5, bold=entry.index == active)
        y += LINE_HEIGHT
    for note in entry.notes:
        canvas.text((inner.left, y), note, palette.MUTED, 11.0)
        y += 16.0


def _draw_cross(canvas: Canvas, at: tuple[float, float]) -> None:
    """Draw the mark of a clause that has failed."""
    x, y = at
    canvas.discs([at], 9.0, palette.CONTACT)
    for sign in (1.0, -1.0):
        canvas.stroke([(x - 3.6, y - 3.6 * sign), (x + 3.6, y + 3.6 * sign)], palette.WHITE, 2.0)


def _draw_mark(canvas: Canvas, at: tuple[float, float], relative: int, number: int) -> None:
    """Draw a tick for a clause that is done, else its number, filled for the active one."""
    x, y = at
    if relative < 0:
        canvas.discs([at], 9.0, palette.DONE)
        tick = [(x - 4.0, y + 0.3), (x - 1.2, y + 3.4), (x + 4.4, y - 3.2)]
        canvas.stroke(tick, palette.WHITE, 2.0)
        return
    if relative == 0:
        canvas.discs([at], 9.0, palette.ACTIVE_EDGE)
    else:
        canvas.ring(at, 8.0, palette.MUTED, 1.4)
    colour = palette.WHITE if relative == 0 else palette.MUTED
    canvas.text(at, str(number), colour, 11.0, bold=True, centred=True)
