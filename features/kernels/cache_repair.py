"""Mends the cache of compiled kernels: removes what is damaged or was left behind."""

from __future__ import annotations

import shutil
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from semnav_env.features.kernels.kernel_cache import unsealed

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
    """Mend the cache.

    Args:
        folder: of the kernels of these sources, see `cache_folder`.
    """
    return CacheRepair(
        sum(map(_removed, _damaged(folder))),
        sum(map(_removed, _unfinished(folder.parent))),
        sum(map(_removed, _unused(folder))),
    )


def _damaged(folder: Path) -> Iterator[Path]:
    for file in folder.glob("[!.]*.bin"):
        with suppress(OSError):
            try:
                unsealed(file.read_bytes())
            except ValueError:
                yield file


def _unfinished(base: Path) -> Iterator[Path]:
    return (part for part in base.glob("*/.*.part.bin") if _age(part) > OLD_PART)


def _unused(folder: Path) -> Iterator[Path]:
    others = (place for place in folder.parent.iterdir() if place.is_dir() and place != folder)
    return (place for place in others if _age(place) > OLD_VERSION)


def _age(path: Path) -> float:
    """Seconds since the last change or use; 0 if another process has removed it."""
    with suppress(OSError):
        return time.time() - path.stat().st_mtime
    return 0.0


def _removed(path: Path) -> bool:
    """Remove a file or a folder; whether it is gone."""
    if path.is_dir():
        shutil.rmtree(path, ignore_errors=True)
    else:
        with suppress(OSError):
            path.unlink()
    return not path.exists()
