"""Writes docs/gallery.md: every picture of the documentation, with the page that shows it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from semnav_features.writing import write_file
from studies.figures import IMAGES

DOCS = IMAGES.parent
PAGE = DOCS / "gallery.md"
COLUMNS = 3
TEMPLATE = """# Gallery

Every picture of the documentation, drawn by a script (`python -m studies.figures --help`). A
picture leads to the page that explains it.
"""
"""What stands before the pictures."""

TOCTREE = re.compile(r"(?ms)^```{toctree}\n(.*?)^```")
PICTURE = re.compile(r"!\[([^\]]+)\]\((?:\.\./)?images/([\w.-]+)\)")


def chapters() -> Iterator[tuple[str, list[str]]]:
    """The chapters of the front page, each with its pages."""
    for tree in TOCTREE.findall((DOCS / "index.md").read_text("utf-8")):
        caption = re.search(r":caption: (.+)", tree)
        assert caption is not None
        yield caption[1], re.findall(r"(?m)^[\w/]+$", tree)


def cells(pages: list[str], shown: set[str]) -> Iterator[str]:
    """A cell for each picture of these pages that is not shown yet."""
    for page in pages:
        path = DOCS / f"{page}.md"
        for words, picture in PICTURE.findall(path.read_text("utf-8") if path != PAGE else ""):
            if picture not in shown:
                shown.add(picture)
                yield f"[![{words}](images/{picture})]({page}.md)<br>{words}"


def table(pictures: list[str]) -> str:
    """The cells as a table of `COLUMNS` columns."""
    full = pictures + [" "] * (-len(pictures) % COLUMNS)
    rows = [full[k : k + COLUMNS] for k in range(0, len(full), COLUMNS)]
    head = [[" "] * COLUMNS, ["---"] * COLUMNS]
    return "\n".join(f"| {' | '.join(row)} |" for row in head + rows)


def page() -> str:
    """The text of the page, of the pages as they are."""
    shown: set[str] = set()
    parts = [TEMPLATE]
    for caption, pages in chapters():
        if pictures := list(cells(pages, shown)):
            parts.append(f"## {caption}\n\n{table(pictures)}\n")
    return "\n".join(parts)


def main() -> None:
    """Write the page."""
    write_file(PAGE, page())
    print(f"wrote {PAGE}")
