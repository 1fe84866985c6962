"""No command needs a home or an installation that it may write to.

Root may write anywhere, so permissions would show nothing. Where the system allows it, the commands
run in a mount namespace in which installation, interpreter and home are mounted read-only;
everywhere, with a home that cannot be made.
"""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
import tempfile
from functools import cache
from pathlib import Path
from shutil import which

import pytest

from tests.support.paths import ROOT, ROOTS

INSTALLED = tuple(
    sorted({str(Path(p).resolve()) for p in (ROOT, sys.prefix, sysconfig.get_path("purelib"))})
)
"""Folders of the sources and of the interpreter's packages."""

MOUNT_READ_ONLY = """
while [ "$1" != -- ]; do
  mount --bind "$1" "$1" && mount -o remount,bind,ro "$1" || exit 99
  shift
done
shift
exec "$@"
"""

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
    "ground stop --map office_cross --pose 3,11.5,0 --json",
    "describe --map office_cross --from 3,11.5,0 --to west_north_2 --plot {tmp}/way.png",
    "extract {log} --json --out {tmp}/scenes.jsonl",
    "map check office_cross",
)


def read_only(*folders: str) -> list[str]:
    """The beginning of a command that cannot write to some folders."""
    user = [] if os.geteuid() == 0 else ["--map-root-user"]
    return ["unshare", *user, "--mount", "sh", "-c", MOUNT_READ_ONLY, "sh", *folders, "--"]


@cache
def mounts_are_allowed() -> bool:
    """Whether a folder can be mounted read-only here."""
    if sys.platform != "linux" or not which("unshare"):
        return False
    with tempfile.TemporaryDirectory() as folder:
        touched = subprocess.run(
            [*read_only(folder), "sh", "-c", f"! touch {folder}/file"], capture_output=True
        )
        return touched.returncode == 0 and not os.listdir(folder)


def run(folder: Path, words: str, mounted: bool) -> subprocess.CompletedProcess[str]:
    """A command of a user who can write to nothing but the temporary folder."""
    tmp, home, log = folder / "tmp", folder / "home", folder / "a.csv"
    for each in (tmp, home):
        each.mkdir(exist_ok=True)
    log.write_text("# angle_min=-0.3 angle_increment=0.01\n" + ",".join(["2.0"] * 60) + "\n")
    hidden = ("NUMBA_CACHE_DIR", "SEMNAV_CACHE_DIR", "XDG_CACHE_HOME", "MPLCONFIGDIR")
    env = {name: value for name, value in os.environ.items() if name not in hidden}
    env |= {
        "TMPDIR": str(tmp),
        "PYTHONPATH": os.pathsep.join(map(str, ROOTS.values())),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    env |= {"HOME": str(home) if mounted else "/dev/null/home"}
    words = words.format(log=log, tmp=tmp)
    command = [sys.executable, "-m", "semnav", *words.split()]
    before = read_only(*INSTALLED, str(home)) if mounted else []
    return subprocess.run([*before, *command], cwd="/", env=env, capture_output=True, text=True)


def need_mounts(mounted: bool) -> None:
    if mounted and not mounts_are_allowed():
        pytest.skip("mounts are not allowed here")


HOMES = pytest.mark.parametrize("mounted", [False, True], ids=["no home", "read-only mounts"])


@pytest.mark.parametrize(
    "words",
    [*WITHOUT_KERNELS[:2], *(pytest.param(w, marks=pytest.mark.slow) for w in WITHOUT_KERNELS[2:])],
)
def test_a_command_needs_no_home(tmp_path: Path, words: str) -> None:
    done = run(tmp_path, words, mounts_are_allowed())
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.slow
@HOMES
def test_kernels_are_kept_elsewhere_and_a_line_says_so(tmp_path: Path, mounted: bool) -> None:
    need_mounts(mounted)
    for words in WITH_KERNELS:
        done = run(tmp_path, words, mounted)
        assert done.returncode in (0, 1), done.stderr
        assert "Traceback" not in done.stderr
        assert "compiled kernels are kept in" in done.stderr
    kept = list((tmp_path / "tmp").rglob("*.bin"))
    assert kept
    for file in kept:  # damaged files are compiled anew
        file.write_bytes(file.read_bytes()[:100])
    mended = run(tmp_path, WITH_KERNELS[0], mounted)
    assert mended.returncode == 0
    assert f"removed {len(kept)} damaged" in mended.stdout
    assert list((tmp_path / "home").iterdir()) == []


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [
        "map generate --seed 3 --out {out}/plan.geojson",
        "map show office_cross --out {out}/plan.png",
        "map export office_cross --out {out}/map.yaml",
        "demonstrate val_seen --episodes 1 --agent random --failures --max-seconds 5 --out {out}/d",
    ],
)
def test_a_read_only_place_of_results_is_named(tmp_path: Path, words: str) -> None:
    need_mounts(True)
    out = tmp_path / "home"
    done = run(tmp_path, words.format(out=out), True)
    assert done.returncode == 2
    assert done.stderr.splitlines()[-1].startswith("semnav: cannot ")
    assert list(out.iterdir()) == []
