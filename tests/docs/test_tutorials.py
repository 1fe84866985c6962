"""The tutorials run as they are written, and print what they show."""

from __future__ import annotations

import doctest
from pathlib import Path

import pytest

from tests.support.paths import ROOT
from tests.support.running_pages import run_page

SAME = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE

SHORTER = {"learn(100_000)": "learn(1)", "n_steps=64": "n_steps=2, batch_size=8"}
"""What a page says, and what is run in its place."""

PAGES = sorted(
    path.relative_to(ROOT).as_posix()
    for folder in ("tutorials", "environments", "concepts")
    for path in (ROOT / "docs" / folder).glob("*.md")
    if "```python" in path.read_text("utf-8")
)
NEEDS = {"docs/tutorials/first_policy.md": "stable_baselines3"}
FRAGMENTS = {"docs/concepts/drift.md"}
"""Pages whose code is a part of a program of the reader's."""


@pytest.mark.parametrize("page", [page for page in PAGES if page not in FRAGMENTS])
def test_a_page_prints_what_it_shows(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """If this fails: what the page shows is not what one sees who types it."""
    if page in NEEDS:
        pytest.importorskip(NEEDS[page], reason='needs the extra "rl"')
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    for shown in run_page(page, SHORTER):
        same = shown.promised is None or doctest.OutputChecker().check_output(
            shown.promised, shown.printed, SAME
        )
        assert same, f"{shown.code}\nprinted\n{shown.printed}"


def test_the_script_of_your_floor_runs_as_often_as_one_likes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    blocks = run_page("docs/tutorials/your_floor.md")  # each runs when it is drawn
    script = next(shown.code for shown in blocks if "with_room" in shown.code)
    exec(compile(script, "script", "exec"), {})


def test_every_tutorial_is_run() -> None:
    tutorials = {path.name for path in (ROOT / "docs" / "tutorials").glob("*.md")}
    assert {Path(page).name for page in PAGES if "/tutorials/" in page} == tutorials
