"""A lock for files and folders that take long to write: one writer at a time."""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


@contextmanager
def sole_writer(target: Path) -> Iterator[None]:
    """Refuse a second writer of a file or a folder while the block lasts.

        with sole_writer(folder):
            train(folder)

    The lock is an empty file beside it, `.NAME.lock`. A lock that a
    killed writer has left has no effect. Without locks of the file system, nobody is refused.

    Raises:
        BlockingIOError: somebody else writes it; names it.
        OSError: there is no place for a lock beside it.
    """
    lock = target.with_name(f".{target.name[:200]}.lock")
    descriptor = _locked(lock, target)
    try:
        yield
    finally:
        with suppress(OSError):
            lock.unlink()
        os.close(descriptor)


def _locked(lock: Path, target: Path) -> int:
    """The open file of a lock that is held; it ends with the process."""
    while True:
        flags = os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0)
        descriptor = os.open(lock, flags, 0o600)
        try:
            if not _taken(descriptor) or _is_there(lock, descriptor):
                return descriptor
        except BlockingIOError:
            os.close(descriptor)
            said = "another run is writing it; give another name, or wait for it"
            raise BlockingIOError(errno.EWOULDBLOCK, said, str(target)) from None
        os.close(descriptor)  # who held it has just removed it


def _taken(descriptor: int) -> bool:
    """Take a lock; whether there are locks here at all. Raises BlockingIOError if it is held."""
    try:
        import fcntl
    except ImportError:  # not on this system
        return False
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise
    except OSError:  # not on this file system
        return False
    return True


def _is_there(lock: Path, descriptor: int) -> bool:
    """Whether the file of that name is the open one."""
    with suppress(FileNotFoundError):
        return os.path.samestat(os.lstat(lock), os.fstat(descriptor))
    return False
