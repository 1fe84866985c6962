"""The code of the pages for those who train runs as it is written, but for its length."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from tests.support.paths import ROOT

SHORTER = {"learn(100_000)": "learn(1)", "num_envs=64": "num_envs=3"}
"""What a page says, and what is run in its place."""


def run(page: str, shown: dict[str, Any]) -> dict[str, Any]:
    """Run the blocks of a page, one after the other; returns its names."""
    text = (ROOT / page).read_text("utf-8")
    blocks = re.findall(r"^( *)```python\n(.*?)^ *```", text, re.DOTALL | re.MULTILINE)
    assert blocks
    for indent, block in blocks:
        code = re.sub(rf"^{indent}", "", block, flags=re.MULTILINE)
        for long, short in SHORTER.items():
            code = code.replace(long, short)
        exec(compile(code, page, "exec"), shown)
    return shown


def test_the_vector_page_runs() -> None:
    pytest.importorskip("stable_baselines3", reason='needs the extra "rl"')
    shown = run("docs/guides/vector.md", {})
    assert shown["observations"]["goal"].shape == (3, 13)


def test_the_page_for_learners_runs() -> None:
    pytest.importorskip("stable_baselines3", reason='needs the extra "rl"')
    shown = run("docs/guides/learners.md", {})
    size = 13 + 7 + 811
    assert shown["env"].reset(seed=0)[0].shape == (size,)
    assert shown["envs"].reset(seed=0)[0].shape == (8, size)
    assert abs(shown["robots"].reset()["goal"]).max() <= shown["robots"].clip_obs


def test_the_page_of_gymnasiums_tools_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    run("docs/guides/gymnasium_tools.md", {})
    assert (tmp_path / "out" / "random.gif").stat().st_size > 0
