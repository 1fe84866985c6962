"""Agents from outside the package: brought by module and class, or given as a callable."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from semnav_agents.custom import agent_factory
from semnav_agents.evaluation import SUITES, run_suite
from semnav_agents.registry import make_agent
from semnav_env.robots import RobotSpec
from semnav_scripts.main import main
from tests.support.paths import ROOT

MODULE = '''
import numpy as np
from semnav_env.robots import RobotSpec

class Standing:
    """Never moves."""

    observation = "raw"

    def reset(self, info):
        self.size = RobotSpec(**info["robot"]).action_size

    def act(self, observation):
        return np.zeros(self.size, np.float32)

class Choosy(Standing):
    def __init__(self, taste):
        self.taste = taste

class Deaf:
    def act(self, observation):
        return observation

def slowly():
    return Standing()

WEIGHTS = 3
'''

DOCUMENTATION = ROOT / "docs" / "tutorials" / "own_agent.md"
COMMAND = "go through the first door on the right"


class Still:
    observation = "raw"

    def reset(self, info: dict[str, Any]) -> None:
        self.size = RobotSpec(**info["robot"]).action_size

    def act(self, observation: dict[str, Any]) -> np.ndarray:
        return np.zeros(self.size, np.float32)


@pytest.fixture(autouse=True)
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A package of agents in the current directory, which nobody has installed."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", [*sys.path])
    folder = tmp_path / "my_robots"
    folder.mkdir()
    (folder / "__init__.py").touch()
    (folder / "drivers.py").write_text(MODULE)
    (folder / "broken.py").write_text("1 / 0")
    (folder / "needy.py").write_text("import no_such_library")
    yield tmp_path
    for name in [name for name in sys.modules if name.startswith("my_")]:
        del sys.modules[name]


def rows(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_an_agent_from_outside_is_evaluated_the_same_by_two_workers(package: Path) -> None:
    words = ["evaluate", "heidelberg", "--seeds", "1", "--agent", "my_robots.drivers:Standing"]
    assert main([*words, "--out", "alone.jsonl"]) == 0
    assert main([*words, "--workers", "2", "--out", "shared.jsonl"]) == 0
    alone = rows(package / "alone.jsonl")
    assert len(alone) == 4
    assert {row["path_length"] for row in alone} == {0.0}
    assert alone == rows(package / "shared.jsonl")


def test_an_agent_from_outside_is_shown_and_demonstrates(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    agent = ["--agent", "my_robots.drivers:slowly"]
    assert main(["demo", COMMAND, "--pose=-2.5,-0.3,0.24", "--json", *agent]) == 1
    assert json.loads(capsys.readouterr().out)["verdicts"] == ["stopped short"]
    pytest.importorskip("minari", reason="the extra 'data' is not installed")
    words = ["demonstrate", "test_real", "--episodes", "1", "--failures", "--out", "set", "--json"]
    assert main([*words, *agent]) == 0
    assert json.loads(capsys.readouterr().out)["kept"] == 1


def test_the_agent_of_the_documentation_drives(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    blocks = re.findall("```python\n(.*?)```", DOCUMENTATION.read_text(), re.DOTALL)
    [code] = [block for block in blocks if "class MyAgent" in block]
    (package / "my_package").mkdir()
    (package / "my_package" / "my_module.py").write_text(code)
    main(["demo", COMMAND, "--json", "--agent", "my_package.my_module:MyAgent"])
    assert json.loads(capsys.readouterr().out)["path_length"] > 0.5


def test_a_suite_takes_a_class_also_with_two_workers() -> None:
    trials = SUITES["heidelberg"][:1]
    alone = list(run_suite(trials, Still, "wheelchair", seeds=[0, 1]))
    assert alone == list(run_suite(trials, Still, "wheelchair", seeds=[0, 1], workers=2))
    assert [result.verdicts for result in alone] == [("stopped short",)] * 2


def test_a_callable_that_no_process_can_import_is_refused() -> None:
    with pytest.raises(ValueError, match=r"several workers need an agent .* top of a module"):
        list(run_suite(SUITES["heidelberg"], lambda: Still(), "spot", seeds=[0], workers=2))


def test_a_class_that_only_this_process_knows_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """As of a class in a notebook: it can be pickled, but nobody else finds it."""
    monkeypatch.setattr(Still, "__module__", "my_notebook")
    monkeypatch.setitem(sys.modules, "my_notebook", sys.modules[__name__])
    with pytest.raises(ValueError, match=r"several workers need an agent .*my_notebook"):
        list(run_suite(SUITES["heidelberg"][:1], Still, "spot", seeds=[0], workers=2))


@pytest.mark.parametrize(
    ("agent", "said"),
    [
        ("psychic", "no agent 'psychic'; there are: scripted, oracle, .* package.module:Class"),
        ("my_robots.drivers:", "names no agent; give package.module:Class"),
        ("my_robots.riders:Standing", "no module 'my_robots.riders': neither installed nor in"),
        ("my_robots.drivers.py:Standing", "no module .* leave out .py"),
        ("my_robots.broken:Standing", "cannot be imported: ZeroDivisionError"),
        ("my_robots.needy:Standing", "cannot be imported: ModuleNotFoundError: .*no_such_library"),
        ("my_robots.drivers:Standin", "has no 'Standin'; .*; did you mean 'Standing'?"),
        ("my_robots.drivers:WEIGHTS", "is 3; give a class, or a function that makes an agent"),
        ("my_robots.drivers:Choosy", r"Choosy\(\) failed: TypeError: .*'taste'"),
        ("my_robots.drivers:Deaf", r"Deaf is no agent: it lacks .*observation and reset\(info\)"),
    ],
)
def test_each_way_to_name_no_agent_has_one_clear_line(
    capsys: pytest.CaptureFixture[str], agent: str, said: str
) -> None:
    assert main(["demo", COMMAND, "--agent", agent]) == 2
    [line] = capsys.readouterr().err.splitlines()
    with pytest.raises(ValueError, match=said):
        raise ValueError(line)


def test_what_makes_no_agent_is_refused() -> None:
    with pytest.raises(ValueError, match="dict is no agent: it lacks"):
        make_agent(dict)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="makes no agent"):
        make_agent(3)  # type: ignore[arg-type]


def test_the_current_directory_is_searched_last() -> None:
    """A file of the user's does not hide a module that is installed."""
    Path("json.py").write_text("JSONDecoder = None")
    assert agent_factory("json:JSONDecoder") is json.JSONDecoder
