"""The whole chain from a scan to a scene as one kernel."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from semnav_env.features.frames import FloatArray
from semnav_env.features.kernels.arcs import find_arcs
from semnav_env.features.kernels.corners import find_corners
from semnav_env.features.kernels.corridors import find_corridors
from semnav_env.features.kernels.doors import find_doors
from semnav_env.features.kernels.layout import ARCS, CORNERS, CORRIDORS, DOORS, WALLS
from semnav_env.features.kernels.merging import merge_pieces
from semnav_env.features.kernels.segmentation import group_points
from semnav_env.features.kernels.walls import fit_pieces, flag_pieces, select_walls


@njit(cache=True, error_model="numpy")
def extract_arrays(
    ranges: FloatArray,
    directions: FloatArray,
    increment: float,
    range_min: float,
    range_max: float,
    record: np.ndarray,
    scratch: Any,
    walls: np.ndarray,
    doors: np.ndarray,
    corners: np.ndarray,
    corridors: np.ndarray,
    arcs: np.ndarray,
    counts: NDArray[np.int64],
) -> None:
    """Walls, doors, corners, corridors and arcs of one scan, written into the caller's arrays.

    Args:
        ranges: metres, shape (n,); anything outside [range_min, range_max) is no return.
        directions: cosine and sine of every beam, shape (n, 2), counter-clockwise, at most
            one full turn.
        increment: angle between beams, radians.
        range_min: shortest valid range, metres.
        range_max: longest valid range, metres; `rupture_range` may be shorter.
        record: `ExtractorSettings.as_record()`.
        scratch: `allocate_scratch(n)` or larger.
        walls: dtype `WALL`, any length, like the next four.
        doors: dtype `DOOR`.
        corners: dtype `CORNER`.
        corridors: dtype `CORRIDOR`.
        arcs: dtype `ARC`.
        counts: how many of each were found, shape (5,).
    """
    settings = record[0]
    limit = min(range_max, settings.rupture_range)
    _, groups = group_points(ranges, directions, increment, range_min, limit, settings, scratch)
    pieces = fit_pieces(groups, settings, scratch)
    flag_pieces(ranges, range_min, limit, groups, pieces, scratch)
    pieces = merge_pieces(pieces, settings, scratch)
    counts[ARCS] = find_arcs(directions, groups, pieces, settings, scratch, arcs)
    counts[WALLS] = select_walls(pieces, settings, scratch, walls)
    counts[DOORS] = find_doors(
        ranges, directions, increment, range_min, limit, pieces, settings, scratch, doors
    )
    counts[CORNERS] = find_corners(counts[WALLS], settings, scratch, corners)
    counts[CORRIDORS] = find_corridors(
        ranges,
        directions,
        increment,
        range_min,
        limit,
        counts[WALLS],
        counts[CORNERS],
        settings,
        scratch,
        corners,
        corridors,
    )
