"""Mends the cache of compiled kernels: removes what is damaged or was left behind."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from semnav_features.kernels.kernel_cache import unsealed
from semnav_features.kernels.version_folders import (
    KERNEL_FILE,
    UNFINISHED_FILE,
    entries,
    is_kernel,
    remove_version,
    versions,
)

OLD_PART = 3600.0
"""Age from which an unfinished file is one whose writer was killed, seconds: writing takes none."""

OLD_VERSION = 30 * 86_400.0
"""Time without use after which the kernels of other sources are removed, seconds."""


@dataclass(frozen=True)
class CacheRepair:
    """What was removed from the cache.

    Attributes:
        damaged: number of kernels of these sources that cannot be read; they are compiled anew when
            they are needed.
        unfinished: number of files of writers that were killed.
        versions: number of folders of other sources that nobody has used for a month.
    """

    damaged: int
    unfinished: int
    versions: int

    def __str__(self) -> str:
        """In words, for a line of `semnav doctor`; empty if nothing was removed."""
        removed = (
            (self.damaged, "damaged"),
            (self.unfinished, "unfinished"),
            (self.versions, "of other versions"),
        )
        return "".join(f"; removed {count} {kind}" for count, kind in removed if count)


def repair(folder: Path) -> CacheRepair:
    """Mend the cache. Nothing is touched but files and folders with the names of ours.

    Args:
        folder: of the kernels of these sources, see `cache_folder`.
    """
    return CacheRepair(
        sum(map(_removed, _damaged(folder))),
        sum(map(_removed, _unfinished(folder.parent))),
        sum(map(remove_version, _unused(folder))),
    )


def _damaged(folder: Path) -> Iterator[Path]:
    for file in filter(is_kernel, entries(folder)):
        if KERNEL_FILE.fullmatch(file.name):
            with suppress(OSError):
                try:
                    unsealed(file.read_bytes())
                except ValueError:
                    yield file


def _unfinished(base: Path) -> Iterator[Path]:
    files = (file for folder in versions(base) for file in filter(is_kernel, entries(folder)))
    return (f for f in files if UNFINISHED_FILE.fullmatch(f.name) and _age(f) > OLD_PART)


def _unused(folder: Path) -> Iterator[Path]:
    others = (place for place in versions(folder.parent) if place != folder)
    return (place for place in others if _age(place) > OLD_VERSION)


def _age(path: Path) -> float:
    """Seconds since the last change or use; 0 if another process has removed it."""
    with suppress(OSError):
        return time.time() - path.stat().st_mtime
    return 0.0


def _removed(file: Path) -> bool:
    """Remove a file; whether it is gone."""
    with suppress(OSError):
        file.unlink()
    return not file.exists()
