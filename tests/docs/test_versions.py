"""The version is said everywhere alike."""

from __future__ import annotations

import re
import tomllib
from typing import Any

import pytest
import yaml

from semnav_scripts.node import LAUNCH_FILES
from tests.support.paths import ROOT

PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
CITATION: dict[str, Any] = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
HEADING = re.search(r"^## \[(.+)\] - (.+)$", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.M)


def test_the_version_is_everywhere_the_same() -> None:
    """The date of a release stands in CHANGELOG.md, and nowhere else."""
    assert HEADING is not None
    assert HEADING[1] == PROJECT["version"] == CITATION["version"]
    assert f"<version>{HEADING[1]}</version>" in (LAUNCH_FILES / "package.xml").read_text("utf-8")
    assert HEADING[2] == "unreleased" or re.fullmatch(r"20\d\d-[01]\d-[0-3]\d", HEADING[2])
    assert "date-released" not in CITATION


def test_the_licence_is_everywhere_the_same() -> None:
    assert PROJECT["license"] == CITATION["license"] == "MIT"
    assert (ROOT / "LICENSE").read_text("utf-8").startswith("MIT License")


@pytest.mark.parametrize("name", ["bug_report", "idea", "misunderstood"])
def test_a_template_of_an_issue_asks_for_something(name: str) -> None:
    path = ROOT / ".github" / "ISSUE_TEMPLATE" / f"{name}.yml"
    form = yaml.safe_load(path.read_text("utf-8"))
    assert form["name"]
    assert form["description"]
    kinds = {"input", "textarea", "checkboxes"}
    assert {part["type"] for part in form["body"]} <= kinds
    assert len({part["id"] for part in form["body"]}) == len(form["body"])
