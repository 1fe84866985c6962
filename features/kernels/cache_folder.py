"""Where compiled kernels are kept between runs."""

from __future__ import annotations

import hashlib
import os
import re
import shutil
import stat
import sys
import tempfile
from collections.abc import Iterator, Mapping
from functools import lru_cache
from pathlib import Path

import numba
import numpy as np
from numba.core import config
from numba.misc.appdirs import AppDirs

_KERNEL_IMPORT = "kernels.compiling import kernel"
_IMPORT = re.compile(r"^from semnav_env\.([\w.]+) import (\([^)]*\)|[^\n]*)", re.MULTILINE)

KEPT_FOLDERS = 10
"""Folders of as many versions of the sources are kept, those used last."""


@lru_cache(maxsize=1)
def cache_folder() -> Path:
    """Folder of the kernels of exactly these sources and libraries; it can be written to.

    It stands in the folder that `SEMNAV_CACHE_DIR` or `NUMBA_CACHE_DIR` names, else in the user's
    cache directory. Where that cannot be written to, it stands in the temporary directory.
    """
    name = version_key()
    usual = base_folder() / name
    if _opened(usual):
        return usual
    other = _private_temporary_folder() / name
    print(
        f"semnav-env: {usual.parent} cannot be written to; compiled kernels are kept in {other}",
        file=sys.stderr,
    )
    _opened(other)
    return other


def base_folder() -> Path:
    """Folder in which each version of the sources has one of its own."""
    chosen = os.environ.get("SEMNAV_CACHE_DIR") or str(getattr(config, "CACHE_DIR", ""))
    return Path(chosen or AppDirs("semnav-env", appauthor=False).user_cache_dir) / "kernels"


def version_key() -> str:
    """Hash of every module that a kernel may be made of, and of the compiler's version.

    A kernel holds the code and the constants of all that it calls, wherever they stand; so no
    edit leaves a stale kernel, and two copies of the same sources share their kernels. Edits of
    modules that no kernel's module imports leave the kernels as they are.
    """
    versions = (sys.version, numba.__version__, np.__version__)
    key = hashlib.sha256("\n".join(versions).encode())
    sources = dict(_sources())
    for name in sorted(_behind_kernels(sources)):
        key.update(f"{name}\n{sources[name]}".encode())
    return key.hexdigest()[:20]


def forget_old_versions(base: Path) -> None:
    """Remove all folders but those used last."""
    folders = sorted((f for f in base.iterdir() if f.is_dir()), key=_last_use, reverse=True)
    for folder in folders[KEPT_FOLDERS:]:
        shutil.rmtree(folder, ignore_errors=True)


def _sources() -> Iterator[tuple[str, str]]:
    """Every module of the installed package: its place in it, without the suffix, and its text."""
    top = sys.modules[__name__.partition(".")[0]].__path__[0]
    for folder, folders, files in os.walk(top, followlinks=True):
        folders[:] = [f for f in folders if f != "__pycache__"]
        for file in files:
            if file.endswith(".py"):
                path = os.path.join(folder, file)
                place = path[len(top) + 1 : -len(".py")].replace(os.sep, "/")
                with open(path, "rb") as source:
                    yield place, source.read().decode()


def _behind_kernels(sources: Mapping[str, str]) -> set[str]:
    """The modules with kernels, and all that they import, directly or not."""
    found = {name for name, text in sources.items() if _KERNEL_IMPORT in text}
    waiting = list(found)
    while waiting:
        fresh = set(_imports(sources[waiting.pop()])).intersection(sources) - found
        found |= fresh
        waiting += fresh
    return found


def _imports(text: str) -> Iterator[str]:
    """The places of the modules that a module's first lines may import."""
    for module, names in _IMPORT.findall(text):
        place = module.replace(".", "/")
        yield from (place, f"{place}/__init__")
        yield from (f"{place}/{name}" for name in re.findall(r"\w+", names))


def _opened(folder: Path) -> bool:
    """Make a folder or note its use; whether it can be written to."""
    try:
        if folder.is_dir():
            os.utime(folder)
        else:
            folder.mkdir(parents=True, exist_ok=True)
            forget_old_versions(folder.parent)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError:
        return False
    return True


def _last_use(folder: Path) -> float:
    try:
        return folder.stat().st_mtime
    except OSError:
        return 0.0  # another process has removed it


def _private_temporary_folder() -> Path:
    """A folder that no other user can write to: loading a kernel runs what the file says."""
    user = getattr(os, "getuid", lambda: 0)()
    folder = Path(tempfile.gettempdir(), f"semnav-env-{user}")
    try:
        folder.mkdir(mode=0o700, exist_ok=True)
        found = folder.lstat()
        if stat.S_ISDIR(found.st_mode) and found.st_uid == user and not found.st_mode & 0o022:
            return folder
    except OSError:
        pass
    return Path(tempfile.mkdtemp(prefix="semnav-env-"))
