"""Vector maps: the wall segments that some robotics groups keep for localisation, as a plan."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

from shapely import box

from semnav_env.maps.floor_plan import FloorPlan, Surface
from semnav_env.maps.rules import SHORTEST, FloorPlanError

MARGIN = 1.0
"""From the outermost wall to the boundary, metres."""


def load_vector_map(path: str | Path) -> FloorPlan:
    """The floor plan of a `.vectormap.json` file: walls only, no doors and no rooms.

    The file is a list of segments {"p0": {"x": ..., "y": ...}, "p1": {...}} in metres (the maps
    of the University of Texas AMRL). Segments of no length are left out.

    Raises:
        FloorPlanError: not such a file; the message says what is wrong.
        OSError: the file cannot be opened.
    """
    where = Path(path)
    try:
        rows = json.loads(where.read_text("utf-8"))
        ends = [tuple(_number(row[p][c]) for p in ("p0", "p1") for c in "xy") for row in rows]
    except (ValueError, KeyError, TypeError) as error:
        raise FloorPlanError(
            f'{where}: not a vector map ({error}); it must be a list of {{"p0": {{"x": 0.0, '
            '"y": 0.0}, "p1": {...}} in metres'
        ) from None
    walls = [
        Surface(((a, b), (c, d))) for a, b, c, d in ends if math.hypot(c - a, d - b) > SHORTEST
    ]
    if not walls:
        raise FloorPlanError(f"{where}: holds no wall; a vector map has at least one segment")
    xs = [x for wall in walls for x, _ in wall.points]
    ys = [y for wall in walls for _, y in wall.points]
    boundary = box(min(xs) - MARGIN, min(ys) - MARGIN, max(xs) + MARGIN, max(ys) + MARGIN)
    name = where.name.split(".")[0]
    return FloorPlan(name, tuple(walls), (), (), (), (), boundary, f"vector map {where.name}")


def _number(value: Any) -> float:
    number = float(value)
    if not math.isfinite(number):
        raise ValueError(f"a coordinate is {number}")
    return number
