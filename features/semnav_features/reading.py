"""Reads whole files within a budget of bytes, and refuses inputs without an end."""

from __future__ import annotations

import os
import stat
from pathlib import Path

WHOLE_FILE = 20_000_000
"""Size of the largest document that is read as a whole, bytes."""


def check_file(
    path: str | os.PathLike[str], most: int = WHOLE_FILE, error: type[ValueError] = ValueError
) -> None:
    """Refuse a file that is too large or not regular, such as a pipe without an end.

    Args:
        path: of the file.
        most: size of the largest file that is read, bytes.
        error: kind of the error.

    Raises:
        ValueError: of the kind `error`; names the file and what would be right.
        OSError: there is no such file, or it must not be read.
    """
    status = os.stat(path)
    if stat.S_ISDIR(status.st_mode):
        raise error(f"{path}: is a folder; give a file")
    if not stat.S_ISREG(status.st_mode):
        raise error(f"{path}: is not a regular file; give a file")
    if status.st_size > most:
        raise error(f"{path}: {status.st_size:,} bytes; at most {most:,} are read")


def read_bytes(
    path: str | os.PathLike[str], most: int = WHOLE_FILE, error: type[ValueError] = ValueError
) -> bytes:
    """The content of a file; raises what `check_file` does."""
    check_file(path, most, error)
    return Path(path).read_bytes()


def read_text(
    path: str | os.PathLike[str], most: int = WHOLE_FILE, error: type[ValueError] = ValueError
) -> str:
    """The content of a file in UTF-8; raises what `check_file` does, and `error` if it is none."""
    try:
        return read_bytes(path, most, error).decode("utf-8-sig")
    except UnicodeDecodeError as fault:
        raise error(f"{path}: byte {fault.start} is not UTF-8; is it the right file?") from None
