"""The pages of the documentation are found, and its reference names what there is."""

from __future__ import annotations

import inspect
import re
import subprocess
import sys
from dataclasses import asdict
from html import unescape
from importlib import import_module
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

import gymnasium
import pytest

from semnav_env.env import SemNavEnv
from semnav_env.judge.tasks import RewardWeights
from semnav_env.plain_settings import SETTINGS
from tests.support.paths import ROOT

DOCS = ROOT / "docs"
PAGES = {path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.rglob("*.md")}
SPHINX_PAGES = {"search", "genindex", "modindex", "py-modindex"}
"""Pages that Sphinx writes itself, over a page of that name."""

LISTED = re.findall(r"^[\w/]+$", (DOCS / "index.md").read_text(), re.MULTILINE)
PICTURES = sorted(path.name for path in (DOCS / "images").iterdir())


def generated() -> ModuleType:
    """The module of the documentation that makes contracts and names."""
    spec = spec_from_file_location("generated", DOCS / "generated.py")
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


GENERATED = generated()
REFERENCE = {
    page.stem: GENERATED.filled(page.read_text("utf-8"))
    for page in sorted((DOCS / "reference").glob("*.md"))
}
"""The pages of the reference, with the names that the packages export."""

NAMED = [
    (page, kind, *target.rsplit(".", 1))
    for page, text in REFERENCE.items()
    for kind, target in re.findall(r"(class|function|data):: ([\w.]+)", text)
]


def test_every_page_is_in_the_index() -> None:
    """A page that is missing there is found by nobody, and ends the build with `-W`."""
    assert PAGES - {"index"} == set(LISTED)
    assert len(LISTED) == len(set(LISTED))


LONG = {"glossary", "reliability", "capabilities"}
"""Tables for looking things up, and pages that a script writes."""

FOR_USERS = {page for page in PAGES - LONG if not page.startswith(("lab/", "reference/"))}
"""Pages that are read from top to bottom."""


def test_a_page_for_users_is_short() -> None:
    """What a measurement was like, and what was tried, belongs to `docs/lab`."""
    texts = {page: (DOCS / f"{page}.md").read_text("utf-8") for page in FOR_USERS}
    shown = {
        page: re.sub(r"(?ms)^```{toctree}.*?^```\n*", "", text) for page, text in texts.items()
    }
    lines = {page: len(text.splitlines()) for page, text in shown.items()}
    assert {page: count for page, count in lines.items() if count > 150} == {}


def test_no_page_has_a_name_that_sphinx_writes_over() -> None:
    assert not PAGES & SPHINX_PAGES


@pytest.mark.slow
def test_every_source_becomes_a_page_with_its_own_heading(tmp_path: Path) -> None:
    """The file alone proves nothing: Sphinx's search page has the name of a page `search`."""
    for needed in ("sphinx", "furo", "myst_parser"):
        pytest.importorskip(needed, reason='pip install "semnav-env[docs]"')
    words = ["-W", "-q", "-b", "html", "-d", str(tmp_path / "doctrees"), str(DOCS), str(tmp_path)]
    subprocess.run([sys.executable, "-m", "sphinx", *words], check=True, cwd=ROOT)
    headings = {page: _heading(DOCS / f"{page}.md") for page in PAGES}
    built = {page: (tmp_path / f"{page}.html").read_text("utf-8") for page in PAGES}
    assert {page: _first_heading(html) for page, html in built.items()} == headings


def _heading(source: Path) -> str:
    """The words of the first heading of a page."""
    found = re.search(r"^# (.+)$", source.read_text("utf-8"), re.MULTILINE)
    assert found, source
    return found[1].replace("`", "").replace("'", "\u2019")  # Sphinx sets curly quotes


def _first_heading(html: str) -> str:
    """The words of the first heading of a built page, without the link to itself."""
    found = re.search(r"<h1>(.*?)<a class=\"headerlink\"", html, re.DOTALL)
    return unescape(re.sub("<[^>]+>", "", found[1])) if found else "no heading"


@pytest.mark.parametrize(("page", "kind", "module", "name"), NAMED)
def test_the_reference_names_what_there_is(page: str, kind: str, module: str, name: str) -> None:
    found = getattr(import_module(module), name)
    assert inspect.isclass(found) == (kind == "class")
    said = GENERATED.said_of_value(module, name) if kind == "data" else inspect.getdoc(found)
    assert said


def test_every_public_name_is_in_the_reference_once() -> None:
    """A package with names needs a line `<!-- names: package -->` in a page of the reference."""
    public = {
        f"{GENERATED.home(package, name)}.{name}"
        for package, names in GENERATED.public().items()
        for name in names
    }
    shown = [f"{module}.{name}" for _, _, module, name in NAMED]
    assert public - set(shown) == set()
    assert len(shown) == len(set(shown))


def test_the_contract_and_all_settings_are_in_the_reference() -> None:
    names = {name for _, _, _, name in NAMED}
    assert {SemNavEnv.__name__, *(kind.__name__ for kind in SETTINGS.values())} <= names


def test_the_members_that_the_reference_shows_exist() -> None:
    for text in REFERENCE.values():
        shown = re.findall(r"autoclass:: ([\w.]+)\n   :members: (.+)", text)
        for target, members in shown:
            module, name = target.rsplit(".", 1)
            for member in members.split(", "):
                assert hasattr(getattr(import_module(module), name), member), (target, member)


def test_every_environment_has_a_page_in_the_order_of_gymnasium() -> None:
    sections = [
        *("Description", "Action Space", "Observation Space", "Rewards", "Starting State"),
        *("Episode End", "Arguments", "Vectorized Environment", "Version History", "References"),
    ]
    ids = {name for name, spec in gymnasium.registry.items() if "semnav_env" in str(spec)}
    pages = {
        name: GENERATED.filled(page.read_text("utf-8"))
        for page in (DOCS / "environments").glob("*.md")
        for name in re.findall(r"^# ([\w-]+-v\d+)$", page.read_text("utf-8"), re.MULTILINE)
    }
    assert set(pages) == ids
    for name, text in pages.items():
        assert re.findall(r"^## (.+)$", text, re.MULTILINE) == sections, name
        assert "](../images/" in text, name


def test_the_contract_tells_the_weights_of_the_rewards() -> None:
    said = GENERATED.contract("SemNav-v0", "Rewards")
    for term, weight in asdict(RewardWeights()).items():
        assert re.search(rf"{term}`?: {weight:g}\b", said), term


@pytest.mark.parametrize("picture", PICTURES)
def test_a_script_draws_every_picture(picture: str) -> None:
    """And a page shows it."""
    scripts = "".join(path.read_text("utf-8") for path in (ROOT / "studies").rglob("*.py"))
    stem = re.sub(r"^(rule|features)_", "", picture.rpartition(".")[0])
    assert re.search(rf'"{re.escape(picture)}"|"(rule_)?{re.escape(stem)}"', scripts)
    explaining = PAGES - {"gallery"}
    assert any(picture in (DOCS / f"{page}.md").read_text("utf-8") for page in explaining)
