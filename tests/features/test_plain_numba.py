"""Kernels without our files between runs, and kernels whose sources were edited."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.paths import GOLDEN, ROOT

GOLDEN_RUN = """
import json
from tests.support.episodes import actions, fresh, rollout, rounded_digest
print(json.dumps(rounded_digest(rollout(fresh(), actions(1000, 2)))))
"""

SMALL_KERNELS = """
import numpy as np
from tests.support import small_kernels as small
print(small.sum_of_twice(np.arange(4.0)), small.sum_of_counting(4), small.twice(2.5))
"""

SLOPE = """
from semnav_features.kernels.filters import flat_slope_sign
print(flat_slope_sign(1.0, 2.0, 0.01, 0.1, 0.0))
"""


def output(program: str, folder: Path, cwd: Path = ROOT, **variables: str) -> str:
    """What a process prints that keeps its kernels in a folder."""
    environment = {**os.environ, "SEMNAV_CACHE_DIR": str(folder), **variables}
    return subprocess.check_output(
        [sys.executable, "-c", program], cwd=cwd, env=environment, text=True
    )


def test_numbas_own_files_give_the_same_results(tmp_path: Path) -> None:
    ours = output(SMALL_KERNELS, tmp_path)
    plain = [output(SMALL_KERNELS, tmp_path, SEMNAV_PLAIN_NUMBA="1") for _ in range(2)]
    assert plain == [ours] * 2
    assert list(tmp_path.rglob("*.nbi"))


@pytest.mark.slow
def test_numbas_own_files_give_the_golden_run(tmp_path: Path) -> None:
    printed = output(GOLDEN_RUN, tmp_path, SEMNAV_PLAIN_NUMBA="1")
    assert json.loads(printed) == json.loads((GOLDEN / "thousand_steps.json").read_text())


@pytest.mark.parametrize("plain", ["", "1"])
def test_an_edited_callee_is_compiled_anew_in_a_copy_without_git(
    tmp_path: Path, plain: str
) -> None:
    """The kernel that Python calls stands in another module, which is not edited."""
    tree, kept = tmp_path / "tree", tmp_path / "kept"
    shutil.copytree(ROOT / "features" / "semnav_features", tree / "semnav_features")
    variables = {"PYTHONPATH": str(tree), "SEMNAV_PLAIN_NUMBA": plain}
    assert output(SLOPE, kept, tree, **variables) == "1\n"
    callee = tree / "semnav_features" / "kernels" / "breakpoints.py"
    text = callee.read_text()
    edited = text.replace(
        "if angle >= math.pi / 4:\n        return 0.0", "if angle >= 0.0:\n        return 9.9"
    )
    assert edited != text
    callee.write_text(edited)
    assert output(SLOPE, kept, tree, **variables) == "0\n"
