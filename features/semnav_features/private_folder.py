"""Folders to which only the user can write."""

from __future__ import annotations

import errno
import os
import stat
from contextlib import suppress
from pathlib import Path

OTHERS_WRITE = stat.S_IWGRP | stat.S_IWOTH
"""The bits of a mode that let others than the owner write."""


def make_private(folder: Path) -> None:
    """Make a folder that only the user can write to, or check that the one there is such a folder.

    Other users must not be able to replace the folder either: the folders above it must belong to
    the user or to the system, and be closed to others. Missing folders are made.

    Args:
        folder: an absolute path.

    Raises:
        OSError: it cannot be made, or others can write to it; says why.
    """
    if not folder.is_absolute():
        raise OSError(errno.EINVAL, "its path is not absolute", str(folder))
    for above in reversed(folder.parents):
        _make(above)
        _check_above(above)
    _make(folder)
    _check_own(folder)


def _make(folder: Path) -> None:
    """Make a folder for the user alone, whatever the umask, if it is missing."""
    if not folder.is_dir():
        with suppress(FileExistsError):  # another process was faster, or it is no folder
            os.mkdir(folder, 0o700)


def _check_own(folder: Path) -> None:
    found = folder.lstat()
    if not stat.S_ISDIR(found.st_mode):
        raise NotADirectoryError(errno.ENOTDIR, "it is a link or a file", str(folder))
    if hasattr(os, "getuid") and found.st_uid != os.getuid():
        raise PermissionError(errno.EPERM, "it belongs to another user", str(folder))
    if hasattr(os, "getuid") and found.st_mode & OTHERS_WRITE:
        raise PermissionError(errno.EPERM, "others can write to it", str(folder))


def _check_above(folder: Path) -> None:
    """Refuse a folder in which others can replace what is in it.

    In a sticky folder, such as /tmp, only its owner can replace something. The system is user 0, or
    in a container whoever owns "/".
    """
    found = folder.stat()
    if not hasattr(os, "getuid"):
        return
    if found.st_uid not in (os.getuid(), 0, os.stat("/").st_uid):
        raise PermissionError(errno.EPERM, f"{folder} belongs to another user", str(folder))
    closed = OTHERS_WRITE if not _is_private(found.st_gid) else stat.S_IWOTH
    if found.st_mode & closed and not found.st_mode & stat.S_ISVTX:
        raise PermissionError(errno.EPERM, f"others can write to {folder}", str(folder))


def _is_private(group: int) -> bool:
    """Whether a group is the one of one user alone, as many systems make one for each."""
    import grp
    import pwd

    try:
        user, found = pwd.getpwuid(os.getuid()), grp.getgrgid(group)
    except KeyError:
        return False
    alone = set(found.gr_mem) <= {user.pw_name}
    return alone and (user.pw_gid, user.pw_name) == (group, found.gr_name)
