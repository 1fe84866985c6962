"""Lists of wall segments as plans: vector maps (JSON) and CSV."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from pathlib import Path
from typing import TypeAlias

import numpy as np

from semnav_env.world.maps.floor_plan import FloorPlan, Surface
from semnav_env.world.maps.importers.documents import finite, read_text
from semnav_env.world.maps.importers.imported import ImportedPlan, ImportReport, boundary_of
from semnav_env.world.maps.rules import LEAST_SEGMENT_LENGTH, FloorPlanError
from semnav_features.frames import FloatArray

Row: TypeAlias = tuple[float, float, float, float]
"""The ends x1, y1, x2, y2 of a segment, metres."""


def load_vector_map(path: str | Path, scale: float | None = None) -> ImportedPlan:
    """The floor plan of a `.vectormap.json` file: walls only, no doors and no rooms.

    The file is a list of segments {"p0": {"x": ..., "y": ...}, "p1": {...}} in metres (the maps
    of the University of Texas AMRL).

    Args:
        path: the file.
        scale: metres a unit of its coordinates; 1 if None.

    Raises:
        FloorPlanError: not such a file; names what is wrong.
    """
    where = Path(path)
    text = read_text(where)
    try:
        rows = json.loads(text)
        if not (isinstance(rows, list) and all(isinstance(row, dict) for row in rows)):
            raise TypeError("no list of objects")
        ends = [
            (finite(a["x"]), finite(a["y"]), finite(b["x"]), finite(b["y"]))
            for a, b in ((row["p0"], row["p1"]) for row in rows)
        ]
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise FloorPlanError(
            f'{where}: not a vector map ({error}); it must be a list of {{"p0": {{"x": 0.0, '
            '"y": 0.0}, "p1": {...}} in metres'
        ) from None
    return plan_of_segments(ends, where, "vector map", scale)


def load_csv(path: str | Path, scale: float | None = None) -> ImportedPlan:
    """The floor plan of a CSV file: x1, y1, x2, y2 of one wall in each line, metres.

    A first line without numbers is a heading; empty lines and those that begin with # are skipped.

    Args:
        path: the file.
        scale: metres a unit of its coordinates; 1 if None.

    Raises:
        FloorPlanError: not such a file; names the line, and what is wrong.
    """
    where = Path(path)
    lines = enumerate(read_text(where).splitlines(), 1)
    told = [(k, line) for k, line in lines if line.strip() and not line.lstrip().startswith("#")]
    rows = [(k, [cell.strip() for cell in next(csv.reader([line]))]) for k, line in told]
    if rows and not any(map(_is_number, rows[0][1])):
        rows = rows[1:]
    return plan_of_segments([_row(where, *row) for row in rows], where, "list of segments", scale)


def plan_of_segments(
    rows: Sequence[Row], path: Path, kind: str, scale: float | None = None
) -> ImportedPlan:
    """A plan whose walls are segments, without repeated ones and those of no length.

    Args:
        rows: x1, y1, x2, y2 in units of the file.
        path: file that they were read from.
        kind: kind of file, in words.
        scale: metres a unit; 1 if None.

    Raises:
        FloorPlanError: no wall is left.
    """
    ends = np.array(rows, dtype=np.float64).reshape(-1, 4) * (scale or 1.0)
    long = np.hypot(*(ends[:, 2:] - ends[:, :2]).T) >= LEAST_SEGMENT_LENGTH
    kept = _without_repetition(ends[long])
    if not len(kept):
        raise FloorPlanError(f"{path}: holds no wall; a {kind} has at least one segment")
    surfaces = tuple([Surface(((a, b), (c, d))) for a, b, c, d in kept.tolist()])
    name = path.name.split(".")[0]
    source = f"{kind} {path.name}"
    plan = FloorPlan(name, surfaces, (), (), (), (), boundary_of(surfaces), source)
    left = (
        _left_out(int((~long).sum()), f"shorter than {1000 * LEAST_SEGMENT_LENGTH:g} mm"),
        _left_out(int(long.sum()) - len(kept), "repeated"),
    )
    taken = {"segments": len(kept)}
    report = ImportReport((str(path),), kind, taken, tuple(filter(None, left)))
    return ImportedPlan(plan, report)


def _without_repetition(ends: FloatArray) -> FloatArray:
    """Each segment once, whichever way round, in the order of the file."""
    turned = (ends[:, 0] > ends[:, 2]) | ((ends[:, 0] == ends[:, 2]) & (ends[:, 1] > ends[:, 3]))
    same_way = np.where(turned[:, None], ends[:, [2, 3, 0, 1]], ends)
    _, first = np.unique(same_way, axis=0, return_index=True)
    return np.asarray(ends[np.sort(first)])


def _left_out(count: int, why: str) -> str:
    return f"{count} segments {why}" if count else ""


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _row(path: Path, number: int, cells: list[str]) -> Row:
    try:
        if len(cells) != 4:
            raise ValueError(f"has {len(cells)} values, not 4")
        x1, y1, x2, y2 = map(finite, cells)
    except ValueError as error:
        raise FloorPlanError(
            f"{path}: line {number}: {error}; each line has x1, y1, x2, y2 in metres"
        ) from None
    return x1, y1, x2, y2
