"""Which folders and files of the kernel cache are ours, and may be removed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

VERSION_FOLDER = re.compile(r"[0-9a-f]{20}")
"""Names of the folders in it, one for each version of the sources."""

KERNEL_FILE = re.compile(r"[^.].*\.[0-9a-f]{20}\.bin")
"""Names of the files of kernels."""

UNFINISHED_FILE = re.compile(r"\..+(-[0-9a-f]{12}\.part\.bin|\.[0-9a-f]{20}\.bin\.lock)")
"""Names of such files while they are written, and of what tells others to wait for them."""

KEPT_FOLDERS = 10
"""Folders of as many versions of the sources are kept, those used last."""


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
