"""The table of every item of the four documents."""

from __future__ import annotations

from pathlib import Path

import pytest

from semnav_scripts.main import SEMNAV
from studies.__main__ import STUDIES
from studies.theses.command import SOURCES, page
from studies.theses.items import ITEMS
from studies.theses.lab_tables import DOCS, Figure


def test_the_page_is_made_of_the_tables_as_they_are() -> None:
    assert (DOCS / "theses.md").read_text(encoding="utf-8") == page()


def test_every_document_has_its_section() -> None:
    assert list(dict.fromkeys(item.document for item in ITEMS)) == list(SOURCES)


@pytest.mark.parametrize("item", ITEMS, ids=lambda item: f"{item.document} {item.what}")
def test_every_item_has_a_command_that_exists(item) -> None:
    words = item.command.split()
    if words[0] == "semnav":
        assert words[1] in {name.split()[0] for name in SEMNAV.commands}
    elif words[2] == "studies.figures":
        assert (Path(DOCS).parent / "studies" / "figures" / f"{words[3]}.py").exists()
    else:
        assert words[:3] == ["python", "-m", "studies"]
        assert words[3] in STUDIES.commands


@pytest.mark.parametrize(
    ("row", "column"), [(("nobody",), "recall"), (("thesis", "walls"), "nothing")]
)
def test_a_figure_that_no_table_has_is_named(row: tuple[str, ...], column: str) -> None:
    with pytest.raises(ValueError, match=r"lab/features\.md has no table with a row"):
        Figure("lab/features.md", row, column).read()
