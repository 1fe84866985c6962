"""Tables that are read by people as Markdown and by programs as JSON."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

Cell: TypeAlias = str | int | float


@dataclass(frozen=True)
class ResultSheet:
    """A table.

    Attributes:
        title: what it is about.
        columns: their names, with the unit.
        rows: as long as `columns`; NaN where there is nothing to tell.
    """

    title: str
    columns: tuple[str, ...]
    rows: Sequence[tuple[Cell, ...]]

    def markdown(self) -> str:
        """As a section of a page."""
        head = [" | ".join(self.columns), " | ".join("---" for _ in self.columns)]
        body = [" | ".join(_written(cell) for cell in row) for row in self.rows]
        return f"## {self.title}\n\n" + "\n".join(f"| {line} |" for line in (*head, *body))

    def records(self) -> list[dict[str, Any]]:
        """One dictionary for each row, with None for NaN."""
        return [
            {name: _plain(cell) for name, cell in zip(self.columns, row, strict=True)}
            for row in self.rows
        ]


def _written(cell: Cell) -> str:
    if isinstance(cell, float):
        return "-" if math.isnan(cell) else f"{cell:.3f}"
    return str(cell)


def _plain(cell: Cell) -> Cell | None:
    return None if isinstance(cell, float) and math.isnan(cell) else cell
