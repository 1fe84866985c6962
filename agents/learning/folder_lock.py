"""Keeps the folder of a training for one process."""

from __future__ import annotations

import os
import socket
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

LOCK_FILE = "training.lock"

NO_LINKS = getattr(os, "O_NOFOLLOW", 0)
"""Flag by which a link in the place of the lock is refused: what it leads to would be emptied."""

LONGEST_HOLDER = 200
"""Largest number of bytes that are read of who holds the lock."""

if sys.platform == "win32":
    import msvcrt

    def _take(file: int) -> None:
        """Lock the first byte of a file, or raise `PermissionError`."""
        msvcrt.locking(file, msvcrt.LK_NBLCK, 1)
else:
    import fcntl

    def _take(file: int) -> None:
        """Lock a file, or raise `BlockingIOError`."""
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


@contextmanager
def only_trainer_in(folder: Path) -> Iterator[None]:
    """Refuse a folder in which another process trains.

    The operating system ends the lock together with its process, however that ends. A folder in
    which nothing was written is removed at the end. On a file system without locks nothing is
    refused.

    Raises:
        ValueError: another process trains there; says which.
    """
    made = not folder.exists()
    folder.mkdir(parents=True, exist_ok=True)
    file = os.open(folder / LOCK_FILE, os.O_RDWR | os.O_CREAT | NO_LINKS, 0o644)
    try:
        _take_or_refuse(file, folder)
        yield
    finally:
        if made and os.listdir(folder) == [LOCK_FILE]:
            with suppress(OSError):
                (folder / LOCK_FILE).unlink()
                folder.rmdir()
        os.close(file)


def _take_or_refuse(file: int, folder: Path) -> None:
    try:
        _take(file)
    except (BlockingIOError, PermissionError):
        holder = ""
        with suppress(OSError):  # Windows lets nobody read it
            holder = os.read(file, LONGEST_HOLDER).decode("utf-8", "replace").strip()
        raise ValueError(
            f"{folder} is being trained by {holder or 'another process'}; give another --out"
        ) from None
    except OSError:  # the file system has no locks
        return
    os.ftruncate(file, 0)
    os.write(file, f"process {os.getpid()} on {socket.gethostname()}\n".encode())
