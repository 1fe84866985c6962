"""Every real log from beginning to end: nothing may crash, and no number may be NaN."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import fields
from pathlib import Path

import numpy as np

from semnav_features import (
    Arc,
    Corner,
    CorridorProbe,
    Door,
    ExtractorSettings,
    Scene,
    Wall,
    extract,
)
from semnav_features.readers import open_log
from studies.sheets import Cell, ResultSheet


def find_logs(folder: Path) -> list[Path]:
    """The CARMEN logs under a folder with real data, sorted.

    Raises:
        ValueError: there are none.
    """
    logs = sorted((folder / "carmen").glob("*.log.gz"))
    if not logs:
        raise ValueError(f"{folder} holds no carmen/*.log.gz; give the folder with the real logs")
    return logs


def log_sheet(rows: Sequence[tuple[Cell, ...]]) -> ResultSheet:
    """The rows of `log_row` as a table."""
    columns = (
        *("log", "scans", "bad lines", "scenes that are not finite", "walls", "doors", "corners"),
        *("corridors", "arcs", "median us a scan"),
    )
    return ResultSheet("Real logs, features a scan", columns, rows)


def log_row(path: Path, settings: ExtractorSettings) -> tuple[Cell, ...]:
    """How many features there are in the scans of a log, and what is wrong with it."""
    counts, seconds, broken = [], [], 0
    with open_log(path) as log:
        for record in log:
            begin = time.perf_counter()
            scene = extract(record.scan, settings)
            seconds.append(time.perf_counter() - begin)
            kinds = (scene.walls, scene.doors, scene.corners, scene.corridors, scene.arcs)
            counts.append([len(kind) for kind in kinds])
            broken += not is_finite(scene)
        bad = sum(log.bad.values())
    name = path.name.removesuffix(".log.gz").removesuffix("-corrected")
    means = np.mean(counts, axis=0).tolist()
    return (name, len(counts), bad, broken, *means, 1e6 * float(np.median(seconds)))


def is_finite(scene: Scene) -> bool:
    """Whether every number in a scene is finite."""
    items: tuple[Wall | Door | Corner | CorridorProbe | Arc, ...]
    items = (*scene.walls, *scene.doors, *scene.corners, *scene.corridors, *scene.arcs)
    return all(
        math.isfinite(number)
        for item in items
        for slot in fields(item)
        for number in _numbers(getattr(item, slot.name))
    )


def _numbers(value: object) -> tuple[float, ...]:
    if isinstance(value, tuple):
        return value
    return (value,) if isinstance(value, float) else ()
