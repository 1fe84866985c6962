"""Checks of the paths of results, made before the work that produces them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path


def check_file(path: Path | None, option: str) -> None:
    """Refuse a path at which no file can be written; None means no file and is accepted.

    Args:
        path: of the file; the file and its folders may be missing.
        option: name of the option that gave the path, for the message.

    Raises:
        ValueError: the path is a folder, or lies under a file.
    """
    if path is None:
        return
    if path.is_dir():
        raise ValueError(f"{option}: '{path}' is a folder; give a file")
    check_folder(path.parent, option)


def check_distinct(paths: Mapping[str, Path | None]) -> None:
    """Refuse one path for two outputs: the later would overwrite the earlier.

    Args:
        paths: paths of files, by the option or the purpose of each; None means no file.

    Raises:
        ValueError: two are the same file; names both.
    """
    taken: dict[Path, str] = {}
    for name, path in paths.items():
        if path is None:
            continue
        other = taken.setdefault(path.resolve(), name)
        if other != name:
            raise ValueError(f"{name}: '{path}' is {other}, too; give another file")


def check_folder(path: Path | None, option: str) -> None:
    """Refuse a path at which there is no folder and none can be made; None is accepted.

    Args:
        path: of the folder; it may be missing.
        option: name of the option that gave the path, for the message.

    Raises:
        ValueError: the path is a file, or lies under one.
    """
    if path is None:
        return
    there = next(place for place in (path, *path.parents, Path()) if place.exists())
    if not there.is_dir():
        raise ValueError(f"{option}: '{there}' is a file, not a folder")


def counted(number: int, thing: str) -> str:
    """A number of things in words, such as "1 door" and "2 doors"."""
    return f"{number} {thing}{'' if number == 1 else 's'}"
