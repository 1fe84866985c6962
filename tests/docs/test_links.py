"""Links of the documentation lead to files, and to headings that are in them."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tests.support.paths import ROOT

PAGES = sorted(
    path.relative_to(ROOT).as_posix() for path in (*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"))
)


def links(page: str) -> list[tuple[str, str]]:
    """The links of a page into the checkout, each as (file or "", heading or "")."""
    text = re.sub(r"(?ms)^ *```.*?^ *```", "", (ROOT / page).read_text("utf-8"))
    found = re.findall(r"\]\(([^)#\s]*)#?([^)\s]*)\)", text)
    return [link for link in found if not link[0].startswith(("http", "<"))]


def anchors(path: Path) -> set[str]:
    """The headings of a page as GitHub and MyST name them in links."""
    text = re.sub(r"(?ms)^ *```.*?^ *```", "", path.read_text("utf-8"))
    headings = re.findall(r"^#{1,3} (.+)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_to_files(page: str) -> None:
    folder = (ROOT / page).parent
    assert [name for name, _ in links(page) if name and not (folder / name).exists()] == []


@pytest.mark.parametrize("page", PAGES)
def test_links_lead_to_headings(page: str) -> None:
    folder, own = (ROOT / page).parent, Path(page).name
    named = [(name or own, heading) for name, heading in links(page) if heading]
    assert [link for link in named if link[1] not in anchors(folder / link[0])] == []
