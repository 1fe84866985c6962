"""Writes files so that at any moment there is the old file or the complete new one.

Data go to a partial file beside the target, which replaces the target when it is complete and on
the disk. A full disk, an error, an interruption or a kill leaves the old file as it was. The
partial file has a name that cannot be predicted. Therefore two writers never share a partial file,
and no symbolic link can wait in its place; the file is the complete one of the writer that finished
last. Files that take long to write have one writer at a time (`sole_writer`).
"""

from __future__ import annotations

import errno
import os
import shutil
import uuid
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


@contextmanager
def replacing(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give a partial file with the same suffix, which replaces the target at the end.

        with replacing("plan.png") as part:
            figure.savefig(part)

    Missing folders are made. A target that is not a regular file, such as a pipe, is written
    directly.

    Raises:
        OSError: it cannot be written; names the file.
    """
    target = target_of(path)
    part = part_of(target)
    try:
        with naming(target):
            yield part
            put_in_place(part, target)
    except BaseException:
        discard(part, target)
        raise


def write_file(path: str | os.PathLike[str], content: bytes | str) -> None:
    """Write a whole file, text as UTF-8; see `replacing`."""
    with replacing(path) as part, open(part, writing_mode(part)) as file:
        file.write(content.encode() if isinstance(content, str) else content)


def writing_mode(part: Path) -> str:
    """The mode in which to open a partial file: a new file, or for a pipe the existing one."""
    return "wb" if part.exists() and not part.is_file() else "xb"


def target_of(path: str | os.PathLike[str]) -> Path:
    """The file that is written for a path; a symbolic link is followed if it may be trusted.

    Raises:
        PermissionError: it is the link of another user, who may want it to be written there.
    """
    place = Path(path)
    if not place.is_symlink():
        return place
    if hasattr(os, "getuid") and place.lstat().st_uid not in (os.getuid(), 0):
        said = "it is a link of another user; give the file itself"
        raise PermissionError(errno.EPERM, said, str(place))
    return place.resolve()


def part_of(target: Path) -> Path:
    """The path of a new partial file beside a file, or the file itself if it is not a regular one.

    Raises:
        OSError: its folder cannot be made, or it is a folder itself.
    """
    target.parent.mkdir(parents=True, exist_ok=True)
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, "it is a folder; give a file", str(target))
    if target.exists() and not target.is_file():
        return target
    return target.with_name(f".{target.stem[:100]}-{uuid.uuid4().hex[:12]}.part{target.suffix}")


def put_in_place(part: Path, target: Path) -> None:
    """Let a complete partial file replace a file, or a folder replace an empty or missing one."""
    if part == target:
        return
    for path in [part] if part.is_file() else filter(Path.is_file, part.rglob("*")):
        with open(path, "rb") as file:
            os.fsync(file.fileno())
    if target.is_dir():
        target.rmdir()
    elif target.exists():
        os.chmod(part, target.stat().st_mode)
    os.replace(part, target)


def discard(part: Path, target: Path) -> None:
    """Remove an incomplete partial file or folder."""
    if part.is_dir():
        shutil.rmtree(part, ignore_errors=True)
    elif part != target:
        with suppress(OSError):
            part.unlink()


@contextmanager
def naming(target: Path) -> Iterator[None]:
    """Let an error of the operating system name the target, not its partial file."""
    try:
        yield
    except OSError as error:
        named = str(error.filename or "")
        if named and ".part" not in Path(named).name:
            raise
        said = error.strerror or str(error)
        raise OSError(error.errno or errno.EIO, said, str(target)) from error
