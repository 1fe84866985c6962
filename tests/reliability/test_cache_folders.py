"""The kernel cache removes only what is its own, and loads nothing that others could write."""

from __future__ import annotations

import grp
import os
import pwd
import stat
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from semnav_features.kernels import cache_folder as folders
from semnav_features.kernels import version_folders
from semnav_features.kernels.cache_repair import OLD_PART, OLD_VERSION, repair
from semnav_features.private_folder import make_private

VERSION = "0123456789abcdef0123"
KERNEL = f"module.kernel-1.{VERSION}.bin"
OLD = 2.0 * max(OLD_VERSION, OLD_PART)


@pytest.fixture
def umask_of_none() -> Iterator[None]:
    """New files and folders get all the bits that are asked for."""
    before = os.umask(0)
    yield
    os.umask(before)


def old_file(path: Path, content: bytes = b"precious") -> Path:
    """A file that nobody has used for long, in a folder likewise."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    for each in (path, path.parent):
        os.utime(each, (time.time() - OLD,) * 2)
    return path


def opened(base: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of kernels if that one is chosen, other than for this process."""
    monkeypatch.setenv("SEMNAV_CACHE_DIR", str(base))
    folders.cache_folder.cache_clear()
    try:
        return folders.cache_folder()
    finally:
        folders.cache_folder.cache_clear()


def foreign_files(base: Path) -> list[Path]:
    """What other programs might keep where ours looks, all of it old."""
    numbered = [base / f"{number:020x}" for number in range(3)]
    return [
        old_file(base / "data.txt"),
        old_file(base / "other-program" / KERNEL),
        old_file(base / VERSION.upper() / KERNEL),
        old_file(base / f"{VERSION}0" / KERNEL),
        old_file(numbered[0] / "thesis.tex"),
        old_file(numbered[1] / "inner" / KERNEL),
        old_file(numbered[2] / "weights.bin"),
        old_file(numbered[2] / ".weights.part.bin"),
    ]


def test_what_is_not_ours_is_never_removed(tmp_path: Path) -> None:
    here = tmp_path / VERSION
    there = [*foreign_files(tmp_path), old_file(here / "model.bin"), old_file(here / "a.txt")]
    mine = old_file(tmp_path / ("f" * 20) / KERNEL)
    for number in range(20):
        old_file(tmp_path / f"{number + 16:020x}" / KERNEL)
    repair(here)
    version_folders.forget_old_versions(tmp_path)
    assert all(path.read_bytes() == b"precious" for path in there)
    assert not mine.exists()


def test_a_link_to_a_folder_of_kernels_is_not_followed(tmp_path: Path) -> None:
    elsewhere = old_file(tmp_path / "elsewhere" / KERNEL)
    base = tmp_path / "base"
    here = old_file(base / VERSION / KERNEL).parent
    (base / ("a" * 20)).symlink_to(elsewhere.parent)
    (old_file(base / ("b" * 20) / KERNEL).parent / f"x.{VERSION}.bin").symlink_to(elsewhere)
    os.utime(base / ("b" * 20), (time.time() - OLD,) * 2)
    repair(here)
    assert elsewhere.exists()
    assert (base / ("a" * 20)).is_symlink()
    assert (base / ("b" * 20)).is_dir()


def test_folders_beside_the_cache_stay(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder that the user chose is shared with other programs, such as numba's own cache."""
    there = [*foreign_files(tmp_path), *foreign_files(tmp_path / "kernels")]
    folder = opened(tmp_path, monkeypatch)
    assert folder.parent == tmp_path / "semnav-env-kernels"
    repair(folder)
    assert all(path.exists() for path in there)


def test_the_versions_used_last_are_kept(tmp_path: Path) -> None:
    for age in range(14):
        folder = tmp_path / f"{age:020}"
        folder.mkdir()
        os.utime(folder, (time.time() - 60 * age,) * 2)
    version_folders.forget_old_versions(tmp_path)
    assert sorted(f.name for f in tmp_path.iterdir()) == [f"{age:020}" for age in range(10)]


def test_the_cache_is_open_to_its_user_alone(
    tmp_path: Path, umask_of_none: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = opened(tmp_path / "new" / "cache", monkeypatch)
    made = [folder, folder.parent, tmp_path / "new" / "cache", tmp_path / "new"]
    assert [stat.S_IMODE(path.stat().st_mode) for path in made] == [0o700] * 4


UNSAFE = {
    "a folder above that others can write to": lambda base: base.parent.chmod(0o777),
    "a folder above of another user": lambda base: os.chown(base.parent, 12345, 12345),
    "a cache that others can write to": lambda base: base.chmod(0o777),
    "a cache that another group can write to": lambda base: base.chmod(0o720),
    "a cache of another user": lambda base: os.chown(base, 12345, 12345),
    "a version that others can write to": lambda base: (base / VERSION).chmod(0o702),
    "a version of another user": lambda base: os.chown(base / VERSION, 12345, 12345),
    "a version that is a link": lambda base: (
        (base / VERSION).rename(base / "elsewhere"),
        (base / VERSION).symlink_to("elsewhere"),
    ),
}


@pytest.mark.parametrize("spoil", UNSAFE.values(), ids=UNSAFE)
def test_a_cache_that_others_can_change_is_not_used(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    spoil: object,
) -> None:
    if os.geteuid() and "of another user" in str(spoil):
        pytest.skip("only root can give a folder away")
    chosen, temporary = tmp_path / "chosen", tmp_path / "tmp"
    temporary.mkdir()
    monkeypatch.setattr(folders, "version_key", lambda: VERSION)
    monkeypatch.setattr(folders.tempfile, "tempdir", str(temporary))
    usual = opened(chosen, monkeypatch)
    assert usual.parent.parent == chosen
    spoil(usual.parent)
    other = opened(chosen, monkeypatch)
    assert other.is_relative_to(temporary)
    [line] = capsys.readouterr().err.splitlines()
    assert f"{usual.parent} cannot be used: " in line
    assert line.endswith(f"compiled kernels are kept in {other}")


@pytest.mark.parametrize("chosen", ["cache", "./cache", "~/.cache"])
def test_a_relative_folder_is_not_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, chosen: str
) -> None:
    """So is `~/.cache` where neither HOME nor the password file says where that is."""
    monkeypatch.chdir(tmp_path)
    temporary = tmp_path / "tmp"
    temporary.mkdir()
    monkeypatch.setattr(folders.tempfile, "tempdir", str(temporary))
    assert opened(Path(chosen), monkeypatch).is_relative_to(temporary)
    assert list(tmp_path.iterdir()) == [temporary]


def test_a_home_that_nobody_knows_is_not_the_current_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("SEMNAV_CACHE_DIR", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(folders.config, "CACHE_DIR", "")
    monkeypatch.setattr("os.path.expanduser", lambda path: path)
    with pytest.raises(OSError, match="not absolute"):
        make_private(folders.base_folder())


def test_a_temporary_folder_that_others_made_is_not_trusted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(folders.tempfile, "tempdir", str(tmp_path))
    usual = folders._temporary_folder(VERSION)
    assert folders._temporary_folder(VERSION) == usual
    usual.parent.chmod(0o777)
    assert not folders._temporary_folder(VERSION).is_relative_to(usual.parent)


def test_a_group_of_ones_own_may_write_above_the_cache(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where each user has a group, folders are often made with the mode 775."""
    above = tmp_path / "above"
    above.mkdir()
    above.chmod(0o775)
    user, group = pwd.getpwuid(os.getuid()), above.stat().st_gid
    if user.pw_gid != group:
        pytest.skip("new folders have a group that is not the user's first one")
    alone = grp.struct_group((user.pw_name, "x", group, []))
    monkeypatch.setattr("grp.getgrgid", lambda _: alone)
    make_private(above / "cache")
    shared = grp.struct_group((user.pw_name, "x", group, ["somebody"]))
    monkeypatch.setattr("grp.getgrgid", lambda _: shared)
    with pytest.raises(PermissionError, match="others can write"):
        make_private(above / "cache")
