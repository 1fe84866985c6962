"""The glossary: every name in it is there, and every group is in order."""

from __future__ import annotations

import re

import pytest

from tests.support.paths import ROOT, source

GROUPS = (ROOT / "docs" / "glossary.md").read_text("utf-8").split("\n## ")[1:]
ROWS = [
    [cell.strip() for cell in line.strip("|").split("|")]
    for group in GROUPS
    for line in group.splitlines()
    if re.match(r"\| (?!term )\w", line)
]


def sources(folder: str) -> str:
    """The text of the Python files of a folder, or of one file."""
    path = source(folder)
    files = [path] if path.is_file() else sorted(path.rglob("*.py"))
    return "\n".join(file.read_text("utf-8") for file in files)


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0])
def test_every_name_is_where_the_glossary_says(row: list[str]) -> None:
    for part in row[2].split(";"):
        *names, folder = re.findall(r"`([^`]+)`", part) or [""]
        if not folder:
            continue
        assert source(folder).exists(), folder
        text = sources(folder)
        for name in names:
            last = name.rpartition(".")[2]
            there = re.search(rf"(?m)^\s*(class|def) {last}\b|^\s*{last}\b *[:=]", text)
            assert there, f"{name} is not in {folder}"


@pytest.mark.parametrize("group", GROUPS, ids=lambda group: group.splitlines()[0])
def test_terms_are_in_alphabetical_order(group: str) -> None:
    terms = re.findall(r"(?m)^\| (?!term )(\w[^|]*) \|", group)
    first = [term.split(" | ")[0].strip() for term in terms]
    assert first == sorted(first, key=str.lower)
