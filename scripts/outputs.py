"""Where results are to go, looked at before the work that makes them."""

from __future__ import annotations

from pathlib import Path


def check_file(path: Path | None, option: str) -> None:
    """Refuse a path at which no file can be written; None is no file, and fine.

    Args:
        path: of the file; it and the folders on the way to it may be missing.
        option: that gave it, for the message.

    Raises:
        ValueError: it is a folder, or lies under a file.
    """
    if path is None:
        return
    if path.is_dir():
        raise ValueError(f"{option}: '{path}' is a folder; give a file")
    check_folder(path.parent, option)


def check_folder(path: Path | None, option: str) -> None:
    """Refuse a path at which no folder is nor can be made; as `check_file`.

    Raises:
        ValueError: it is a file, or lies under one.
    """
    if path is None:
        return
    there = next(place for place in (path, *path.parents, Path()) if place.exists())
    if not there.is_dir():
        raise ValueError(f"{option}: '{there}' is a file, not a folder")


def counted(number: int, thing: str) -> str:
    """A number of things, as "1 door" and "2 doors"."""
    return f"{number} {thing}{'' if number == 1 else 's'}"
