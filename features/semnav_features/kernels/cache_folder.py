"""Where compiled kernels are kept between runs."""

from __future__ import annotations

import atexit
import os
import shutil
import sys
import tempfile
from functools import lru_cache
from pathlib import Path

from numba.core import config
from numba.misc.appdirs import AppDirs

from semnav_features.kernels.cache_key import version_key
from semnav_features.private_folder import make_private

OWN_NAME = "semnav-env-kernels"
"""Name of a folder that is ours alone, in one that the user may have chosen for many programs."""


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
        from semnav_features.kernels.version_folders import forget_old_versions

        forget_old_versions(base)
    os.utime(folder)
    tempfile.TemporaryFile(dir=folder).close()
    return folder


def _temporary_folder(name: str) -> Path:
    """A folder of kernels in this user's temporary folder, or a new one until the process ends."""
    user = getattr(os, "getuid", lambda: 0)()
    try:
        return _opened(Path(os.path.realpath(tempfile.gettempdir()), f"semnav-env-{user}"), name)
    except OSError:  # somebody else has made it
        folder = Path(tempfile.mkdtemp(prefix="semnav-env-"))
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
        return folder
