"""The command line of the studies, and what they are not allowed to be."""

from __future__ import annotations

from importlib import import_module

import pytest

from studies.__main__ import STUDIES
from tests.support.command_line import run
from tests.support.paths import ROOT

STUDY = ROOT / "studies"
FIGURES = [path.stem for path in (STUDY / "figures").glob("*.py") if path.stem != "rule_marks"]


@pytest.mark.parametrize("name", STUDIES.commands)
def test_every_study_tells_its_options(capsys, name):
    code, out, err = run(capsys, name, "-h", command=STUDIES.main)
    assert (code, err) == (0, "")
    assert f"python -m studies {name}" in out


def test_every_study_can_be_called():
    modules = {module for module, _ in STUDIES.commands.values()}
    for path in STUDY.rglob("*.py"):
        if "class Arguments" in path.read_text(encoding="utf-8"):
            name = ".".join(path.relative_to(STUDY.parent).with_suffix("").parts)
            assert name in modules


def test_every_figure_can_be_called():
    listed = set(import_module("studies.figures.__main__").FIGURES)
    assert listed == {name for name in FIGURES if not name.startswith("__")}
