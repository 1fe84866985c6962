"""Each row of docs/capabilities.md names a test and commands that there are; none is missing."""

from __future__ import annotations

import re

import pytest

from semnav_scripts.main import SEMNAV
from semnav_scripts.map import COMMANDS
from tests.support.paths import ROOT, TESTS

PAGE = (ROOT / "docs" / "capabilities.md").read_text("utf-8")
NAMED = sorted(set(re.findall(r"`([\w/]+\.py)::(\w+)`", PAGE)))
COMMAND_NAMES = {*SEMNAV.commands, *(f"map {name}" for name in COMMANDS.commands)} - {"map"}


@pytest.mark.parametrize(("file", "test"), NAMED)
def test_every_named_test_exists(file: str, test: str) -> None:
    assert f"\ndef {test}(" in (TESTS / file).read_text("utf-8")


def test_every_row_names_a_test() -> None:
    rows = [line for line in PAGE.splitlines() if re.match(r"\| (?!capability)\w", line)]
    assert [row for row in rows if not re.search(r"\| `[\w/]+\.py::test_\w+` \|$", row)] == []
    assert 80 <= len(rows) <= 160


def test_the_page_names_the_commands_that_there_are() -> None:
    shown = re.findall(r"`semnav ((?:map )?[a-z]+(?: language)?)", PAGE)
    assert set(shown) == COMMAND_NAMES
