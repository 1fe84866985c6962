"""Processes of any kind give the same bits, and share one cache from its first moment on."""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
from pathlib import Path

import pytest

from semnav_features.kernels.kernel_cache import unsealed
from tests.support.episodes import actions, digest, fresh, rollout
from tests.support.paths import ROOT

COLD_PROCESSES = 6
DESCRIBE = "describe --map office_cross --from 3,11.5,0 --to west_north_2 --json"


def driven(robot: str) -> str:
    """The digest of a short drive."""
    env = fresh(robot=robot)
    return digest(rollout(env, actions(60, env.robot.action_size)))


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_a_process_observes_the_same_bits_however_it_was_started(method: str) -> None:
    robots = ["wheelchair", "spot"]
    with multiprocessing.get_context(method).Pool(1) as pool:
        assert pool.map(driven, robots) == list(map(driven, robots))


def started(cache: Path) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "semnav", *DESCRIBE.split()]
    env = os.environ | {"SEMNAV_CACHE_DIR": str(cache)}
    pipe = subprocess.PIPE
    return subprocess.Popen(command, cwd=ROOT, env=env, text=True, stdout=pipe, stderr=pipe)


@pytest.mark.slow
def test_six_cold_processes_share_one_cache(tmp_path: Path) -> None:
    cold = [process.communicate() for process in [started(tmp_path) for _ in range(COLD_PROCESSES)]]
    assert len({out for out, _ in cold}) == 1
    assert all("Traceback" not in err for _, err in cold)
    kept = list(tmp_path.rglob("*"))
    assert not [path for path in kept if ".part" in path.name]
    for file in filter(Path.is_file, kept):
        unsealed(file.read_bytes())
    assert started(tmp_path).communicate() == (cold[0][0], "")
