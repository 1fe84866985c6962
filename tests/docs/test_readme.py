"""The code in the README runs."""

from __future__ import annotations

import re

import pytest

from tests.support.paths import ROOT


def test_the_code_in_the_readme_runs(capsys: pytest.CaptureFixture[str]) -> None:
    text = (ROOT / "README.md").read_text("utf-8")
    for block in re.findall(r"```python\n(.*?)```", text, re.DOTALL):
        exec(compile(block, "README.md", "exec"), {})
    said = capsys.readouterr().out.splitlines()
    assert re.fullmatch(r"\w.* \| office:\w+:\d+", said[0])
    assert said[1] == "('done',) True"
    assert "looking for the second door on the right" in said[2]
