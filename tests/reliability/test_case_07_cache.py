"""Case 7: no command needs a home or an installation that it may write to."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.paths import ROOT

WITHOUT_KERNELS = (
    "--version",
    "map list",
    "map show office_cross",
    "episodes list",
    "demo --help",
    "evaluate --help",
)
WITH_KERNELS = (
    "doctor",
    "demo stop --map office_cross --json",
    "ground stop --map office_cross --pose -1,0,0 --json",
    "describe --map office_cross --from -1,0,0 --to west_north_2",
    "extract {log} --json",
    "map check office_cross",
)


def run(folder: Path, words: str) -> subprocess.CompletedProcess[str]:
    """A command of a user who can write to nothing but the temporary folder."""
    (folder / "tmp").mkdir(exist_ok=True)
    log = folder / "a.csv"
    log.write_text("# angle_min=-0.3 angle_increment=0.01\n" + ",".join(["2.0"] * 60) + "\n")
    hidden = ("NUMBA_CACHE_DIR", "SEMNAV_CACHE_DIR", "XDG_CACHE_HOME", "MPLCONFIGDIR")
    env = {name: value for name, value in os.environ.items() if name not in hidden}
    env |= {"HOME": "/dev/null/home", "TMPDIR": str(folder / "tmp"), "PYTHONPATH": str(ROOT)}
    env |= {"PYTHONDONTWRITEBYTECODE": "1"}
    command = [sys.executable, "-m", "semnav", *words.format(log=log).split()]
    return subprocess.run(command, cwd="/", env=env, capture_output=True, text=True)


@pytest.mark.parametrize("words", WITHOUT_KERNELS)
def test_a_command_needs_no_home(tmp_path: Path, words: str) -> None:
    done = run(tmp_path, words)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.slow
def test_kernels_are_kept_elsewhere_and_a_line_says_so(tmp_path: Path) -> None:
    for words in WITH_KERNELS:
        done = run(tmp_path, words)
        assert done.returncode in (0, 1), done.stderr
        assert "Traceback" not in done.stderr
        assert "compiled kernels are kept in" in done.stderr
    kept = list((tmp_path / "tmp").rglob("*.bin"))
    assert kept
    for file in kept:  # damaged files are compiled anew
        file.write_bytes(file.read_bytes()[:100])
    assert run(tmp_path, WITH_KERNELS[0]).returncode == 0
