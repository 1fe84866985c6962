"""Looks up figures in the tables of the documentation, so that none is written a second time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"
"""Where the pages are."""


@dataclass(frozen=True)
class Figure:
    """A cell of a table of a page.

    Attributes:
        page: path of the page in the documentation, such as "lab/lines.md".
        row: the first cells of the row.
        column: heading of the column.
        table: first columns of the table that is meant, if several have such a row.
    """

    page: str
    row: tuple[str, ...]
    column: str
    table: tuple[str, ...] = ()

    def read(self) -> str:
        """The text of the cell.

        Raises:
            ValueError: no table of the page has such a row and column.
        """
        for header, rows in tables(DOCS / self.page):
            if self.column not in header or header[: len(self.table)] != self.table:
                continue
            for row in rows:
                if row[: len(self.row)] == self.row:
                    return row[header.index(self.column)].replace("**", "")
        raise ValueError(f"{self.page} has no table with a row {self.row} and {self.column!r}")


def tables(page: Path) -> Iterator[tuple[tuple[str, ...], list[tuple[str, ...]]]]:
    """Heading and rows of each table of a Markdown page."""
    block: list[tuple[str, ...]] = []
    for line in [*page.read_text(encoding="utf-8").splitlines(), ""]:
        if line.startswith("|"):
            block.append(tuple([cell.strip() for cell in line.strip("|").split("|")]))
        elif block:
            yield block[0], block[2:]
            block = []
