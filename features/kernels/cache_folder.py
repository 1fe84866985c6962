"""Where compiled kernels are kept between runs."""

from __future__ import annotations

import atexit
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from functools import lru_cache
from pathlib import Path

from numba.core import config
from numba.misc.appdirs import AppDirs

from semnav_env.features.kernels.cache_key import version_key
from semnav_env.features.private_folder import make_private

OWN_NAME = "semnav-env-kernels"
"""Name of the folder that is ours alone, in one that the user may have chosen for many programs."""

VERSION_FOLDER = re.compile(r"[0-9a-f]{20}")
"""Names of the folders in it, one for each version of the sources."""

KERNEL_FILE = re.compile(r"[^.].*\.[0-9a-f]{20}\.bin")
"""Names of the files of kernels."""

UNFINISHED_FILE = re.compile(r"\..+(-[0-9a-f]{12}\.part\.bin|\.[0-9a-f]{20}\.bin\.lock)")
"""Names of such files while they are written, and of what tells others to wait for them."""

KEPT_FOLDERS = 10
"""Folders of as many versions of the sources are kept, those used last."""


@lru_cache(maxsize=1)
def cache_folder() -> Path:
    """Folder of the kernels of exactly these sources and libraries; only the user can write to it.

    It stands in the folder that `SEMNAV_CACHE_DIR` or `NUMBA_CACHE_DIR` names, else in the user's
    cache directory. Where that cannot be used, it stands in the temporary directory.
    """
    name, base = version_key(), base_folder()
    try:
        return _opened(base, name)
    except OSError as error:
        other = _temporary_folder(name)
        why = error.strerror or error
        print(
            f"semnav-env: {base} cannot be used: {why}; compiled kernels are kept in {other}",
            file=sys.stderr,
        )
        return other


def base_folder() -> Path:
    """Folder in which each version of the sources has one of its own."""
    chosen = os.environ.get("SEMNAV_CACHE_DIR") or str(getattr(config, "CACHE_DIR", ""))
    chosen = chosen or AppDirs("semnav-env", appauthor=False).user_cache_dir
    return Path(os.path.realpath(chosen) if os.path.isabs(chosen) else chosen) / OWN_NAME


def versions(base: Path) -> list[Path]:
    """The folders of kernels, in the order of their last use."""
    found = [f for f in base.iterdir() if VERSION_FOLDER.fullmatch(f.name) and _is_folder(f)]
    return sorted(found, key=_last_use, reverse=True)


def forget_old_versions(base: Path) -> None:
    """Remove all folders of kernels but those used last."""
    for folder in versions(base)[KEPT_FOLDERS:]:
        remove_version(folder)


def remove_version(folder: Path) -> bool:
    """Remove a folder of kernels, unless there is anything else in it; whether it is gone."""
    files = list(entries(folder))
    if not all(map(is_kernel, files)):
        return False
    with suppress(OSError):  # another process may have removed it
        for file in files:
            file.unlink(missing_ok=True)
        folder.rmdir()  # refused if anything has come meanwhile
    return not folder.exists()


def is_kernel(file: Path) -> bool:
    """Whether a file is one of a kernel, complete or not."""
    named = KERNEL_FILE.fullmatch(file.name) or UNFINISHED_FILE.fullmatch(file.name)
    return named is not None and file.is_file() and not file.is_symlink()


def _opened(base: Path, name: str) -> Path:
    """Make a folder of kernels or note its use.

    Raises:
        OSError: it cannot be made or written to, or others can write to it.
    """
    folder = base / name
    make_private(base)
    is_new = not folder.is_dir()
    make_private(folder)
    if is_new:
        forget_old_versions(base)
    os.utime(folder)
    tempfile.TemporaryFile(dir=folder).close()
    return folder


def entries(folder: Path) -> Iterator[Path]:
    """What is in a folder; nothing if it is gone."""
    with suppress(OSError):  # another process has removed it
        yield from folder.iterdir()


def _is_folder(path: Path) -> bool:
    return path.is_dir() and not path.is_symlink()


def _last_use(folder: Path) -> float:
    try:
        return folder.stat().st_mtime
    except OSError:
        return 0.0  # another process has removed it


def _temporary_folder(name: str) -> Path:
    """A folder of kernels in this user's temporary folder, or a new one until the process ends."""
    user = getattr(os, "getuid", lambda: 0)()
    try:
        return _opened(Path(os.path.realpath(tempfile.gettempdir()), f"semnav-env-{user}"), name)
    except OSError:  # somebody else has made it
        folder = Path(tempfile.mkdtemp(prefix="semnav-env-"))
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
        return folder
