"""`semnav doctor`: it says what a bug report needs, and mends the cache of compiled kernels."""

from __future__ import annotations

import json
import os
import time
from pathlib import Path

import pytest

from semnav_features.kernels.cache_repair import OLD_PART, OLD_VERSION, repair
from semnav_features.kernels.kernel_cache import sealed, unsealed
from semnav_scripts import checks
from semnav_scripts.main import main
from semnav_scripts.warming import WarmedGroup


def kept(folder: Path, name: str, content: bytes = sealed(b"kernel"), age: float = 0.0) -> Path:
    """A file of the cache, or a folder of it that was used so many seconds ago."""
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    os.utime(path, (time.time() - age,) * 2)
    os.utime(path.parent, (time.time() - age,) * 2)
    return path


def test_the_doctor_says_what_a_bug_report_needs(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["doctor", "--json"]) == 0
    told = {check["name"]: check["detail"] for check in json.loads(capsys.readouterr().out)}
    assert str(Path(checks.__file__).parents[1]) in told["semnav-env"] or told["semnav-env"]
    wanted = {"interpreter", "system", "encodings", "environment variables", "Python", "numba"}
    assert wanted | {"numpy", "gymnasium", "pymunk", "kernel cache"} <= told.keys()
    assert "GB of memory" in told["system"]
    assert "kernels" in told["kernel cache"]


HERE, RECENT, UNUSED = "0123456789abcdef0123", "a" * 20, "b" * 20
"""Names of folders of kernels."""


def named(name: str) -> str:
    """The name of the file of a kernel."""
    return f"{name}-1.{'c' * 20}.bin"


def test_the_doctor_removes_what_is_damaged_or_left_behind(tmp_path: Path) -> None:
    here = tmp_path / HERE
    sound = kept(here, named("sound"))
    damaged = [
        kept(here, named("cut"), sealed(b"kernel")[:-1]),
        kept(here, named("flipped"), sealed(b"kernel")[:-1] + b"x"),
        kept(here, named("empty"), b""),
    ]
    writing = kept(here, f".new-{'1' * 12}.part.bin", b"ker")
    killed = kept(here, f".old-{'2' * 12}.part.bin", b"ker", 2 * OLD_PART)
    recent = kept(tmp_path / RECENT, named("a"), age=0.5 * OLD_VERSION)
    unused = kept(tmp_path / UNUSED, named("a"), age=2.0 * OLD_VERSION)
    removed = repair(here)
    assert (removed.damaged, removed.unfinished, removed.versions) == (3, 1, 1)
    assert all(path.exists() for path in (sound, writing, recent))
    assert not any(path.exists() for path in (*damaged, killed, unused.parent))
    assert str(removed) == "; removed 3 damaged; removed 1 unfinished; removed 1 of other versions"
    assert str(repair(here)) == ""


def test_the_doctor_mends_the_cache_that_is_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    broken = kept(tmp_path / HERE, named("broken"), b"half")
    monkeypatch.setattr("semnav_features.kernels.cache_folder.cache_folder", lambda: broken.parent)
    [_, cache] = checks.kernels()
    assert "removed 1 damaged" in cache.detail
    assert not broken.exists()


@pytest.mark.parametrize("place", range(0, 300, 37))
def test_one_wrong_bit_of_a_kept_kernel_is_found(place: int) -> None:
    data = bytearray(sealed(bytes(range(256)) + bytes(44)))
    assert unsealed(bytes(data)) == bytes(data[4:])
    data[place] ^= 1 << place % 8
    with pytest.raises(ValueError, match="checksum"):
        unsealed(bytes(data))


def test_warming_says_how_long_each_group_and_all_of_them_took(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    groups = [WarmedGroup("agents", 1.25, ""), WarmedGroup("logs", 2.0, "no space left")]
    monkeypatch.setattr("semnav_scripts.warming.warm", lambda: iter(groups))
    main(["doctor", "--warm", "--json"])
    told = {row["name"]: row for row in json.loads(capsys.readouterr().out)}
    assert told["kernels of agents"]["detail"] == "ready after 1.2 s"
    assert (told["kernels of logs"]["ok"], told["kernels of logs"]["detail"]) == (
        False,
        "no space left",
    )
    assert " s, 3 processes on " in told["kernels, in all"]["detail"]


PROJECT = """[tool.setuptools.packages.find]
where = [".", "scripts"]
include = ["semnav_*"]
"""


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A project with a package in each of two roots."""
    (tmp_path / "pyproject.toml").write_text(PROJECT)
    for folder in ("semnav_env", "scripts/semnav_ros"):
        (tmp_path / folder).mkdir(parents=True)
        (tmp_path / folder / "__init__.py").touch()
    return tmp_path


def test_a_package_that_came_after_an_editable_install_is_missed(checkout: Path) -> None:
    mapping = {"semnav_env": str(checkout / "semnav_env")}
    assert checks.missing_packages(checkout, f"MAPPING = {mapping!r}") == ["semnav_ros"]
    assert checks.missing_packages(checkout, f"{checkout}\n") == ["semnav_ros"]


def test_an_editable_install_that_knows_every_package_lacks_none(checkout: Path) -> None:
    folders = [checkout / "semnav_env", checkout / "scripts" / "semnav_ros"]
    mapping = {folder.name: str(folder) for folder in folders}
    assert checks.missing_packages(checkout, f"MAPPING = {mapping!r}") == []
    assert checks.missing_packages(checkout, f"{checkout}\n{checkout / 'scripts'}\n") == []


def test_the_doctor_reads_the_files_of_an_editable_install(
    checkout: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stale = checkout / "__editable__.semnav_env.pth"
    stale.write_text(f"{checkout}\n")
    monkeypatch.setattr(checks.metadata, "distribution", lambda _: Installed(checkout, stale))
    check = checks.editable_install()
    assert (check.ok, check.needed) == (False, True)
    assert check.detail == "does not know semnav_ros"
    assert check.fix.endswith(f"pip install -e {checkout}")


class Installed:
    """An editable install of a checkout, as `importlib.metadata` shows it."""

    def __init__(self, checkout: Path, *files: Path) -> None:
        self.checkout, self.files = checkout, files

    def read_text(self, name: str) -> str:
        assert name == "direct_url.json"
        return json.dumps({"url": self.checkout.as_uri(), "dir_info": {"editable": True}})

    def locate_file(self, file: Path) -> Path:
        return file


def test_in_another_checkout_the_doctor_warns_of_the_copy_that_is_imported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert checks.imported_copy().ok
    (tmp_path / "semnav_env").mkdir()
    (tmp_path / "pyproject.toml").write_text('[project]\nname = "semnav-env"\n')
    (tmp_path / "docs").mkdir()
    for folder in (tmp_path, tmp_path / "docs"):
        monkeypatch.chdir(folder)
        check = checks.imported_copy()
        assert not check.ok
        assert not check.needed
        assert "not this checkout" in check.detail
        assert f"pip install -e {tmp_path}" in check.fix


def test_in_its_own_checkout_the_doctor_is_content(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(Path(checks.__file__).parents[2])
    assert checks.imported_copy().ok
