"""`python -m studies theses`: the table of every item of the four documents."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

from semnav_features.writing import replacing
from studies.theses.items import ITEMS
from studies.theses.lab_tables import DOCS

HEAD = """# The four documents, item by item

The project is built from four documents. This page has a row for each of their items that can be
compared: what they report, what is measured here, and the command that measures it.
`python -m studies theses` makes it from the tables of the pages that describe the measurements, so
no figure is written twice. *Wished for* is what a document names as future work. `DATA` is the
folder with the real logs.
"""

SOURCES = {
    "Barbret 2021": "Geometric Feature Extraction for Indoor Navigation, bachelor's thesis",
    "Weerakoon et al.": "Geometric Feature Extraction from 2D Laser Range Data for Mobile Robot "
    "Navigation",
    "Yan et al.": "Arc/line segments extraction from unknown indoor environment with laser sensor",
    "Mes 2021": "Point planning and drift correction based on reliable door detection, thesis",
}
"""Title of each document."""


@dataclass(frozen=True)
class Arguments:
    """Write the table of every item of the four documents.

    Attributes:
        out: the page to write; that of the documentation if not given.
    """

    out: Path = DOCS / "theses.md"

    def run(self) -> int:
        """Read the figures, and write the page."""
        with replacing(self.out) as part:
            Path(part).write_text(page(), encoding="utf-8")
        print(f"{len(ITEMS)} items: {self.out}")
        return 0


def page() -> str:
    """The whole page as Markdown."""
    parts = [HEAD]
    for document, items in groupby(ITEMS, lambda item: item.document):
        lines = [f"## {document}", "", f"*{SOURCES[document]}*", ""]
        lines += ["| section | what | theirs | here | command |", "|---|---|---|---|---|"]
        lines += [f"| {' | '.join(item.row())} |" for item in items]
        parts.append("\n".join(lines) + "\n")
    return "\n".join(parts)
