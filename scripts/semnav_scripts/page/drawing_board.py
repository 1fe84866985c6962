"""A floor plan of the visitor's own: read from a file, drawn on, with every step kept for undo."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from semnav_env.world.maps import FloorPlan
from semnav_env.world.maps.check import check
from semnav_env.world.maps.door_drawing import with_door
from semnav_env.world.maps.editing import (
    scaled,
    with_corridor,
    with_room,
    with_wall,
    without_part,
)
from semnav_env.world.maps.importers import ImportedPlan, import_map
from semnav_env.world.maps.importers.occupancy import IMAGE_SUFFIXES
from semnav_env.world.maps.reader import parse_plan
from semnav_features.writing import write_file
from semnav_scripts.page.plan_message import plan_message
from semnav_scripts.page.requests import DrawRequest

PROVISIONAL_RESOLUTION = 0.05
"""Metres per pixel of an image, as most robots map; a known length corrects it."""

SUFFIXES = (".geojson", ".json", ".csv", ".svg", ".dxf", ".xml", *IMAGE_SUFFIXES)
"""Kinds of files that are taken: those that name no other file."""

MAX_STEPS = 100
"""The most steps that can be undone."""

CHANGES: dict[str, Callable[[FloorPlan, DrawRequest], FloorPlan]] = {
    "door": lambda plan, asked: with_door(plan, *asked.line, asked.name),
    "wall": lambda plan, asked: with_wall(plan, *asked.line),
    "room": lambda plan, asked: with_room(plan, asked.place, asked.name),
    "corridor": lambda plan, asked: with_corridor(plan, *asked.line, asked.name),
    "scale": lambda plan, asked: scaled(plan, *asked.line, asked.length or 0.0),
    "erase": lambda plan, asked: without_part(plan, asked.place),
}
"""What can be drawn, by its tool."""


class DrawingBoard:
    """The states of a floor plan that is drawn on; it never holds one that breaks a rule.

    Args:
        plan: the first state.
        notes: what is to be known of it, one line each.

    Attributes:
        notes: as given.
    """

    def __init__(self, plan: FloorPlan, notes: tuple[str, ...] = ()) -> None:
        self.notes = notes
        self._done, self._undone = [plan], list[FloorPlan]()

    @classmethod
    def from_file(cls, name: str, content: bytes) -> DrawingBoard:
        """The board with the floor plan in a file.

        Args:
            name: of the file; its suffix says of which kind it is.
            content: of the file.

        Raises:
            ValueError: it is of no known kind, or damaged, or breaks a rule of floor plans.
        """
        suffix = Path(name).suffix.lower()
        if suffix not in SUFFIXES:
            raise ValueError(f"{name}: no floor plan of a known kind; give {', '.join(SUFFIXES)}")
        if suffix == ".geojson":
            return cls(_read(name, content))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"plan{suffix}"
            write_file(path, content)
            is_image = suffix in IMAGE_SUFFIXES
            try:
                found = import_map(path, PROVISIONAL_RESOLUTION if is_image else None)
            except ValueError as error:
                raise ValueError(str(error).replace(str(path), name)) from None
        return cls(found.plan, _notes(found, is_image))

    @property
    def plan(self) -> FloorPlan:
        """The present state."""
        return self._done[-1]

    def draw(self, asked: DrawRequest) -> None:
        """Make a step, or take one back.

        Raises:
            ValueError: it cannot be drawn so (`FloorPlanError`), or there is nothing to take back.
        """
        if asked.tool in CHANGES:
            self._done.append(CHANGES[asked.tool](self.plan, asked))
            self._undone.clear()
            del self._done[: -MAX_STEPS - 1]
        elif asked.tool == "undo":
            if len(self._done) == 1:
                raise ValueError("nothing is left to undo")
            self._undone.append(self._done.pop())
        elif asked.tool == "redo":
            if not self._undone:
                raise ValueError("nothing was undone")
            self._done.append(self._undone.pop())

    def message(self, checked: bool = False) -> dict[str, Any]:
        """The board as the page draws it.

        Args:
            checked: whether to search for faults, which takes seconds.
        """
        faults = check(self.plan) if checked else None
        return {
            "type": "board",
            "plan": plan_message(self.plan),
            "notes": list(self.notes),
            "undo": len(self._done) - 1,
            "redo": len(self._undone),
            "faults": None if faults is None else [{"text": str(f), "at": f.where} for f in faults],
        }


def _read(name: str, content: bytes) -> FloorPlan:
    """The floor plan of the project's own format; nothing about it is guessed."""
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError:
        raise ValueError(f"{name}: not UTF-8") from None
    return parse_plan(text, name, Path(name).stem)


def _notes(found: ImportedPlan, is_image: bool) -> tuple[str, ...]:
    taken = ", ".join(f"{count} {name}" for name, count in found.report.taken.items())
    scale = f"{PROVISIONAL_RESOLUTION} m a pixel is a guess: draw a length that you know"
    lines = (f"{found.report.kind}: {taken}", *found.report.left_out, *found.report.notes)
    return (scale, *lines) if is_image else lines
