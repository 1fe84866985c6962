"""Pages of the documentation that a script writes say what the code says."""

from __future__ import annotations

import re

import pytest

from semnav_env.env import SemNavEnv
from semnav_env.mind.observations import MODES
from studies.figures import (
    approach,
    architecture,
    gallery,
    leaderboard,
    licences,
    observation_table,
)
from tests.support.paths import source


def test_the_page_of_entries_is_what_the_layout_declares() -> None:
    """If this fails: `python -m studies.figures observation_table`."""
    assert observation_table.PAGE.read_text(encoding="utf-8") == observation_table.page()


def test_the_page_of_folders_shows_their_imports() -> None:
    """The counts of lines may differ. If this fails: `python -m studies.figures architecture`."""
    shown = architecture.PAGE.read_text(encoding="utf-8")
    assert _without_numbers(shown) == _without_numbers(architecture.page())


def test_the_page_of_approaches_has_the_tables_as_computed() -> None:
    """If this fails: `python -m studies.figures approach`."""
    shown = approach.PAGE.read_text(encoding="utf-8")
    assert shown == approach.page(shown)


def test_the_leaderboard_is_that_of_the_kept_results() -> None:
    """If this fails: `python -m studies.figures leaderboard`."""
    shown = leaderboard.PAGE.read_text(encoding="utf-8")
    assert "| `val_unseen` | wheelchair | `drive` |" in shown
    assert shown == leaderboard.page(shown)


def test_the_licences_are_those_of_the_packages_that_are_asked_for() -> None:
    """Versions may differ. If this fails: `python -m studies.figures licences`."""
    asked = licences.asked_for()
    try:
        rows = licences.direct_rows(asked)
    except ValueError as error:
        pytest.skip(str(error))
    shown = licences.PAGE.read_text(encoding="utf-8").split("\n## ")[1]
    found = [row for row in shown.splitlines() if row.startswith("| ")][1:]
    assert _without_versions(found) == _without_versions(rows)


def test_the_gallery_shows_every_picture_of_the_pages() -> None:
    """If this fails: `python -m studies.figures gallery`."""
    shown = gallery.PAGE.read_text(encoding="utf-8")
    assert shown == gallery.page()
    assert all(f"images/{each.name})" in shown for each in gallery.IMAGES.iterdir())


def test_the_licence_of_what_is_not_installed_is_not_made_up() -> None:
    with pytest.raises(ValueError, match="no-such-package is not installed"):
        licences.licence_of("no-such-package")


def test_the_files_of_the_three_walks_exist() -> None:
    named = set(re.findall(r"\((\w+(?:/\w+)+\.py)\)", architecture.TEMPLATE.replace("`", "")))
    assert len(named) > 10
    for name in named:
        assert source(name).exists(), name


def test_the_contract_names_every_entry() -> None:
    text = SemNavEnv.__doc__ or ""
    for name in MODES["all"]:
        assert name.removesuffix("_mask") in text, name


def _without_versions(rows: list[str]) -> list[list[str]]:
    """The cells of rows but the second."""
    cells = (row.split(" | ") for row in rows)
    return [[first, *others] for first, _, *others in cells]


def _without_numbers(text: str) -> str:
    return re.sub(r"[\d.]+", "#", text)
