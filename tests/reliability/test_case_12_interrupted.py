"""Case 12: Ctrl-C and SIGTERM at any moment, an early `render()`, long errors, own plans."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from semnav_env.env import SemNavEnv
from semnav_env.world.maps import generate_office, save_floor_plan
from semnav_scripts.dispatch import LONGEST_LINE
from semnav_scripts.main import main
from tests.support.paths import ROOT

INTERRUPTED_AT_AN_IMPORT = """
import os, signal, sys
sys.path.insert(0, {root!r})

class Interrupting:
    left = {count}
    def find_spec(self, name, path=None, target=None):
        self.left -= 1
        if not self.left:
            os.kill(os.getpid(), {number})

import semnav
signal.signal(signal.SIGINT, signal.default_int_handler)
sys.meta_path.insert(0, Interrupting())
sys.argv[1:] = {words!r}
sys.exit(semnav.main())
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("count", [1, 40, 200, 330])
@pytest.mark.parametrize("words", [["map", "list"], ["--help"], ["ground", "stop", "--json"]])
def test_a_signal_while_loading_ends_in_one_line(words: list[str], count: int, number: int) -> None:
    program = INTERRUPTED_AT_AN_IMPORT.format(
        root=str(ROOT), count=count, words=words, number=int(number)
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    if done.returncode == 128 + number:
        word = "interrupted" if number == signal.SIGINT else "terminated"
        assert done.stderr == f"semnav: {word}\n"
    else:  # it was done before so many modules were loaded
        assert "Traceback" not in done.stderr
        assert count > 1


TERMINATED_AT_WORK = """
import os, signal, sys
sys.path.insert(0, {root!r})
import semnav
from semnav_scripts.map_list import Arguments

def run(self):
    try:
        os.kill(os.getpid(), signal.SIGTERM)
        signal.pause()
    finally:
        print("put away")

Arguments.run = run
sys.argv[1:] = ["map", "list"]
sys.exit(semnav.main())
"""


def test_sigterm_lets_a_command_put_away_what_it_has_begun() -> None:
    program = TERMINATED_AT_WORK.format(root=str(ROOT))
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (
        143,
        "put away\n",
        "semnav: terminated\n",
    )


def test_rendering_before_a_reset_is_an_error() -> None:
    with pytest.raises(RuntimeError, match=r"call reset\(\) before render\(\)"):
        SemNavEnv(render_mode="rgb_array").render()


@pytest.mark.parametrize(
    "words",
    [
        ["x" * 100_000],
        ["map", "show", "x" * 100_000],
        ["ground", "x" * 19_000],
        ["extract", "x" * 100_000],
        ["demo", "stop", "--map", "x" * 100_000],
        ["evaluate", "--suite", "x" * 100_000],
        ["demo", "stop", "--robot", "x" * 100_000],
    ],
)
def test_an_error_repeats_no_long_words(
    words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words) == 2
    said = capsys.readouterr().err
    assert len(said) < LONGEST_LINE + 100
    assert said.count("\n") == 1


def test_episodes_are_made_in_plans_of_the_projects_own_format(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lab, out = tmp_path / "lab.geojson", tmp_path / "out"
    save_floor_plan(generate_office(3), lab)
    assert main(["episodes", "import", str(lab), "--out", str(out), "--episodes", "1"]) == 0
    assert len(list(out.iterdir())) == 2


def test_a_refused_import_leaves_no_folder(tmp_path: Path) -> None:
    out = tmp_path / "out"
    (tmp_path / "lab.geojson").write_text("{}")
    assert main(["episodes", "import", str(tmp_path / "lab.geojson"), "--out", str(out)]) == 2
    assert not out.exists()
