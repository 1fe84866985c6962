"""Case 16: the pages of the documentation are found, and its reference names what there is."""

from __future__ import annotations

import inspect
import re
from importlib import import_module

import pytest

from semnav_env.env import SemNavEnv
from semnav_env.plain_settings import SETTINGS
from tests.support.paths import ROOT

DOCS = ROOT / "docs"
LISTED = re.findall(r"^[\w/]+$", (DOCS / "index.md").read_text(), re.MULTILINE)
NAMED = [
    (page.stem, kind, *target.rsplit(".", 1))
    for page in sorted((DOCS / "reference").glob("*.md"))
    for kind, target in re.findall(r"auto(class|function):: ([\w.]+)", page.read_text())
]


def test_every_page_is_in_the_index() -> None:
    """A page that is missing there is found by nobody, and ends the build with `-W`."""
    pages = {path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.rglob("*.md")}
    assert pages - {"index"} == set(LISTED)
    assert len(LISTED) == len(set(LISTED))


@pytest.mark.parametrize(("page", "kind", "module", "name"), NAMED)
def test_the_reference_names_what_there_is(page: str, kind: str, module: str, name: str) -> None:
    found = getattr(import_module(module), name)
    assert inspect.isclass(found) == (kind == "class")
    assert inspect.getdoc(found)


def test_the_contract_and_all_settings_are_in_the_reference() -> None:
    names = {name for _, _, _, name in NAMED}
    assert {SemNavEnv.__name__, *(kind.__name__ for kind in SETTINGS.values())} <= names


def test_the_members_that_the_reference_shows_exist() -> None:
    for page in (DOCS / "reference").glob("*.md"):
        shown = re.findall(r"autoclass:: ([\w.]+)\n   :members: (.+)", page.read_text())
        for target, members in shown:
            module, name = target.rsplit(".", 1)
            for member in members.split(", "):
                assert hasattr(getattr(import_module(module), name), member), (target, member)
